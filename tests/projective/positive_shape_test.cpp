// The search for shapes of positive weights among the patches between given arcs.
#include "renderer/projective/positive_shape.h"

#include <fmt/format.h>

#include "renderer/projective/orientation.h"
#include "tests/catch.h"
#include "tests/projective/off_arcs.h"
#include "tests/projective/random_arcs.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using Outcome = PositiveShape::Outcome;

bool is_positive(const Preimage& preimage) {
  const Net net = sphere_image(preimage);
  const auto& points = points_of(net);
  return std::all_of(points.begin(), points.end(), [](const dvec4& p) { return p.w > 0.0; });
}

// Ratios up to a factor of `most` from 1, turns that keep the phases of all sides within half a turn.
Shape random_shape(NetMaker& make, const PreimageFamily& family, double most) {
  while (true) {
    Shape shape;
    for (std::size_t k = 0; k < family.ratios; ++k)
      shape.ratio[k] = std::exp(make.uniform(-1, 1) * std::log(most));
    for (std::size_t k = 0; k < family.turns; ++k) shape.turn[k] = make.uniform(-3.2, 3.2);
    if (within_half_turns(family, shape)) return shape;
  }
}

// N arcs around an axis, corners `low` to `high` degrees from it, arcs that bulge. Interior angles 3 to 177
// degrees.
template <std::size_t N>
std::array<SphereArc, N> around_axis(NetMaker& make, double low, double high) {
  const auto at = [](long double around, long double away) {
    return lvec3(std::sin(away) * std::cos(around), std::sin(away) * std::sin(around), std::cos(away));
  };
  while (true) {
    std::array<long double, N + 1> turn, away;
    for (std::size_t k = 0; k < N; ++k) {
      turn[k] = (static_cast<long double>(k) + make.uniform(0.1, 0.9)) * 2 * pi / N;
      away[k] = make.uniform(low, high) * pi / 180;
    }
    turn[N] = turn[0] + 2 * pi, away[N] = away[0];
    std::array<SphereArc, N> arc;
    bool good = true;
    for (std::size_t k = 0; k < N; ++k) {
      good = good && turn[k + 1] - turn[k] < 3;
      const long double middle = (turn[k] + turn[k + 1]) / 2 + make.uniform(-0.15, 0.15);
      const long double out = (away[k] + away[k + 1]) / 2 + make.uniform(-0.3, 0.3);
      arc[k] = arc_through(at(turn[k], away[k]), at(middle, out), at(turn[k + 1], away[k + 1]));
    }
    for (std::size_t k = 0; k < N; ++k) {
      const lvec3 ahead = arc[k].start_tangent(), back = -arc[(k + N - 1) % N].end_tangent();
      const long double angle =
          std::atan2(glm::dot(arc[k].p, glm::cross(ahead, back)), glm::dot(ahead, back));
      good = good && angle > 3 * pi / 180 && angle < 177 * pi / 180;
    }
    if (good) return arc;
  }
}

// The outcomes of the search in families that have a regular member at least, but none of positive weights
// where ratios are 1 and turns 0.
struct ShapeTally {
  int positive = 0, found = 0, none = 0, undecided = 0, wrong = 0, contradicted = 0;

  void add(NetMaker& make, const std::vector<PreimageFamily>& families) {
    std::vector<const PreimageFamily*> regular;
    bool even = false;
    for (const PreimageFamily& family : families) {
      const Preimage preimage = preimage_at(family, {});
      if (!regularity(preimage).regular) continue;
      regular.push_back(&family);
      even = even || is_positive(preimage);
    }
    if (even) {
      ++positive;
      return;
    }
    for (const PreimageFamily* family : regular) {
      const PositiveShape result = positive_shape(*family);
      found += result.outcome == Outcome::found;
      none += result.outcome == Outcome::none;
      undecided += result.outcome == Outcome::undecided;
      if (result.outcome == Outcome::found) {
        const Preimage preimage = preimage_at(*family, result.shape);
        wrong += !is_positive(preimage) || !regularity(preimage).regular || !(result.least > 0);
      }
      if (result.outcome == Outcome::none) {
        for (int k = 0; k < 300; ++k)
          contradicted += is_positive(preimage_at(*family, random_shape(make, *family, widest_ratio)));
      }
    }
  }

  std::string text() const {
    return fmt::format("positive at once {}, found {}, none {}, undecided {}, wrong {}, contradicted {}",
                       positive, found, none, undecided, wrong, contradicted);
  }
};

}  // namespace

