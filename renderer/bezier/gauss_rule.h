// Gauss-Legendre quadrature on [0, 1] for integrands made of Bernstein polynomials of one degree.
#pragma once

#include <cstddef>
#include <vector>

namespace rondure {

// Tables of the Bernstein polynomials of degree d are indexed [i * (d + 1) + k] with the node i and the
// polynomial k, and project[k * count + i] for the Legendre coefficient k.
struct GaussRule {
  int degree = 0;
  int count = 0;                    // nodes: 3 degree + 1, and at least 10
  std::vector<long double> node;    // ascending, inside (0, 1)
  std::vector<long double> weight;  // sum 1
  std::vector<long double> value;   // of degree d = degree
  std::vector<long double> lower;   // of degree d = degree - 1
  // Of a polynomial of degree below `count` in 2 t - 1: from its values at the nodes to its coefficients.
  std::vector<double> project;
};

// Made once; 1 <= degree <= max_degree. Safe to call from several threads.
const GaussRule& gauss_rule(int degree);

}  // namespace rondure
