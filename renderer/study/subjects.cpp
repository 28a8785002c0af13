#include "renderer/study/subjects.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "renderer/scene/scene_reader.h"
#include "renderer/scene/unknown_name.h"

namespace rondure {
namespace {

Subject tiling(const std::string& name, const std::string& more = "") {
  return {name, R"({ "type": "sphere_tiling", "topology": ")" + name + "\"" + more + " }", true};
}

// x^2 + y^2 = z^2 as a quadratic triangle with its tip at a corner: no limit there.
constexpr const char* cone_corner =
    R"({ "type": "bezier", "patches": [ { "kind": "triangle", "degree": 2, "net": {
  "200": [1, 0, -1, 1], "020": [-1, 0, -1, 1], "110": [0, 1, 0, 1],
  "101": [0, 0, 0, 1], "011": [0, 0, 0, 1], "002": [0, 0, 0, 1] } } ] })";

// A quarter of a cone of revolution, its tip a collapsed side: a limit at every parameter of it, each
// another.
constexpr const char* cone_side =
    R"({ "type": "bezier", "patches": [ { "kind": "tensor", "degree": [2, 1], "net": [
  [ [1, 0, 0, 1], [0, 0, 1, 1] ],
  [ [0.70710678118654752, 0.70710678118654752, 0, 0.70710678118654752], [0, 0, 0.70710678118654752, 0.70710678118654752] ],
  [ [0, 1, 0, 1], [0, 0, 1, 1] ] ] } ] })";

}  // namespace

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> all = {
      tiling("hemispheres"),
      tiling("octahedron_pairs"),
      {"octants", R"({ "type": "sphere_octant" })", true},
      tiling("cube"),
      tiling("cube_2_4"),
      tiling("icosahedron_pairs"),
      tiling("tetrahedron_quads"),
      tiling("octahedron_quads"),
      tiling("icosahedron_quads"),
      tiling("rhombicuboctahedron"),
      {"iss_triangles", R"({ "type": "iss" })", false},
      {"iss_degenerate", R"({ "type": "iss", "form": "degenerate" })", false},
      {"iss_quadrilaterals", R"({ "type": "iss", "form": "quadrilaterals" })", false},
      {"sphere_cap", R"({ "type": "sphere_cap", "z_max": 0.5 })", false},
      {"stereographic_patch", R"({ "type": "stereographic_patch" })", false},
      {"gc1_sphere", R"({ "type": "gc_octahedron", "basis": "sphere" })", true},
      {"gc1_cubic", R"({ "type": "gc_octahedron" })", false},
      {"gc1_rational", R"({ "type": "gc_octahedron", "basis": "rational" })", false},
      {"cross_caps",
       R"({ "type": "gc_octahedron", "control_points": { "h6": [-2, 1, 0], "h5": [0, 0, 0], "h7": [1, -2, -1] } })",
       false},
      {"cone_corner", cone_corner, false},
      {"cone_side", cone_side, false},
  };
  return all;
}

std::vector<Subject> subjects_named(const std::vector<std::string>& names) {
  if (names.empty()) return subjects();
  std::vector<std::string> known;
  for (const Subject& subject : subjects()) known.push_back(subject.name);
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw std::runtime_error(unknown_name("family", name, known));
  }
  std::vector<Subject> chosen;
  for (const Subject& subject : subjects())
    if (std::find(names.begin(), names.end(), subject.name) != names.end()) chosen.push_back(subject);
  return chosen;
}

Subject turned(Subject subject) {
  subject.object.replace(subject.object.find('{'), 1,
                         R"({ "transform": [ { "rotate": { "axis": [1, 2, 3], "angle": 40 } } ],)");
  return subject;
}

Surface surface_of(const Subject& subject, const Registry& registry) {
  const std::string text = fmt::format("{{ \"objects\": [ {} ] }}", subject.object);
  Scene scene = read_scene_text(subject.name, text, registry);
  return std::move(scene.objects.at(0).traced.surface);
}

}  // namespace rondure
