#include "renderer/scene/transform_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

namespace rondure {
namespace {

// Columns brought to length one, so that the size of the scale does not count. Below 16 ulp the directions
// that are left differ by rounding alone.
template <int N>
bool is_singular(glm::mat<N, N, double> matrix) {
  for (int j = 0; j < N; ++j) {
    double largest = 0.0;
    for (int i = 0; i < N; ++i) largest = std::fmax(largest, std::fabs(matrix[j][i]));
    if (!(largest > 0.0)) return true;
    matrix[j] /= largest;
    matrix[j] /= glm::length(matrix[j]);
  }
  return !(std::fabs(glm::determinant(matrix)) > 16.0 * std::numeric_limits<double>::epsilon());
}

dmat4 read_matrix(const Params& object, const Value& value) {
  dmat4 matrix(0.0);
  const char* wanted = "\"transform\" must be a 4x4 matrix (four rows of four numbers) or a list of steps";
  if (value.items.size() != 4) object.fail(value, wanted);
  for (int row = 0; row < 4; ++row) {
    const Value& items = value.items[static_cast<std::size_t>(row)];
    if (items.kind != Value::Kind::array || items.items.size() != 4) object.fail(items, wanted);
    for (int column = 0; column < 4; ++column) {
      const Value& item = items.items[static_cast<std::size_t>(column)];
      if (item.kind != Value::Kind::number) object.fail(item, wanted);
      matrix[column][row] = item.number;
    }
  }
  const bool affine = matrix[0][3] == 0.0 && matrix[1][3] == 0.0 && matrix[2][3] == 0.0;
  if (affine && matrix[3][3] != 0.0) matrix /= matrix[3][3];
  const bool singular = is_affine(matrix) ? is_singular<3>(dmat3(matrix)) : is_singular<4>(matrix);
  if (singular) object.fail(value, "\"transform\" is singular: it flattens the surface");
  return matrix;
}

dmat4 read_rotation(Params step) {
  const dvec3 axis = step.vec3("axis");
  const double angle = step.number("angle");
  step.finish();
  if (axis == dvec3(0.0)) step.fail("axis", "\"axis\" must not be zero");
  return dmat4(rotation(axis, angle));
}

dmat4 read_scale(Params& step) {
  const bool uniform = step.raw("scale")->kind == Value::Kind::number;
  const dvec3 scale = uniform ? dvec3(step.number("scale")) : step.vec3("scale");
  for (int i = 0; i < 3; ++i) {
    if (scale[i] == 0.0) step.fail("scale", "\"scale\" must not be zero: it flattens the surface");
  }
  dmat4 matrix(1.0);
  for (int i = 0; i < 3; ++i) matrix[i][i] = scale[i];
  return matrix;
}

dmat4 read_step(Params step, const Value& value) {
  if (value.members.size() > 1) step.fail("a step takes one of \"translate\", \"rotate\" and \"scale\"");
  dmat4 matrix(1.0);
  const dvec3 translation = step.vec3("translate", dvec3(0.0));
  matrix[3] = dvec4(translation, 1.0);
  if (step.raw("rotate")) matrix = read_rotation(step.object("rotate"));
  if (step.raw("scale")) matrix = read_scale(step);
  step.finish();
  if (value.members.empty()) step.fail("a step takes one of \"translate\", \"rotate\" and \"scale\"");
  return matrix;
}

}  // namespace

bool is_affine(const dmat4& transform) {
  return transform[0][3] == 0.0 && transform[1][3] == 0.0 && transform[2][3] == 0.0 && transform[3][3] == 1.0;
}

dmat3 rotation(const dvec3& axis, double degrees) {
  // Extended precision, so that the entries are correctly rounded but for rare ties.
  const double turn = std::remainder(degrees, 360.0);  // exact
  long double c = std::cos(turn * (std::numbers::pi_v<long double> / 180.0L));
  long double s = std::sin(turn * (std::numbers::pi_v<long double> / 180.0L));
  if (std::remainder(turn, 90.0) == 0.0) {
    c = turn == 0.0 ? 1.0L : std::fabs(turn) == 180.0 ? -1.0L : 0.0L;
    s = std::fabs(turn) == 90.0 ? std::copysign(1.0L, static_cast<long double>(turn)) : 0.0L;
  }
  const double largest = std::fmax(std::fmax(std::fabs(axis.x), std::fabs(axis.y)), std::fabs(axis.z));
  long double a[3], length2 = 0.0L;
  for (int i = 0; i < 3; ++i) {
    a[i] = static_cast<long double>(axis[i]) / largest;
    length2 += a[i] * a[i];
  }
  for (long double& x : a) x /= std::sqrt(length2);
  dmat3 matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      long double entry = row == column ? c + a[row] * a[row] * (1.0L - c) : a[row] * a[column] * (1.0L - c);
      if (row != column) entry += ((column - row + 3) % 3 == 1 ? -s : s) * a[3 - row - column];
      matrix[column][row] = static_cast<double>(entry);
    }
  }
  return matrix;
}

dmat4 read_transform(Params& object) {
  const Value* value = object.raw("transform");
  if (!value) return dmat4(1.0);
  if (value->kind != Value::Kind::array) {
    object.fail(*value, "\"transform\" must be a 4x4 matrix (four rows of four numbers) or a list of steps");
  }
  if (!value->items.empty() && value->items[0].kind != Value::Kind::object)
    return read_matrix(object, *value);
  dmat4 matrix(1.0);
  for (std::size_t i = 0; i < value->items.size(); ++i) {
    const std::string what = fmt::format("{}.transform[{}]", object.what(), i);
    matrix = read_step(Params(value->items[i], object.source(), what), value->items[i]) * matrix;
  }
  return matrix;
}

}  // namespace rondure
