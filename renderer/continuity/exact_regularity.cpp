#include "renderer/continuity/exact_regularity.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "renderer/bezier/rational.h"
#include "renderer/continuity/exact_normal.h"
#include "renderer/continuity/exact_zero.h"
#include "renderer/continuity/pieces.h"
#include "renderer/continuity/separating_direction.h"

namespace rondure {
namespace {

using Verdict = Regularity::Verdict;

long bits_of(const Integer& x) { return x == 0 ? 0 : static_cast<long>(msb(abs(x))) + 1; }

// x = mantissa 2^exponent, good to an eps.
struct Split {
  double mantissa = 0.0;
  long exponent = 0;
};
Split split(const Integer& x) {
  const long drop = std::max(bits_of(x) - 60, 0L);
  return {Integer(x / (Integer(1) << drop)).convert_to<double>(), drop};
}

class Proof {
 public:
  Proof(const Surface& surface, const Regularity& rounded, double most_work)
      : surface_(surface), rounded_(rounded), left_(most_work) {}

  ExactRegularity run() {
    out_.least = INFINITY;
    least_found_ = rounded_.least_found;
    prove_zeros();
    if (out_.singular.empty()) {
      // What only rounding made look singular stays so unless all of the surface is proved to be regular.
      const std::vector<SingularPoint> suspects = std::exchange(out_.undecided, {});
      for (patch_ = 0; patch_ < static_cast<int>(surface_.patches.size()) && !out_.spent; ++patch_) {
        const IntegerNet net = integer_net(surface_.patches[static_cast<std::size_t>(patch_)]);
        const std::optional<ExactNormal> normal = exact_normal(net);
        if (!normal) {
          leave(dvec2(1.0 / 3.0));
          continue;
        }
        normal_ = &*normal;
        weight_exponent_ = net.exponent[1];
        out_.collapsed += normal->divided > 0 ? 1 : 0;
        if (const auto* tensor = std::get_if<TensorPolynomial<IntegerVector>>(&normal->normal)) {
          search(*tensor, TensorPolynomial<Integer>(net.m, net.n, weights(net)), whole_square());
        } else {
          search(std::get<TrianglePolynomial<IntegerVector>>(normal->normal),
                 TrianglePolynomial<Integer>(net.n, weights(net)), whole_triangle());
        }
      }
      if (!out_.undecided.empty() || out_.spent) keep(suspects);
    }
    if (!out_.singular.empty()) {
      out_.verdict = Verdict::singular;
    } else if (out_.undecided.empty() && !out_.spent && !surface_.patches.empty()) {
      out_.verdict = Verdict::regular;
    }
    if (out_.verdict != Verdict::regular || out_.collapsed > 0) out_.least = 0.0;
    return out_;
  }

 private:
  static constexpr int deepest = 120;
  static constexpr std::size_t most_undecided = 16;
  static constexpr int most_stuck = 8;  // pieces of a patch that end without a proof

  const Surface& surface_;
  const Regularity& rounded_;
  double left_;  // work
  double least_found_ = 0.0;
  ExactRegularity out_;
  int patch_ = 0;
  const ExactNormal* normal_ = nullptr;
  int weight_exponent_ = 0;

  static std::vector<Integer> weights(const IntegerNet& net) {
    std::vector<Integer> out;
    for (const auto& p : net.points) out.push_back(p[3]);
    return out;
  }

  void spend(double words) {
    left_ -= words;
    if (left_ < 0.0) out_.spent = true;
  }

  void prove_zeros() {
    for (const SingularPoint& s : rounded_.singular) {
      if (out_.spent) {
        out_.undecided.push_back(s);
        continue;
      }
      const IntegerNet net = integer_net(surface_.patches[static_cast<std::size_t>(s.patch)]);
      // Products of polynomials about the place, of numbers of some 52 bits a degree.
      // Of a square, some of which do not tell; the first one does as a rule.
      const double square = 4.0 * std::pow(net.m + 1.0, 3) * std::pow(net.n + 1.0, 3) * (net.m + net.n);
      const int squares = static_cast<int>(std::clamp(left_ / square, 1.0, 5.0));
      if (const auto within = proved_zero(net, s.u, s.v, squares)) {
        spend(0.25 * square);
        out_.singular.push_back({s, *within});
      } else {
        spend(square * squares);
        out_.undecided.push_back(s);
      }
    }
  }

  // Before what the search left, which lies beside them as a rule.
  void keep(std::vector<SingularPoint> suspects) {
    suspects.swap(out_.undecided);
    for (const SingularPoint& s : suspects) patch_ = s.patch, leave(dvec2(s.u, s.v));
  }

  // A value that |Su x Sv| takes.
  void note(const dvec2& at) {
    const SurfaceJet jet = surface_jet(surface_.patches[static_cast<std::size_t>(patch_)], at.x, at.y);
    least_found_ = std::min(least_found_, glm::length(glm::cross(jet.du, jet.dv)));
  }

