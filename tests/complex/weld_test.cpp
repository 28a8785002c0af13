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
