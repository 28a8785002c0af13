#include "renderer/continuity/regularity.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/bezier/curvature_polynomial.h"
#include "renderer/bezier/edge_factor.h"
#include "renderer/bezier/rational.h"
#include "renderer/continuity/pieces.h"
#include "renderer/continuity/separating_direction.h"

namespace rondure {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// What rounding can change in a coefficient of N: some tens of eps of the products it is summed from, taken
// about a point of the net, and the rounding of that net's difference.
double rounding_of(const Net& net) {
  const std::vector<dvec4>& points = points_of(net);
  const dvec3 centre = dvec3(points[0]) / (points[0].w != 0.0 ? points[0].w : 1.0);
  double far = 0.0, space = 0.0, weight = 0.0;
  for (const dvec4& p : points) {
    far = std::max(far, glm::length(dvec3(p)));
    space = std::max(space, glm::length(dvec3(p) - p.w * centre));
    weight = std::max(weight, std::abs(p.w));
  }
  const auto* tensor = std::get_if<TensorNet>(&net);
  const double n = tensor ? std::max(tensor->m, tensor->n) : std::get<TriangleNet>(net).n;
  const double off = (64.0 + 16.0 * n) * eps * space + 4.0 * eps * far;
  // N has three terms w X_u x X_v, each derivative n differences of at most twice the size.
  return 3.0 * 4.0 * n * n * weight * space * off;
}

class Search {
 public:
  Search(const Surface& surface, long budget) : surface_(surface), budget_(budget) {
    out_.least = out_.least_found = std::numeric_limits<double>::infinity();
  }

  Regularity run() {
    for (patch_ = 0; patch_ < static_cast<int>(surface_.patches.size()); ++patch_) {
      const Net& net = surface_.patches[static_cast<std::size_t>(patch_)];
      noise_ = rounding_of(net);
      if (const auto* t = std::get_if<TensorNet>(&net)) {
        TensorPolynomial<double> factor, weight(t->m, t->n);
        factor.coefficients = {1.0};
        for (std::size_t k = 0; k < t->points.size(); ++k) weight.coefficients[k] = t->points[k].w;
        auto normal = without_edges(std::get<TensorNormal>(normal_polynomial(net)), factor);
        note_factor(factor.m + factor.n);
        search(std::move(normal), std::move(weight), whole_square());
      } else {
        const auto& triangle = std::get<TriangleNet>(net);
        TrianglePolynomial<double> factor, weight(triangle.n);
        factor.coefficients = {1.0};
        for (std::size_t k = 0; k < triangle.points.size(); ++k)
          weight.coefficients[k] = triangle.points[k].w;
        auto normal = without_edges(std::get<TriangleNormal>(normal_polynomial(net)), factor);
        note_factor(factor.n);
        search(std::move(normal), std::move(weight), whole_triangle());
      }
    }
    if (!out_.singular.empty()) {
      out_.verdict = Regularity::Verdict::singular;
    } else if (!unproved_ && !surface_.patches.empty()) {
      out_.verdict = Regularity::Verdict::regular;
    }
    if (out_.verdict != Regularity::Verdict::regular || out_.collapsed > 0) out_.least = 0.0;
    return out_;
  }

 private:
  static constexpr int deepest = 40;  // 2^-20 in each direction
  static constexpr std::size_t most_singular = 16;

  const Surface& surface_;
  long budget_;
  Regularity out_;
  int patch_ = 0;
  double noise_ = 0.0;
  bool unproved_ = false;

  void note_factor(int degree) { out_.collapsed += degree > 0 ? 1 : 0; }

  const Net& net() const { return surface_.patches[static_cast<std::size_t>(patch_)]; }

  // A value of |Su x Sv| that is taken.
  void note(const dvec2& at) {
    const SurfaceJet jet = surface_jet(net(), at.x, at.y);
    const double value = glm::length(glm::cross(jet.du, jet.dv));
    out_.largest_found = std::max(out_.largest_found, value);
    if (value < out_.least_found) {
      out_.least_found = value;
      out_.least_at = {patch_, at.x, at.y, jet.point + surface_.origin};
    }
  }

  // A grid of them, so that what is found does not depend on how few pieces a proof needs.
  void note_grid() {
    const double share = 1e5 / static_cast<double>(surface_.patches.size());
    const int cells = std::clamp(static_cast<int>(std::sqrt(share)), 2, 16);
    const bool triangle = std::holds_alternative<TriangleNet>(net());
    for (int i = 0; i <= cells; ++i) {
      for (int j = 0; j <= (triangle ? cells - i : cells); ++j)
        note({static_cast<double>(i) / cells, static_cast<double>(j) / cells});
    }
  }