  void leave(const dvec2& at) {
    for (const SingularPoint& s : out_.undecided) {
      if (s.patch == patch_ && glm::distance(dvec2(s.u, s.v), at) < 1e-4) return;
    }
    if (out_.undecided.size() >= most_undecided) return;
    const Net& net = surface_.patches[static_cast<std::size_t>(patch_)];
    out_.undecided.push_back({patch_, at.x, at.y, net_point(net, at.x, at.y) + surface_.origin});
  }

  template <class N, class W>
  void search(N normal, W weight, std::vector<dvec2> corners) {
    int stuck = 0;
    std::vector<Piece<N, W>> left;
    left.push_back({std::move(normal), std::move(weight), std::move(corners), 0});
    while (!left.empty()) {
      const Piece<N, W> piece = std::move(left.back());
      left.pop_back();
      out_.deepest = std::max(out_.deepest, piece.depth);
      for (const dvec2& corner : piece.corners) note(corner);
      const double bound = lower_bound(piece);
      if (bound >= 0.5 * least_found_ && bound > 0.0) {
        out_.least = std::min(out_.least, bound);
        ++out_.pieces;
        continue;
      }
      if (piece.depth >= deepest || out_.spent) {
        dvec2 centre(0.0);
        for (const dvec2& c : piece.corners) centre += c / static_cast<double>(piece.corners.size());
        leave(centre);
        if (out_.spent || ++stuck == most_stuck) return;
        continue;
      }
      auto parts = cut(piece);
      left.push_back(std::move(parts.first));
      left.push_back(std::move(parts.second));
    }
  }

  // Of |N| / w^3 on the piece; 0 where no plane is found.
  template <class N, class W>
  double lower_bound(const Piece<N, W>& piece) {
    const std::vector<IntegerVector>& n = piece.normal.coefficients;
    long bits = 0;
    for (const IntegerVector& c : n) bits = std::max({bits, bits_of(c.x), bits_of(c.y), bits_of(c.z)});
    const double words = 1.0 + static_cast<double>(bits) / 64.0;
    // A halving of each run takes half of the square of its length, in three coordinates.
    spend(words * static_cast<double>(n.size()) * 1.5 * std::sqrt(static_cast<double>(n.size())));
    const long drop = std::max(bits - 60, 0L);
    const auto rounded_part = [&](const Integer& x) {
      return Integer(x / (Integer(1) << drop)).convert_to<double>();
    };
    std::vector<dvec3> rounded;
    for (const IntegerVector& c : n)
      rounded.emplace_back(rounded_part(c.x), rounded_part(c.y), rounded_part(c.z));
    Integer most = 0;
    for (const Integer& w : piece.weight.coefficients) most = std::max(most, Integer(abs(w)));
    if (most == 0) return 0.0;
    const Split weight = split(most);
    // |Su x Sv| where N has length 1 is `share` 2^scale.
    const double share = normal_->factor / (weight.mantissa * weight.mantissa * weight.mantissa);
    const long scale = normal_->exponent - doublings(piece.normal, piece.depth) -
                       3 * (weight.exponent + weight_exponent_ - doublings(piece.weight, piece.depth));
    const double needed = std::ldexp(0.5 * least_found_ / share, static_cast<int>(-scale - drop));
    const std::optional<dvec3> direction =
        separating_direction(rounded, std::isfinite(needed) ? needed : 0.0);
    if (!direction) return 0.0;
    const auto whole = [&](int d) {
      return static_cast<std::int64_t>(std::llround(0x1p52 * (*direction)[d]));
    };
    const std::int64_t a[3] = {whole(0), whole(1), whole(2)};
    Integer low = 0;
    for (std::size_t k = 0; k < n.size(); ++k) {
      const Integer height = a[0] * n[k].x + a[1] * n[k].y + a[2] * n[k].z;
      if (height <= 0) return 0.0;
      if (k == 0 || height < low) low = height;
    }
    const Split height = split(low);
    const double length =
        std::hypot(static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2]));
    const double mantissa = height.mantissa / length * share;
    // A dozen roundings of an eps each, the least of it downwards.
    return std::ldexp(mantissa * (1.0 - 0x1p-48), static_cast<int>(height.exponent + scale));
  }

  // By how many powers of 2 a polynomial has grown in `depth` cuts: those of u, and in turn of v.
  template <class T>
  static long doublings(const TrianglePolynomial<T>& p, int depth) {
    return static_cast<long>(p.n) * depth;
  }
  template <class T>
  static long doublings(const TensorPolynomial<T>& p, int depth) {
    // u and v are exchanged at every cut: the last one was along what is v now.
    return static_cast<long>(p.n) * ((depth + 1) / 2) + static_cast<long>(p.m) * (depth / 2);
  }
};

}  // namespace

ExactRegularity exact_regularity(const Surface& surface, const Regularity& rounded, double most_work) {
  return Proof(surface, rounded, most_work).run();
}

}  // namespace rondure
