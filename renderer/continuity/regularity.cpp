#include "renderer/continuity/regularity.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "renderer/bezier/curvature_polynomial.h"
#include "renderer/bezier/edge_factor.h"
#include "renderer/bezier/rational.h"
#include "renderer/continuity/normal_zero.h"
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

// The net with its largest coordinate and weight brought to between 1/2 and 1 by powers of 2, so that N
// neither overflows nor vanishes; `doublings` is that of points in space.
Net balanced(Net net, int& doublings) {
  double space = 0.0, weight = 0.0;
  for (const dvec4& p : points_of(net)) {
    space = std::max({space, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    weight = std::max(weight, std::abs(p.w));
  }
  int of_space = 0, of_weight = 0;
  std::frexp(space, &of_space);
  std::frexp(weight, &of_weight);
  for (dvec4& p : points_of(net)) {
    for (int d = 0; d < 4; ++d) p[d] = std::ldexp(p[d], d < 3 ? -of_space : -of_weight);
  }
  doublings = of_weight - of_space;
  return net;
}

bool is_end(double x) { return x == 0.0 || x == 1.0; }

class Search {
 public:
  Search(const Surface& surface, long budget) : surface_(surface), budget_(budget) {
    out_.least = out_.least_found = std::numeric_limits<double>::infinity();
  }

  Regularity run() {
    for (patch_ = 0; patch_ < static_cast<int>(surface_.patches.size()); ++patch_) {
      const Net net = balanced(surface_.patches[static_cast<std::size_t>(patch_)], doublings_);
      noise_ = rounding_of(net);
      if (const auto* t = std::get_if<TensorNet>(&net)) {
        TensorPolynomial<double> factor, weight(t->m, t->n);
        factor.coefficients = {1.0};
        for (std::size_t k = 0; k < t->points.size(); ++k) weight.coefficients[k] = t->points[k].w;
        auto normal = without_edges(std::get<TensorNormal>(normal_polynomial(net)), factor);
        note_factor(factor.m + factor.n, std::max(normal.m, normal.n));
        search(std::move(normal), std::move(weight), whole_square());
      } else {
        const auto& triangle = std::get<TriangleNet>(net);
        TrianglePolynomial<double> factor, weight(triangle.n);
        factor.coefficients = {1.0};
        for (std::size_t k = 0; k < triangle.points.size(); ++k)
          weight.coefficients[k] = triangle.points[k].w;
        auto normal = without_edges(std::get<TriangleNormal>(normal_polynomial(net)), factor);
        note_factor(factor.n, normal.n);
        search(std::move(normal), std::move(weight), whole_triangle());
      }
    }
    out_.complete = !unproved_ && !surface_.patches.empty();
    if (!out_.singular.empty()) {
      out_.verdict = Regularity::Verdict::singular;
    } else if (out_.complete) {
      out_.verdict = Regularity::Verdict::regular;
    }
    if (out_.verdict != Regularity::Verdict::regular || out_.collapsed > 0) out_.least = 0.0;
    return out_;
  }

 private:
  static constexpr int deepest = 60;     // 2^-30 in each direction
  static constexpr int first_zeros = 8;  // pieces of a 16th, on which zeros are first looked for
  static constexpr std::size_t most_singular = 16;
  static constexpr double most_suspects = 6000.0;
  static constexpr double cuts_of_a_zero = 16.0;  // what looking for one takes on a large net

  // A zero inside, and a radius within which there is no other.
  struct Known {
    dvec2 at;
    double radius;
  };

  const Surface& surface_;
  long budget_;
  double work_ = 0.0;
  double excess_ = 0.0;  // of a cut of the patch at hand, over one of a small net
  Regularity out_;
  int patch_ = 0;
  double noise_ = 0.0;
  int doublings_ = 0;  // of the patch at hand, as it is judged
  bool unproved_ = false;
  std::optional<ZeroFinder> finder_;  // of the patch at hand
  std::vector<Known> alone_;

  // Of what the sides' factors were divided out of, each of which may make its noise larger by the degree.
  void note_factor(int factors, int left) {
    out_.collapsed += factors > 0 ? 1 : 0;
    for (int k = 1; k <= factors; ++k) noise_ *= left + k;
  }

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
    finder_.emplace(normal, noise_);
    alone_.clear();
    left.push_back({std::move(normal), std::move(weight), std::move(corners), 0});
    std::vector<dvec2> suspects;
    // A cut takes the power 3/2 of the number of coefficients; below some 250 of them other things do.
    const double size = static_cast<double>(left.front().normal.coefficients.size());
    excess_ = size * std::sqrt(size) / 4096.0;
    const double work = 1.0 + excess_;
    while (!left.empty()) {
      const Piece<N, W> piece = std::move(left.back());
      left.pop_back();
      for (const dvec2& corner : piece.corners) note(corner);
      const double bound = lower_bound(piece);
      if (bound > 0.0 ? bound >= 0.5 * out_.least_found : settled(piece)) {
        if (bound > 0.0) out_.least = std::min(out_.least, bound);
        ++out_.pieces;
        continue;
      }
      work_ += work;
      out_.spent = work_ >= static_cast<double>(budget_);
      if (piece.depth >= deepest || out_.spent) {
        unproved_ = true;
        if (piece.depth >= deepest)
          suspects.insert(suspects.end(), piece.corners.begin(), piece.corners.end());
        if (static_cast<double>(suspects.size()) > most_suspects / work || piece.depth < deepest) break;
        continue;
      }
      auto parts = cut(piece);
      left.push_back(std::move(parts.first));
      left.push_back(std::move(parts.second));
    }
    for (const dvec2& at : suspects)
      if (const auto zero = finder_->from(at)) add(*zero, SingularPoint::Proof::none, 0.0);
  }

  // Whether all singular points on the piece are proved and listed.
  template <class N, class W>
  bool settled(const Piece<N, W>& piece) {
    if (const auto corner = only_zero_corner(piece)) {
      add(*corner, SingularPoint::Proof::exact, 0.0);
      return true;
    }
    if (piece.depth < first_zeros || piece.depth % 4 != 0) return false;
    if (within_known(piece)) return true;
    dvec2 middle(0.0);
    for (const dvec2& c : piece.corners) middle += c / static_cast<double>(piece.corners.size());
    work_ += cuts_of_a_zero * excess_;
    const auto zero = finder_->from(middle);
    if (!zero || glm::distance(*zero, middle) > 8.0 * glm::distance(piece.corners[0], piece.corners[1]))
      return false;
    const auto proof = finder_->proof(*zero);
    if (!proof || !proof->inside) return false;
    alone_.push_back({*zero, proof->alone});
    add(*zero, SingularPoint::Proof::unique, proof->within);
    return within_known(piece);
  }

  template <class N, class W>
  bool within_known(const Piece<N, W>& piece) const {
    return std::any_of(alone_.begin(), alone_.end(), [&](const Known& known) {
      return std::all_of(piece.corners.begin(), piece.corners.end(),
                         [&](const dvec2& c) { return glm::distance(c, known.at) < known.radius; });
    });
  }

  // A corner of the patch at which N vanishes, if it does so there and nowhere else on the piece: the one
  // corner whose coefficient is zero, and the rest of them, zeros apart, on one side of a plane. Zeros are
  // exact there and stay so when pieces are cut.
  template <class N, class W>
  std::optional<dvec2> only_zero_corner(const Piece<N, W>& piece) const {
    const std::vector<std::size_t> indices = corner_indices(piece.normal);
    std::optional<dvec2> found;
    for (std::size_t k = 0; k < indices.size(); ++k) {
      if (piece.normal.coefficients[indices[k]] != dvec3(0.0)) continue;
      const dvec2 corner = piece.corners[k];
      if (found || !is_end(corner.x) || !is_end(corner.y)) return {};
      found = corner;
    }
    if (!found) return {};
    std::vector<dvec3> rest;
    for (const dvec3& n : piece.normal.coefficients)
      if (n != dvec3(0.0)) rest.push_back(n);
    return separating_direction(rest, noise_at(piece.depth)) ? found : std::nullopt;
  }

  // Of |N| / w^3 on the piece, as it was before it was balanced.
  template <class N, class W>
  double lower_bound(const Piece<N, W>& piece) const {
    double largest_weight = 0.0;
    for (const double w : piece.weight.coefficients) largest_weight = std::max(largest_weight, std::abs(w));
    const double noise = noise_at(piece.depth);
    const std::optional<dvec3> direction = separating_direction(piece.normal.coefficients, noise);
    if (!direction) return 0.0;
    double low = std::numeric_limits<double>::infinity();
    for (const dvec3& n : piece.normal.coefficients) low = std::min(low, glm::dot(n, *direction));
    return std::ldexp((low - noise) / (largest_weight * largest_weight * largest_weight), -2 * doublings_);
  }

  // Halving adds half an eps of the coefficients at every level and degree.
  double noise_at(int depth) const { return noise_ * (1.0 + depth); }

  void add(const dvec2& at, SingularPoint::Proof proof, double within) {
    for (const SingularPoint& s : out_.singular)
      if (s.patch == patch_ && glm::distance(dvec2(s.u, s.v), at) < 1e-5) return;
    if (out_.singular.size() >= most_singular) {
      unproved_ = true;
      return;
    }
    out_.singular.push_back(
        {patch_, at.x, at.y, net_point(net(), at.x, at.y) + surface_.origin, proof, within});
  }
};

}  // namespace

Regularity regularity_of(const Surface& surface, long budget) { return Search(surface, budget).run(); }

}  // namespace rondure
