#include "renderer/shading/isolines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"

namespace rondure {
namespace {

// A segment of the parameter domain: from + s along, s in [0, 1].
struct Segment {
  dvec2 from, along;
};

struct LinePoint {
  dvec3 point, tangent;
};

LinePoint line_point(const Net& net, const Segment& segment, double s) {
  const dvec2 q = segment.from + s * segment.along;
  const FirstOrder<dvec4> f = net_first(net, q.x, q.y);
  const dvec3 point = dvec3(f.value) / f.value.w;
  const dvec4 slope = segment.along.x * f.du + segment.along.y * f.dv;
  return {point, (dvec3(slope) - slope.w * point) / f.value.w};
}

// Squared distance from `point` to the line's image, by Gauss-Newton from `s`. Four steps: each about squares
// the relative error, and the start is off by no more than a strip.
double squared_distance(const Net& net, const Segment& segment, const dvec3& point, double s) {
  double nearest = INFINITY;
  for (int step = 0; step < 5; ++step) {
    const LinePoint at = line_point(net, segment, s);
    const dvec3 way = point - at.point;
    nearest = std::fmin(nearest, glm::dot(way, way));
    const double speed2 = glm::dot(at.tangent, at.tangent);
    if (!(speed2 > 0.0)) break;
    s = std::clamp(s + glm::dot(way, at.tangent) / speed2, 0.0, 1.0);
  }
  return nearest;
}

// The line where a parameter is `value`: parameter 0 is u, 1 is v, 2 is 1 - u - v.
Segment tensor_line(int parameter, double value) {
  return parameter == 0 ? Segment{{value, 0.0}, {0.0, 1.0}} : Segment{{0.0, value}, {1.0, 0.0}};
}
Segment triangle_line(int parameter, double value) {
  const double rest = 1.0 - value;
  if (parameter == 0) return {{value, 0.0}, {0.0, rest}};
  if (parameter == 1) return {{0.0, value}, {rest, 0.0}};
  return {{rest, 0.0}, {-rest, rest}};
}

bool on_line(const Net& net, const dvec3& point, dvec2 q, const Segment& segment, double width) {
  const double length2 = glm::dot(segment.along, segment.along);
  const double s = length2 > 0.0 ? glm::dot(q - segment.from, segment.along) / length2 : 0.0;
  return squared_distance(net, segment, point, std::clamp(s, 0.0, 1.0)) <= 0.25 * width * width;
}

}  // namespace

bool on_isoline(const Isolines& lines, const Net& net, const dvec3& point, double u, double v) {
  const bool triangle = std::holds_alternative<TriangleNet>(net);
  const double values[3] = {u, v, 1.0 - u - v};
  for (int parameter = 0; parameter < (triangle ? 3 : 2); ++parameter) {
    const int below = std::clamp(static_cast<int>(values[parameter] * lines.count), 0, lines.count - 1);
    for (const int line : {below, below + 1}) {
      // A triangle's line at 1 is a corner, which two other boundaries share.
      if (triangle && line == lines.count) continue;
      const double value = static_cast<double>(line) / lines.count;
      const bool boundary = line == 0 || line == lines.count;
      const Segment segment = triangle ? triangle_line(parameter, value) : tensor_line(parameter, value);
      if (on_line(net, point, {u, v}, segment, boundary ? lines.boundary_width : lines.width)) return true;
    }
  }
  return false;
}

}  // namespace rondure
