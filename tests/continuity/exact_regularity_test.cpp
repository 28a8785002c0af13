// Exact proofs of regularity close to singular points, on sides, and of nets of any scale.
#include "renderer/continuity/exact_regularity.h"

#include "tests/catch.h"
#include "tests/surfaces/build_family.h"

namespace rondure {
namespace {

using Verdict = Regularity::Verdict;

ExactRegularity certified_exactly(const Surface& surface) {
  return exact_regularity(surface, regularity_of(surface));
}

// Whitney's umbrella (U V, U, V^2) with U = u - at.x, V = v - at.y: one singular point, there.
Surface umbrella(const dvec2& at) {
  TensorNet net(1, 2);
  for (int i = 0; i <= 1; ++i) {
    for (int j = 0; j <= 2; ++j) {
      const double x = i - at.x, first = (j > 0 ? 1 : 0) - at.y, second = (j > 1 ? 1 : 0) - at.y;
      net.at(i, j) = dvec4(0.5 * x * (first + second), x, first * second, 1);
    }
  }
  Surface surface;
  surface.patches.emplace_back(net);
  return surface;
}

}  // namespace

TEST_CASE("a pinch just outside a patch is told from one inside", "[regularity]") {
  for (const double distance : {1e-3, 1e-7}) {
    const Surface outside = umbrella({-distance, 0.3}), inside = umbrella({distance, 0.3});
    CAPTURE(distance);
    const Regularity r = regularity_of(outside);
    CHECK(r.verdict == Verdict::regular);
    // |Su x Sv|^2 = U^2 + 4 V^2 + 4 V^4 is at least the square of the distance.
    CHECK(r.least <= distance * (1 + 1e-9));
    CHECK(r.least > 0.3 * distance);
    CHECK(certified_exactly(outside).verdict == Verdict::regular);
    CHECK(regularity_of(inside).verdict == Verdict::singular);
    CHECK(certified_exactly(inside).verdict == Verdict::singular);
  }
  // In integers no distance is too small.
  const ExactRegularity near = certified_exactly(umbrella({-1e-12, 0.3}));
  CHECK(near.verdict == Verdict::regular);
  CHECK(near.least <= 1e-12 * (1 + 1e-9));
  CHECK(near.deepest > 60);
  // Nor where rounding made it look singular before.
  for (const double distance : {0x1p-45, 0x1p-52}) {
    const ExactRegularity nearest = certified_exactly(umbrella({-distance, 0.25}));
    CHECK(nearest.verdict == Verdict::regular);
    CHECK(nearest.least <= distance * (1 + 1e-9));
    CHECK(nearest.least > 0.3 * distance);
  }
}

// (U V, U, V^2) with U = 3 u - 1, V = 3 v: its coefficients are integers, and its singular point is at (1/3,
// 0).
TEST_CASE("a pinch on a side is proved at thirds, in integers", "[regularity]") {
  TensorNet net(1, 2);
  for (int i = 0; i <= 1; ++i) {
    const int x = 3 * i - 1;
    for (int j = 0; j <= 2; ++j) net.at(i, j) = dvec4(3 * x * j, 2 * x, j == 2 ? 18 : 0, 2);
  }
  Surface surface;
  surface.patches.emplace_back(net);
  const ExactRegularity pinch = certified_exactly(surface);
  CHECK(pinch.verdict == Verdict::singular);
  REQUIRE(pinch.singular.size() == 1);
  CHECK(std::abs(pinch.singular[0].at.u - 1.0 / 3.0) <= pinch.singular[0].within);
  CHECK(pinch.singular[0].at.v <= pinch.singular[0].within);
  CHECK(pinch.singular[0].within < 1e-8);
}

TEST_CASE("regularity is judged whatever the size of weights, and without needless pieces", "[regularity]") {
  const Surface plain = build_family(R"({"type": "gc_octahedron"})");
  const Regularity judged = regularity_of(plain);
  for (const double size : {0x1p300, 0x1p-300}) {
    Surface sized = plain;
    for (Net& net : sized.patches)
      for (dvec4& p : points_of(net)) p *= size;
    const Regularity same = regularity_of(sized);
    CHECK(same.verdict == Verdict::regular);
    CHECK(same.pieces == judged.pieces);
    CHECK(same.least == judged.least);
    CHECK(certified_exactly(sized).verdict == Verdict::regular);
  }
  // Normals differ by 10^6 in length here: a plane must lie well for all of them.
  Surface flat = plain;
  for (Net& net : flat.patches)
    for (dvec4& p : points_of(net)) p.x *= 0x1p-10, p.z *= 0x1p10;
  const ExactRegularity proof = certified_exactly(flat);
  CHECK(proof.verdict == Verdict::regular);
  CHECK(proof.pieces < 1000);
}

}  // namespace rondure
