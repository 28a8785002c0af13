// The lines by which surfaces are inspected: isophotes, reflection lines and highlight lines, from the normal
// that shades the hit, whatever its patch.
//
// All light is far away. Isophotes (Poeschl 1984): the angle of normal and light direction is a multiple of
// 180 / count degrees. Reflection lines (Klass 1980): the reflected view ray meets one of `count` straight
// lines of light, parallel to an axis and spread evenly around it. Highlight lines (Beier and Chen 1994): so
// does the normal itself.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "renderer/layers/layers.h"
#include "renderer/sampling/warps.h"

namespace rondure {
namespace {

using std::numbers::pi;

struct Lines {
  int count;
  double thickness;  // of a line, in units of the distance between lines
  dvec3 direction;   // unit

  // `place` counts lines.
  void draw(double place, double* values) const {
    values[0] = place;
    values[1] = std::abs(place - std::round(place)) <= 0.5 * thickness ? 1.0 : 0.0;
  }
};

Lines read_lines(Params& params, int count) {
  Lines lines;
  lines.count = static_cast<int>(params.integer("count", count, 1, 10000));
  lines.thickness = params.number("thickness", 0.3, {0.0, 1.0, true, true});
  const dvec3 direction = params.vec3("direction", dvec3(0.0, 0.0, 1.0));
  if (!(glm::length(direction) > 0.0)) params.fail("direction", "\"direction\" must not be zero");
  lines.direction = glm::normalize(direction);
  return lines;
}

// Which of the lines around the axis a direction looks at; 0 along the axis itself, where all lines meet.
double around_axis(const Lines& lines, const dvec3& direction) {
  const dvec3 local = frame_about(lines.direction).to_local(direction);
  if (local.x == 0.0 && local.y == 0.0) return 0.0;
  return (std::atan2(local.y, local.x) / (2.0 * pi) + 0.5) * lines.count;
}

// A layer that asks for the normal; nothing is drawn where there is none.
template <class Place>
LayerFunction lines_layer(const Lines& lines, Place place) {
  return [lines, place](const World& world, const Ray& ray, const Hit& hit, double* values) {
    if (!hit) return;
    const dvec3 normal = world.shading_normal(hit);
    if (normal != dvec3(0.0)) lines.draw(place(lines, glm::normalize(ray.direction), normal), values);
  };
}

LayerFunction isophotes(Params& params) {
  return lines_layer(read_lines(params, 16), [](const Lines& lines, const dvec3&, const dvec3& n) {
    const double angle =
        std::atan2(glm::length(glm::cross(n, lines.direction)), glm::dot(n, lines.direction));
    return angle / pi * lines.count;
  });
}

LayerFunction reflection_lines(Params& params) {
  return lines_layer(read_lines(params, 24), [](const Lines& lines, const dvec3& ray, const dvec3& n) {
    return around_axis(lines, ray - 2.0 * glm::dot(ray, n) * n);
  });
}

LayerFunction highlight_lines(Params& params) {
  return lines_layer(read_lines(params, 24),
                     [](const Lines& lines, const dvec3&, const dvec3& n) { return around_axis(lines, n); });
}

std::vector<ParameterDoc> docs(const char* count, const char* lines, const char* direction) {
  return {
      {"count", "integer in [1, 10000]", count, lines},
      {"thickness", "number in (0, 1)", "0.3", "of a line, in units of the distance from one to the next"},
      {"direction", "vector", "[0, 0, 1]", direction}};
}

}  // namespace

void register_line_layers(Registry& registry) {
  registry.add(
      LayerFactory{"isophotes",
                   "Lines of equal angle between the normal and a light direction: the angle, counting "
                   "lines, and 1 on a line.",
                   "Isophotes",
                   {"place", "line"},
                   docs("16", "lines from 0 to 180 degrees", "to the light"),
                   isophotes});
  registry.add(
      LayerFactory{"reflection_lines",
                   "Reflections of straight lines of light, far away and parallel to an axis: the place "
                   "around it, counting lines, and 1 on a line.",
                   "ReflectionLines",
                   {"place", "line"},
                   docs("24", "lines around the axis", "the axis"),
                   reflection_lines});
  registry.add(
      LayerFactory{"highlight_lines",
                   "Where normals meet straight lines of light, far away and parallel to an axis (Beier and "
                   "Chen 1994): the place around it, counting lines, and 1 on a line.",
                   "HighlightLines",
                   {"place", "line"},
                   docs("24", "lines around the axis", "the axis"),
                   highlight_lines});
}

}  // namespace rondure