TEST_CASE("all shapes of a family have the same sides", "[projective]") {
  NetMaker make(61);
  WorstCase worst;
  for (int k = 0; k < 100; ++k) {
    const SphericalQuad quad = bulging(make, 0.3);
    const auto ring = around_axis<3>(make, 20, 90);
    const SphericalTriangle triangle{ring};
    const auto text = [&] { return fmt::format("case {}", k); };
    for (const PreimageFamily& family : {linear_quadratic_family(quad), quadratic_linear_family(quad)}) {
      const Shape shape = random_shape(make, family, 4);
      const Preimage preimage = preimage_at(family, shape);
      const Net net = sphere_image(preimage);
      worst.add(off_circles(std::get<TensorNet>(net), quad), 1e-13, text);
      worst.add(off_corners(net, quad), 1e-13, text);
      const auto& p = std::get<TensorPreimage>(preimage);
      const auto size = [&](int i, int j) { return glm::length(p.at(i * p.m, j * p.n)); };
      const long double ratio = size(0, 0) * size(1, 1) / (size(1, 0) * size(0, 1));
      worst.add(static_cast<double>(std::abs(ratio / shape.ratio[0] - 1)), 1e-16, text);
    }
    const PreimageFamily family = quadratic_family(triangle);
    const Net net = sphere_image(preimage_at(family, random_shape(make, family, 4)));
    worst.add(off_circles(std::get<TriangleNet>(net), triangle), 1e-13, text);
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

// With corners of length 1 in the right phases only one weight of a bilinear family depends on the shape s:
// it is s A + B times a positive number, where A and B are the products of opposite corners.
TEST_CASE("the search agrees with the closed form of the biquadratic patch", "[projective]") {
  NetMaker make(62);
  int found = 0, none = 0, differ = 0, undecided = 0;
  for (int k = 0; k < 400; ++k) {
    const SphericalQuad quad = quad_of(k % 2 == 0 ? square_bilinear(make) : random_bilinear(make));
    const PreimageFamily family = bilinear_family(quad);
    const TensorPreimage p = bilinear_preimage(quad, 1);
    if (!regularity(p).regular) continue;
    const long double a = glm::dot(p.at(0, 0), p.at(1, 1)), b = glm::dot(p.at(1, 0), p.at(0, 1));
    bool exists = a * widest_ratio + b > 1e-3L || a / widest_ratio + b > 1e-3L;
    const bool doubtful = !exists && (a * widest_ratio + b > 0 || a / widest_ratio + b > 0);
    for (const SphereArc& arc : quad.arc) exists = exists && arc.w > 0;
    const PositiveShape result = positive_shape(family);
    found += result.outcome == Outcome::found;
    none += result.outcome == Outcome::none;
    undecided += result.outcome == Outcome::undecided;
    if (result.outcome == Outcome::found) {
      const Preimage best = preimage_at(family, result.shape);
      differ += !exists || !is_positive(best) || !regularity(best).regular;
    } else {
      differ += exists && !doubtful;
    }
  }
  INFO(fmt::format("found {}, none {}, undecided {}", found, none, undecided));
  CHECK(differ == 0);
  CHECK(undecided == 0);
  CHECK(found > 50);
  CHECK(none > 5);
}

TEST_CASE("positive weights are found, or proved not to exist", "[projective]") {
  NetMaker make(63);
  ShapeTally quads, triangles, large;
  for (int k = 0; k < 20; ++k) {
    const auto four = around_axis<4>(make, 60, 130);
    quads.add(make, {linear_quadratic_family({four}), quadratic_linear_family({four})});
    triangles.add(make, {quadratic_family({around_axis<3>(make, 60, 120)})});
    const auto wide = around_axis<4>(make, 90, 150);
    large.add(make, {linear_quadratic_family({wide}), quadratic_linear_family({wide})});
  }
  for (const ShapeTally* tally : {&quads, &triangles, &large}) {
    INFO(tally->text());
    CHECK(tally->wrong == 0);
    CHECK(tally->contradicted == 0);
    CHECK(tally->undecided == 0);
    CHECK(tally->found + tally->none > 12);
  }
  INFO(quads.text() << "; " << triangles.text() << "; " << large.text());
  CHECK(quads.found > 5);
  CHECK(triangles.found > 5);
  CHECK(large.none > 25);
}

TEST_CASE("the search gives the same shape always", "[projective]") {
  NetMaker make(64);
  int different = 0;
  for (int k = 0; k < 5; ++k) {
    const PreimageFamily family = linear_quadratic_family({around_axis<4>(make, 60, 100)});
    const PositiveShape first = positive_shape(family), again = positive_shape(family);
    different += first.outcome != again.outcome || first.boxes != again.boxes ||
                 first.shape.ratio != again.shape.ratio || first.shape.turn != again.shape.turn;
  }
  CHECK(different == 0);
}

}  // namespace rondure
