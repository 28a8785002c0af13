// The lines by which surfaces are inspected: isophotes, reflection lines and highlight lines, from the normal
// that shades the hit, whatever its patch.
//
// Isophotes (Poeschl 1984): the angle of normal and light direction is a multiple of 180 / count degrees.
// Reflection lines (Klass 1980): the reflected view ray meets one of `count` parallel straight lines of
// light. Highlight lines (Beier and Chen 1994): so does the normal's own line, to either side. The lines of
// light are far away and spread evenly around an axis, or they lie in a plane, from one to the next by the
// same step.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "renderer/bezier/angle.h"
#include "renderer/layers/layers.h"
#include "renderer/normals/direction.h"
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
  const auto direction = direction_of(params.vec3("direction", dvec3(0.0, 0.0, 1.0)));
  if (!direction) params.fail("direction", "\"direction\" must not be zero");
  lines.direction = *direction;
  return lines;
}

// Which of the lines around the axis a direction looks at; 0 along the axis itself, where all lines meet.
double around_axis(const Lines& lines, const dvec3& direction) {
  const dvec3 local = frame_about(lines.direction).to_local(direction);
  if (local.x == 0.0 && local.y == 0.0) return 0.0;
  return (std::atan2(local.y, local.x) / (2.0 * pi) + 0.5) * lines.count;
}

// Lines of light in a plane: `first` + k `step` + t direction, k from 0 to count - 1.
struct Lights {
  dvec3 first, step;
};

std::optional<Lights> read_lights(Params& params, const Lines& lines) {
  if (!params.raw("position")) {
    if (params.raw("step"))
      params.fail("step", "\"step\" leads from one line of light to the next: it needs their \"position\"");
    return {};
  }
  const dvec3 middle = params.vec3("position", dvec3(0.0));
  if (!params.raw("step"))
    params.fail("position", "lines of light in a plane need the \"step\" from one to the next");
  const dvec3 step = params.vec3("step", dvec3(0.0));
  if (!(glm::length(glm::cross(lines.direction, step)) > 1e-9 * glm::length(step)))
    params.fail("step", "\"step\" must not be zero, nor along the lines");
  return Lights{middle - 0.5 * (lines.count - 1) * step, step};
}

// Where the line from a point in a direction (backward too, unless it is a ray) comes closest to the lines of
// light: it meets line k where ((point - first) - k step) . (lines' direction x direction) = 0. Nothing is
// drawn beyond the first and the last, nor where it is parallel to their plane.
void draw_lights(const Lines& lines, const Lights& lights, const dvec3& point, const dvec3& direction,
                 bool ray, double* values) {
  const dvec3 across = glm::cross(lines.direction, direction), away = point - lights.first;
  const double share = glm::dot(lights.step, across);
  const dvec3 normal = glm::cross(lines.direction, lights.step);
  if (share == 0.0 || (ray && !(glm::dot(away, normal) * glm::dot(direction, normal) < 0.0))) return;
  const double place = glm::dot(away, across) / share;
  const double end = 0.5 * lines.thickness;
  if (place >= -end && place <= lines.count - 1 + end) lines.draw(place, values);
}

// A layer that asks for the normal; nothing is drawn where there is none.
template <class Draw>
LayerFunction lines_layer(const Lines& lines, Draw draw) {
  return [lines, draw](const World& world, const Ray& ray, const Hit& hit, double* values) {
    if (!hit) return;
    const dvec3 normal = world.shading_normal(hit);
    if (normal != dvec3(0.0)) draw(lines, hit, glm::normalize(ray.direction), normal, values);
  };
}

LayerFunction isophotes(Params& params) {
  return lines_layer(read_lines(params, 16),
                     [](const Lines& lines, const Hit&, const dvec3&, const dvec3& n, double* values) {
                       const double angle = angle_between(n, lines.direction);
                       lines.draw(angle / pi * lines.count, values);
                     });
}

// Of what looks at the light from a hit: the reflected ray, or the normal's line.
template <class Looking>
LayerFunction light_lines(Params& params, bool ray, Looking looking) {
  const Lines read = read_lines(params, 24);
  const std::optional<Lights> lights = read_lights(params, read);
  return lines_layer(
      read, [=](const Lines& lines, const Hit& hit, const dvec3& view, const dvec3& n, double* values) {
        const dvec3 direction = looking(view, n);
        if (lights)
          draw_lights(lines, *lights, hit.point, direction, ray, values);
        else
          lines.draw(around_axis(lines, direction), values);
      });
}

LayerFunction reflection_lines(Params& params) {
  return light_lines(params, true,
                     [](const dvec3& view, const dvec3& n) { return view - 2.0 * glm::dot(view, n) * n; });
}

LayerFunction highlight_lines(Params& params) {
  return light_lines(params, false, [](const dvec3&, const dvec3& n) { return n; });
}

std::vector<ParameterDoc> docs(const char* count, const char* lines, const char* direction) {
  return {
      {"count", "integer in [1, 10000]", count, lines},
      {"thickness", "number in (0, 1)", "0.3", "of a line, in units of the distance from one to the next"},
      {"direction", "vector", "[0, 0, 1]", direction}};
}

std::vector<ParameterDoc> line_light_docs() {
  std::vector<ParameterDoc> all = docs("24", "lines of light", "along which they run");
  all.push_back({"position", "point", "far away", "the middle of the lines, which then lie in a plane"});
  all.push_back({"step", "vector", "around the direction", "from one line to the next, of those in a plane"});
  return all;
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
  registry.add(LayerFactory{
      "reflection_lines",
      "Reflections of straight lines of light, parallel, far away and spread around their direction, or "
      "in a plane: the place, counting lines, and 1 on a line.",
      "ReflectionLines",
      {"place", "line"},
      line_light_docs(),
      reflection_lines});
  registry.add(
      LayerFactory{"highlight_lines",
                   "Where the lines of normals meet straight lines of light (Beier and Chen 1994), as in "
                   "reflection_lines: the place, counting lines, and 1 on a line.",
                   "HighlightLines",
                   {"place", "line"},
                   line_light_docs(),
                   highlight_lines});
}

}  // namespace rondure