  template <class N, class W>
  void search(N normal, W weight, std::vector<dvec2> corners) {
    note_grid();
    std::vector<Piece<N, W>> left;
    left.push_back({std::move(normal), std::move(weight), std::move(corners), 0});
    std::vector<dvec2> suspects;
    while (!left.empty()) {
      const Piece<N, W> piece = std::move(left.back());
      left.pop_back();
      const double bound = lower_bound(piece);
      if (bound > 0.0 && bound >= 0.5 * out_.least_found) {
        out_.least = std::min(out_.least, bound);
        ++out_.pieces;
        continue;
      }
      if (piece.depth >= deepest || out_.pieces + static_cast<long>(left.size()) >= budget_) {
        unproved_ = true;
        if (piece.depth >= deepest)
          suspects.insert(suspects.end(), piece.corners.begin(), piece.corners.end());
        if (suspects.size() > 6000 || piece.depth < deepest) break;
        continue;
      }
      auto parts = cut(piece);
      left.push_back(std::move(parts.first));
      left.push_back(std::move(parts.second));
    }
    for (const dvec2& at : suspects) polish(at);
  }

  // Of |N| / w^3 on the piece. Its corners give values that are taken.
  template <class N, class W>
  double lower_bound(const Piece<N, W>& piece) {
    double largest_weight = 0.0;
    for (const double w : piece.weight.coefficients) largest_weight = std::max(largest_weight, std::abs(w));
    for (const dvec2& corner : piece.corners) note(corner);
    // Halving adds half an eps of the coefficients at every level and degree.
    const double noise = noise_ * (1.0 + piece.depth);
    const std::optional<dvec3> direction = separating_direction(piece.normal.coefficients, noise);
    if (!direction) return 0.0;
    double low = std::numeric_limits<double>::infinity();
    for (const dvec3& n : piece.normal.coefficients) low = std::min(low, glm::dot(n, *direction));
    return (low - noise) / (largest_weight * largest_weight * largest_weight);
  }

  // Gauss and Newton's method for a zero of N near a piece that resisted.
  void polish(dvec2 at) {
    const NormalPolynomial n = normal_polynomial(net());
    double size = 0.0;
    std::visit(
        [&](const auto& p) {
          for (const dvec3& c : p.coefficients) size = std::max(size, glm::length(c));
        },
        n);
    const bool triangle = std::holds_alternative<TriangleNet>(net());
    const auto value = [&](const dvec2& p) { return polynomial_value(n, p.x, p.y); };
    // What rounding leaves of a zero: some tens of eps, and those of where it lies.
    const double zero = 1e-13 * size;
    for (int step = 0; step < 20 && !(glm::length(value(at)) <= zero); ++step) {
      const double h = 1e-6;
      const dvec3 f = value(at);
      const dvec3 fu = (value(at + dvec2(h, 0)) - value(at - dvec2(h, 0))) / (2.0 * h);
      const dvec3 fv = (value(at + dvec2(0, h)) - value(at - dvec2(0, h))) / (2.0 * h);
      const double a = glm::dot(fu, fu), b = glm::dot(fu, fv), c = glm::dot(fv, fv);
      const dvec2 right(glm::dot(fu, f), glm::dot(fv, f));
      // Along a singular curve N changes across it only: then the shortest of the steps that would do.
      const double d = a * c - b * b, both = a + c;
      if (!(both > 0.0)) break;
      const dvec2 move = d > 1e-9 * both * both
                             ? dvec2((c * right.x - b * right.y) / d, (a * right.y - b * right.x) / d)
                             : right / both;
      at -= move;
      if (glm::length(move) < 1e-15) break;
    }
    const double slack = 1e-9;
    const bool inside = at.x >= -slack && at.y >= -slack &&
                        (triangle ? at.x + at.y <= 1.0 + slack : at.x <= 1.0 + slack && at.y <= 1.0 + slack);
    if (!inside) return;
    at = glm::clamp(at, 0.0, 1.0);
    if (triangle && at.x + at.y > 1.0) at /= at.x + at.y;
    if (!(glm::length(value(at)) <= zero)) return;
    for (const SingularPoint& s : out_.singular) {
      if (s.patch == patch_ && glm::distance(dvec2(s.u, s.v), at) < 1e-5) return;
    }
    if (out_.singular.size() >= most_singular) return;
    out_.singular.push_back({patch_, at.x, at.y, net_point(net(), at.x, at.y) + surface_.origin});
  }
};

}  // namespace

Regularity regularity_of(const Surface& surface, long budget) { return Search(surface, budget).run(); }

}  // namespace rondure
