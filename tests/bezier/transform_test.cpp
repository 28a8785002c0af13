// Which maps mirror, whatever their scale.
#include "renderer/bezier/transform.h"

#include <fmt/format.h>

#include <cmath>

#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

bool same_points(const Net& a, const Net& b) { return points_of(a) == points_of(b); }

TEST_CASE("a map mirrors at every scale or at none", "[bezier]") {
  NetMaker make(91);
  const Net net = make.tensor(2, 2);
  WorstCase wrong;
  int mirrored = 0;
  for (int k = 0; k < 200; ++k) {
    // Far from singular, so that the sign of the unscaled determinant is beyond doubt: a signed permutation.
    dmat4 map(0.0);
    int order[3] = {0, 1, 2};
    std::swap(order[0], order[k % 3]);
    std::swap(order[1], order[1 + k % 2]);
    double sign = (k % 3 != 0 ? -1.0 : 1.0) * (k % 2 != 0 ? -1.0 : 1.0);
    int exponent[3];
    for (int i = 0; i < 3; ++i) {
      // Uniform scales, and scales that differ by axis, down to the smallest normal doubles.
      exponent[i] = k < 100 ? -10 * k : static_cast<int>(make.uniform(-1000.0, 1000.0));
      const double entry = make.uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
      sign *= entry;
      map[i][order[i]] = std::ldexp(entry, exponent[i]);
    }
    map[3][3] = 1.0;
    mirrored += sign < 0.0;
    const Net turned = sign < 0.0 ? reversed(net) : net;
    Net expected = turned;
    for (dvec4& p : points_of(expected)) p = map * p;
    wrong.add(same_points(transformed(net, map), expected) ? 0.0 : 1.0, 0.5, [&] {
      return fmt::format("scales 2^{}, 2^{}, 2^{}, sign {}", exponent[0], exponent[1], exponent[2], sign);
    });
  }
  INFO(wrong.text());
  CHECK(wrong.failures() == 0);
  CHECK(mirrored > 50);
  CHECK(mirrored < 150);
}

TEST_CASE("a map that flattens does not mirror", "[bezier]") {
  NetMaker make(92);
  const Net net = make.triangle(2);
  dmat4 flat(1.0);
  flat[1] = dvec4(0.0);
  Net expected = net;
  for (dvec4& p : points_of(expected)) p = flat * p;
  CHECK(same_points(transformed(net, flat), expected));
}

}  // namespace
}  // namespace rondure
