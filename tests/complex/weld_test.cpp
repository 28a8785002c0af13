// Common edges of neighbours, to the last bit.
#include <fmt/format.h>

#include <array>
#include <map>

#include "tests/catch.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;

TEST_CASE("Neighbours of a complex share their edges to the last bit", "[complex]") {
  // By rounding of irrational coefficients they would be apart by a few roundoffs: enough for a ray to pass.
  const std::string complex = GENERATE(R"({"torus": [6, 3]})", R"({"torus": [4, 3]})", R"("cube")");
  INFO(complex);
  const Surface surface =
      build_family(fmt::format(R"({{"type": "gc_complex", "complex": {}, "degree": 3}})", complex));
  REQUIRE(surface.closed);
  std::map<std::array<double, 4>, int>
      count;  // of control points on edges: each point of an edge is in two nets
  for (const Net& net : surface.patches) {
    const auto& t = std::get<TensorNet>(net);
    for (int i = 0; i <= t.m; ++i)
      for (int j = 0; j <= t.n; ++j)
        if (i == 0 || j == 0 || i == t.m || j == t.n) {
          const dvec4 p = t.at(i, j);
          ++count[{p.x, p.y, p.z, p.w}];
        }
  }
  int alone = 0;
  for (const auto& [point, times] : count) alone += times < 2;
  CHECK(alone == 0);
}

TEST_CASE("Edges shorter than what rounding leaves keep their ends apart", "[complex]") {
  // A cube 2e-14 thick: an edge across it lies within the welding distance from its reverse.
  const Surface surface = build_family(R"({"type": "gc_complex", "complex": {"polygons": [
      [0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]}, "vertices": [
      [-1, -1, -1e-14], [1, -1, -1e-14], [1, 1, -1e-14], [-1, 1, -1e-14],
      [-1, -1, 1e-14], [1, -1, 1e-14], [1, 1, 1e-14], [-1, 1, 1e-14]]})");
  std::map<std::array<double, 3>, int> corners;
  for (const Net& net : surface.patches) {
    const auto& t = std::get<TensorNet>(net);
    for (const dvec4& p : {t.at(0, 0), t.at(t.m, 0), t.at(0, t.n), t.at(t.m, t.n)})
      ++corners[{p.x, p.y, p.z}];
  }
  CHECK(corners.size() == 8);
  int shared = 0;
  for (const auto& [point, times] : corners) shared += times == 3;
  CHECK(shared == 8);
}
