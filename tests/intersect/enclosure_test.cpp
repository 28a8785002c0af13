// Enclosures against exact arithmetic: what they stand for is inside, whatever is added, multiplied or
// divided.

#include "renderer/intersect/enclosure.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <random>

#include "tests/catch.h"

using namespace rondure;

namespace {

// Of two numbers of 64 bits with exponents within 2^9 of each other the sum is exact, and the product; the
// quotient and the root have 200 bits more than an end of the enclosure.
using Wide = boost::multiprecision::number<
    boost::multiprecision::backends::cpp_bin_float<1200, boost::multiprecision::backends::digit_base_2>>;

template <class T>
T draw(std::mt19937_64& random) {
  const auto bits = static_cast<std::int64_t>(random());
  const T x = std::ldexp(static_cast<T>(bits), -64 + static_cast<int>(random() % 512) - 256);
  return random() % 16 == 0 ? std::nearbyint(x) : x;  // some short ones, whose results are exact
}

template <class T>
struct Tally {
  long tried = 0, lost = 0;
  T widest = 0;  // in ulps of the result
  void add(const Enclosure<T>& e, const Wide& exact) {
    ++tried;
    lost += !(Wide(e.low) <= exact && exact <= Wide(e.high));
    const T magnitude = std::abs(static_cast<T>(exact));
    if (magnitude > 0)
      widest = std::max(widest, (e.high - e.low) / (magnitude * std::numeric_limits<T>::epsilon()));
  }
};

template <class T>
void check() {
  std::mt19937_64 random(3);
  Tally<T> sum, difference, product, quotient, root;
  for (int k = 0; k < 20'000; ++k) {
    const T a = draw<T>(random), b = draw<T>(random);
    const Enclosure<T> x{a, a}, y{b, b};
    sum.add(x + y, Wide(a) + Wide(b));
    difference.add(x - y, Wide(a) - Wide(b));
    product.add(x * y, Wide(a) * Wide(b));
    if (b != 0) quotient.add(x / y, Wide(a) / Wide(b));
    const T positive = std::abs(a);
    root.add(sqrt(Enclosure<T>{positive, positive}), boost::multiprecision::sqrt(Wide(positive)));
  }
  for (const Tally<T>& tally : {sum, difference, product, quotient, root}) {
    INFO(tally.lost << " of " << tally.tried << " lost, widest " << tally.widest << " ulps");
    CHECK(tally.lost == 0);
    // Two ulps of an operation, and two more of the reciprocal in a quotient, each of up to twice the
    // result's.
    CHECK(tally.widest <= 9);
  }
  // Wide ones: any of their members gives a member of the result.
  long outside = 0;
  for (int k = 0; k < 20'000; ++k) {
    const auto pair = [&] {
      const T a = draw<T>(random), b = draw<T>(random);
      return Enclosure<T>{std::min(a, b), std::max(a, b)};
    };
    const Enclosure<T> x = pair(), y = pair();
    for (const T a : {x.low, x.high, x.low / 2 + x.high / 2})
      for (const T b : {y.low, y.high, y.low / 2 + y.high / 2}) {
        const auto in = [&](const Enclosure<T>& e, const Wide& exact) {
          outside += !(Wide(e.low) <= exact && exact <= Wide(e.high));
        };
        in(x + y, Wide(a) + Wide(b)), in(x - y, Wide(a) - Wide(b)), in(x * y, Wide(a) * Wide(b));
        if (y.low > 0 || y.high < 0) in(x / y, Wide(a) / Wide(b));
      }
  }
  CHECK(outside == 0);
  CHECK(std::isinf((Enclosure<T>{1, 1} / Enclosure<T>{-1, 1}).high));
}

}  // namespace

TEST_CASE("Enclosures contain what they stand for", "[certificate]") {
  check<double>();
  check<long double>();
}
