// When a set of vectors makes an inverse spherical surface: the spherical n-partition of Definition 1
// (Casciola and Morigi 2004), and a certificate that the surface is single-valued, which the paper takes to
// follow from the partition. It does so for planar projection domains only.
#pragma once

#include "renderer/inverse_spherical/iss.h"

namespace rondure {

// Why the directions of u_ijk form no n-partition of their spherical triangle, in words that name the side
// point or the sub-triangle; empty when they do. Points of a side must lie on its great circle (to 1e-9) and
// follow each other along it; every sub-triangle must turn the way of the whole.
std::optional<std::string> partition_fault(int n, const std::vector<dvec3>& u);

// Why u(tau) / |u(tau)| is not one-to-one on the triangle, in words; empty when it is certified to be: the
// Jacobian det(u_a, u_b, u_c) keeps one sign (bezier/star_shaped.h), and the sides are as in partition_fault.
std::optional<std::string> fold_fault(int n, const std::vector<dvec3>& u);

}  // namespace rondure
