#include "surfaces/quadric_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rondure {
namespace {

using Kind = Value::Kind;

constexpr const char* names[] = {"ellipsoid", "two_sheets", "one_sheet", "elliptic_paraboloid",
                                 "hyperbolic_paraboloid"};
constexpr QuadricKind kinds[] = {QuadricKind::ellipsoid, QuadricKind::two_sheets, QuadricKind::one_sheet,
                                 QuadricKind::elliptic_paraboloid, QuadricKind::hyperbolic_paraboloid};

lmat4 read_matrix(Params& params) {
  const Value& rows = *params.raw("matrix");
  const char* const form = "\"matrix\" must be four rows of four numbers, the symmetric B of x^T B x = 0";
  if (rows.kind != Kind::array || rows.items.size() != 4) params.fail(rows, form);
  lmat4 matrix(0);
  long double largest = 0;
  for (int i = 0; i < 4; ++i) {
    const Value& row = rows.items[static_cast<std::size_t>(i)];
    if (row.kind != Kind::array || row.items.size() != 4) params.fail(row, form);
    for (int j = 0; j < 4; ++j) {
      const Value& entry = row.items[static_cast<std::size_t>(j)];
      if (entry.kind != Kind::number || !std::isfinite(entry.number)) params.fail(entry, form);
      matrix[j][i] = entry.number;
      largest = std::max(largest, std::abs(matrix[j][i]));
    }
  }
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) {
      if (!(std::abs(matrix[j][i] - matrix[i][j]) <= 1e-12L * largest))
        params.fail(rows, fmt::format("\"matrix\" must be symmetric; row {}, column {} and row {}, column {} "
                                      "differ",
                                      i, j, j, i));
    }
  }
  return largest > 0 ? matrix / largest : matrix;
}

}  // namespace

Quadric read_quadric(Params& params) {
  if (params.has("matrix")) {
    for (const char* other : {"quadric", "semi_axes"}) {
      if (params.has(other))
        params.fail(other, fmt::format("\"matrix\" says all: give it without \"{}\"", other));
    }
    const auto found = classify(read_matrix(params));
    if (const auto* quadric = std::get_if<Quadric>(&found)) return *quadric;
    params.fail("matrix", fmt::format("this is {}; patches exist on ellipsoids, hyperboloids and paraboloids",
                                      std::get<std::string>(found)));
  }
  const std::string name =
      params.choice("quadric", {names[0], names[1], names[2], names[3], names[4]}, names[0]);
  const auto at = std::find(std::begin(names), std::end(names), name) - std::begin(names);
  const dvec3 semi_axes = params.vec3("semi_axes", dvec3(1.0), Range::positive());
  return {kinds[at], lvec3(semi_axes), lmat4(1)};
}

ParameterDoc quadric_doc() {
  return {
      "quadric",
      "\"ellipsoid\", \"two_sheets\", \"one_sheet\", \"elliptic_paraboloid\" or \"hyperbolic_paraboloid\"",
      "\"ellipsoid\"",
      "x^2/a^2 + y^2/b^2 + z^2/c^2 = 1; z^2/c^2 - x^2/a^2 - y^2/b^2 = 1; x^2/a^2 + y^2/b^2 - z^2/c^2 = 1; "
      "z/c = x^2/a^2 + y^2/b^2; z/c = x^2/a^2 - y^2/b^2"};
}

ParameterDoc semi_axes_doc() { return {"semi_axes", "three numbers > 0", "[1, 1, 1]", "a, b and c"}; }

ParameterDoc matrix_doc() {
  return {"matrix", "4x4 symmetric matrix, as rows", "none",
          "instead of quadric and semi_axes: B of x^T B x = 0 with x = (x, y, z, 1). The kind is found from "
          "it, with frame and semi-axes; cones, cylinders, planes and imaginary quadrics are refused"};
}

}  // namespace rondure
