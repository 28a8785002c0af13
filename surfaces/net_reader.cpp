#include "surfaces/net_reader.h"

#include <fmt/format.h>

#include <cmath>

#include "renderer/bezier/triangle_keys.h"

namespace rondure {
namespace {

using Kind = Value::Kind;

dvec4 read_point(const Params& patch, const Value& value, const NetForm& form) {
  const std::size_t count = value.items.size();
  const bool fits = form.planar ? count == 2 || count == 3 : count == 4;
  if (value.kind != Kind::array || !fits) {
    patch.fail(value, fmt::format("a control point is an array of {} numbers, {}",
                                  form.planar ? "two or three" : "four", form.point));
  }
  dvec4 point(0.0, 0.0, 0.0, 1.0);
  for (int c = 0; const Value& item : value.items) {
    if (item.kind != Kind::number || !std::isfinite(item.number)) {
      patch.fail(item, "a coordinate of a control point must be a finite number");
    }
    point[form.planar && c == 2 ? 3 : c] = item.number;
    ++c;
  }
  return point;
}

int read_degree(const Params& patch, const Value& value, const NetForm& form) {
  if (value.kind != Kind::number || !value.integral || value.number < 1.0 ||
      value.number > form.highest_degree) {
    patch.fail(value, fmt::format("a degree must be an integer from 1 to {}", form.highest_degree));
  }
  return static_cast<int>(value.number);
}

const Value& required(Params& patch, const char* key) {
  const Value* value = patch.raw(key);
  if (value == nullptr) patch.fail(fmt::format("\"{}\" is missing", key));
  return *value;
}

// A net that is zero throughout, or its weights are, has no point.
void refuse_zeros(const Params& patch, const Value& at, const std::vector<dvec4>& points,
                  const NetForm& form) {
  for (const dvec4& p : points) {
    if (form.weights ? p.w != 0.0 : p != dvec4(0.0)) return;
  }
  patch.fail(at, form.weights ? "every weight is zero: the patch has no point in space (w comes last)"
                              : "every control point is zero: the patch has no point");
}

TensorNet read_tensor(Params& patch, const NetForm& form) {
  const Value& degree = required(patch, "degree");
  if (degree.kind != Kind::array || degree.items.size() != 2) {
    patch.fail(degree, "the degree of a tensor patch is an array of two integers, [along u, along v]");
  }
  TensorNet net(read_degree(patch, degree.items[0], form), read_degree(patch, degree.items[1], form));
  const Value& rows = required(patch, "net");
  const auto row_count = static_cast<std::size_t>(net.m) + 1,
             column_count = static_cast<std::size_t>(net.n) + 1;
  if (rows.kind != Kind::array || rows.items.size() != row_count) {
    patch.fail(rows, fmt::format("the net of a tensor patch of degree [{}, {}] is an array of {} rows{}",
                                 net.m, net.n, row_count,
                                 rows.kind == Kind::array ? fmt::format(", not {}", rows.items.size()) : ""));
  }
  for (std::size_t i = 0; i < row_count; ++i) {
    const Value& row = rows.items[i];
    if (row.kind != Kind::array || row.items.size() != column_count) {
      patch.fail(row, fmt::format("a row of this net is an array of {} control points{}", column_count,
                                  row.kind == Kind::array ? fmt::format(", not {}", row.items.size()) : ""));
    }
    for (std::size_t j = 0; j < column_count; ++j) {
      net.points[i * column_count + j] = read_point(patch, row.items[j], form);
    }
  }
  refuse_zeros(patch, rows, net.points, form);
  return net;
}

TriangleNet read_triangle(Params& patch, const NetForm& form) {
  const Value& degree = required(patch, "degree");
  TriangleNet net(read_degree(patch, degree, form));
  const Value& points = required(patch, "net");
  if (points.kind != Kind::object) {
    patch.fail(points, "the net of a triangle is an object with keys \"ijk\" for u^i v^j w^k, or \"i,j,k\"");
  }
  std::vector<bool> given(net.points.size(), false);
  for (const Value::Member& member : points.members) {
    Value key;
    key.where = member.where;
    const std::optional<std::size_t> place = triangle_key(net.n, member.key);
    if (!place) {
      patch.fail(key, fmt::format("\"{}\" is no index of this net: \"ijk\" or \"i,j,k\" with i + j + k = {}",
                                  member.key, net.n));
    }
    const std::size_t at = *place;
    if (given[at]) patch.fail(key, fmt::format("control point \"{}\" is given twice", member.key));
    given[at] = true;
    net.points[at] = read_point(patch, member.value, form);
  }
  for (int i = net.n; i >= 0; --i) {
    for (int j = net.n - i; j >= 0; --j) {
      if (given[static_cast<std::size_t>(triangle_index(net.n, i, j))]) continue;
      patch.fail(points, fmt::format("control point \"{}\" is missing", triangle_key_name(net.n, i, j)));
    }
  }
  refuse_zeros(patch, points, net.points, form);
  return net;
}

}  // namespace

Net read_net(Params& patch, const NetForm& form) {
  Net net;
  if (patch.choice("kind", {"tensor", "triangle"}, "tensor") == "tensor") {
    net = read_tensor(patch, form);
  } else {
    net = read_triangle(patch, form);
  }
  patch.finish();
  return net;
}

}  // namespace rondure
