#include "renderer/intersect/ellipsoid_proof.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "renderer/bezier/product.h"

namespace rondure {
namespace {

using lvec3 = glm::vec<3, long double, glm::defaultp>;

constexpr int most = largest_proven_degree + 1;  // rows, and points of each

// Of a net's image, times its binomials: products of Bernstein polynomials are convolutions of such. x, y, z
// and w of a row's points; each number is the sum of a high part, of so few bits that sums of products of
// them are exact, and a low one.
struct Row {
  int size = 0;
  double whole[4][most], high[4][most], low[4][most];
};

// Products of two have twice as many, and no more than 2^9 of them are summed.
constexpr int high_bits = 22;

// The product of two rows of Bernstein coefficients: of |x|^2 - w^2, and of w^2.
struct ProductRow {
  double exact[2 * most]{};  // sums of products of high parts
  double rest[2 * most]{}, square[2 * most]{};

  // Twice, where the rows differ: they come in either order.
  void add(const Row& p, const Row& q, double times) {
    for (int l = 0; l < q.size; ++l) {
      double high[4], low[4], whole[4];
      for (int c = 0; c < 4; ++c) {
        const double signed_times = c < 3 ? times : -times;
        high[c] = signed_times * q.high[c][l], low[c] = signed_times * q.low[c][l],
        whole[c] = signed_times * q.whole[c][l];
      }
      for (int j = 0; j < p.size; ++j) {
        exact[l + j] += (high[0] * p.high[0][j] + high[1] * p.high[1][j]) +
                        (high[2] * p.high[2][j] + high[3] * p.high[3][j]);
        rest[l + j] += ((low[0] * p.high[0][j] + whole[0] * p.low[0][j]) +
                        (low[1] * p.high[1][j] + whole[1] * p.low[1][j])) +
                       ((low[2] * p.high[2][j] + whole[2] * p.low[2][j]) +
                        (low[3] * p.high[3][j] + whole[3] * p.low[3][j]));
        square[l + j] -= whole[3] * p.whole[3][j];
      }
    }
  }
};

lvec4 image(const dvec4& p, const EllipsoidMap& map) {
  const long double w = p.w;
  return {map.inverse * (lvec3(p.x, p.y, p.z) - map.center * w), w};
}

// Splits the numbers. A bound on what the rest of products then leaves unknown, relative to squares of
// weights: low parts are below 2^-22 of the greatest number, so that the rest of a corner's coefficient, the
// sum of 8 products of them, is off by 2^-69 of the greatest times that corner's weight. Infinite where that
// is too much.
double set_rows(const std::vector<lvec4>& points, Row* rows, int count) {
  double greatest = 0.0, least = INFINITY;
  for (const lvec4& p : points) {
    greatest = std::max({greatest, std::fabs(static_cast<double>(p.x)), std::fabs(static_cast<double>(p.y)),
                         std::fabs(static_cast<double>(p.z)), static_cast<double>(p.w)});
    least = std::min(least, static_cast<double>(p.w));
  }
  if (!(least > 0x1p-18 * greatest) || !(greatest < 0x1p400 && greatest > 0x1p-400)) return INFINITY;
  const double step = std::ldexp(1.5, std::ilogb(greatest) + 1 + 52 - high_bits);
  const lvec4* p = points.data();
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < rows[i].size; ++j, ++p)
      for (int c = 0; c < 4; ++c) {
        const long double x = (*p)[c];
        const auto whole = static_cast<double>(x);
        const double high = (whole + step) - step;
        rows[i].whole[c][j] = whole, rows[i].high[c][j] = high,
        rows[i].low[c][j] = static_cast<double>(x - high);
      }
  return 0x1p-69 * greatest / least;
}

}  // namespace

EllipsoidMap::EllipsoidMap(const dmat3& linear, const dvec3& c)
    : inverse(glm::inverse(Matrix(linear))), center(c), distance(glm::length(inverse * center)) {}

// Bernstein coefficients of |x|^2 - w^2 against those of w^2, one by one, as the quotient of both polynomials
// is a mean of theirs. (The smallest weight's square in the place of all would ask more, by the square of the
// ratio of the weights, where the patch is no more exact.)
double defect_of(const Net& net, const EllipsoidMap& map) {
  Row rows[most];
  std::vector<lvec4> points;
  points.reserve(most * most);
  int count;
  if (const auto* tensor = std::get_if<TensorNet>(&net)) {
    count = tensor->m + 1;
    for (int i = 0; i < count; ++i) {
      rows[i].size = tensor->n + 1;
      for (int j = 0; j <= tensor->n; ++j)
        points.push_back(static_cast<long double>(binomial(tensor->m, i) * binomial(tensor->n, j)) *
                         image(tensor->at(i, j), map));
    }
  } else {
    const auto& triangle = std::get<TriangleNet>(net);
    count = triangle.n + 1;
    for (int i = 0; i < count; ++i) {
      rows[i].size = count - i;
      for (int j = 0; j < count - i; ++j)
        points.push_back(static_cast<long double>(trinomial(triangle.n, i, j)) *
                         image(triangle.at(i, j), map));
    }
  }
  const double unknown = set_rows(points, rows, count);
  if (!std::isfinite(unknown)) return unknown;
  double most_off = 0.0;
  for (int i = 0; i <= 2 * (count - 1); ++i) {
    ProductRow product;
    int size = 0;
    for (int low = std::max(0, i - (count - 1)); 2 * low <= i; ++low) {
      const Row &p = rows[low], &q = rows[i - low];
      product.add(p, q, 2 * low < i ? 2.0 : 1.0);
      size = p.size + q.size - 1;
    }
    for (int j = 0; j < size; ++j) {
      const double off = std::fabs(product.exact[j] + product.rest[j]) / product.square[j];
      if (!(off < INFINITY)) return INFINITY;
      most_off = std::fmax(most_off, off);
    }
  }
  return most_off + unknown;
}

bool may_lie_on(const Net& net, const EllipsoidMap& map) {
  const std::vector<dvec4>& points = points_of(net);
  for (const dvec4& p : {points.front(), points.back()}) {
    const lvec4 x = image(p, map);
    if (!(std::abs(glm::dot(lvec3(x), lvec3(x)) - x.w * x.w) <= 1e-6L * x.w * x.w)) return false;
  }
  return true;
}

}  // namespace rondure
