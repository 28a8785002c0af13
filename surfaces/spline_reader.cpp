#include "surfaces/spline_reader.h"

#include <algorithm>
#include <cmath>

#include "surfaces/read_numbers.h"

namespace rondure {

lvec4 read_preimage_point(const Params& params, const Value& value) {
  const auto p =
      read_numbers<4>(params, value, "a control point", "an array of four numbers, [p0, p1, p2, p3]");
  return {p[0], p[1], p[2], p[3]};
}

std::vector<long double> read_knots(const Params& params, const Value& list) {
  std::vector<long double> knots;
  if (list.kind != Value::Kind::array) params.fail(list, "knots are an array of numbers");
  for (const Value& item : list.items) {
    if (item.kind != Value::Kind::number || !std::isfinite(item.number))
      params.fail(item, "a knot must be a finite number");
    knots.push_back(item.number);
  }
  return knots;
}

std::vector<long double> clamped_knots(int degree, std::size_t points) {
  std::vector<long double> knots;
  const auto d = static_cast<std::size_t>(degree);
  for (std::size_t k = 0; k < points + d + 1; ++k)
    knots.push_back(static_cast<long double>(std::min(std::max(k, d), points) - d));
  return knots;
}

}  // namespace rondure
