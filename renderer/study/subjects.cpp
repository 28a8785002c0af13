#include "renderer/study/subjects.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "renderer/bezier/net_text.h"
#include "renderer/bezier/rational.h"
#include "renderer/scene/scene_reader.h"
#include "renderer/scene/unknown_name.h"

namespace rondure {
namespace {

Subject tiling(const std::string& name, const std::string& more = "") {
  return {name, R"({ "type": "sphere_tiling", "topology": ")" + name + "\"" + more + " }", true};
}

// A patch of another quadric, of semi-axes 1, 0.8 and 0.6.
Subject quadric(const std::string& name, const std::string& kind, const std::string& patches) {
  return {name,
          R"({ "type": "quadric_patch", "quadric": ")" + kind + R"(", "semi_axes": [1, 0.8, 0.6], )" +
              patches + " }",
          false};
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

// The quadratic preimage of a patch of a hyperboloid of one sheet, two of its points one: a collapsed side.
constexpr const char* collapsed_preimage = R"("preimage": [ { "degree": [1, 1], "net": [
  [ [1, 0, 0.75, 0.625], [1, 0, 0.75, 0.625] ],
  [ [0.75, 0.75, 1, -0.125], [0.75, 0.75, -0.125, 1] ] ] } ])";

// A corner of 180 degrees whose sides are others than u and v.
constexpr const char* hemisphere_part =
    R"({ "type": "composed_patch", "of": { "type": "sphere_tiling", "topology": "hemispheres" },
  "domain": { "kind": "triangle", "degree": 1, "net": { "100": [0, 0], "010": [0.75, 0.125], "001": [0.25, 0.625] } } })";

constexpr const char* small_circles =
    R"({ "type": "spherical_quad", "corners": [[-1, -2, -1], [1, -2, -1], [1, -2, 1], [-1, -2, 1]],
  "arcs": [null, { "through": [2, -2, 0] }, null, { "through": [-2, -2, 0] }] })";

constexpr const char* quadratic_triangle =
    R"({ "type": "circular_triangle", "construction": "quadratic",
  "corners": [[0.8, 0, -0.6], [-0.66666666666666663, -0.66666666666666663, -0.33333333333333331],
              [-0.66666666666666663, 0.66666666666666663, -0.33333333333333331]],
  "arcs": [{ "plane": [2, -4, 1, 1] }, { "plane": [1, 0, -0.5, -0.5] }, { "plane": [2, 4, 1, 1] }] })";

constexpr const char* bspline = R"({ "type": "spherical_bspline", "degree": [2, 1],
  "knots": [[0, 0, 0, 1, 2, 2, 2], [0, 0, 0.5, 1, 1]], "net": [
    [[2, -1.5, -0.75, 0.125], [2, -1.5, 0, 0], [2, -1.5, 0.75, -0.125]],
    [[2, -0.5, -0.75, 0], [2, -0.5, 0, 0], [2, -0.5, 0.75, 0]],
    [[2, 0.5, -0.75, -0.125], [2, 0.5, 0, 0], [2, 0.5, 0.75, 0.125]],
    [[2, 1.5, -0.75, -0.375], [2, 1.5, 0, 0], [2, 1.5, 0.75, 0.375]]] })";

constexpr const char* gc_triangles = R"({ "type": "gc_complex", "degree": 4,
  "complex": { "polygons": [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]] },
  "vertices": [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]] })";

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
      {"rhombicuboctahedron_42",
       R"({ "type": "sphere_tiling", "topology": "rhombicuboctahedron", "reading": 42 })", true},
      {"iss_triangles", R"({ "type": "iss" })", false},
      {"iss_degenerate", R"({ "type": "iss", "form": "degenerate" })", false},
      {"iss_quadrilaterals", R"({ "type": "iss", "form": "quadrilaterals" })", false},
      {"iss_closed", R"({ "type": "iss", "octants": { "degree": 3, "interior": 1 }, "form": "degenerate" })",
       false},
      {"sphere_cap", R"({ "type": "sphere_cap", "z_max": 0.5 })", false},
      {"stereographic_patch", R"({ "type": "stereographic_patch" })", false},
      {"hemisphere_part", hemisphere_part, false},
      {"spherical_quad", small_circles, false},
      {"circular_quad",
       R"({ "type": "circular_quad", "corners": [[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]] })", false},
      {"circular_triangle",
       R"({ "type": "circular_triangle", "corners": [[1, 0, 0], [0, 1, 0], [0, 0, 1]] })", false},
      {"quadratic_triangle", quadratic_triangle, false},
      {"projected_net",
       R"({ "type": "projected_net", "patches": [ { "degree": [1, 1],
         "net": [[[1, 0, 0, 0], [1, 0, 1, 0]], [[1, 1, 0, 0], [1, 1, 1, 0]]] } ] })",
       false},
      {"spherical_bspline", bspline, false},
      quadric("ellipsoid_hemispheres", "ellipsoid",
              R"("surface": { "type": "sphere_tiling", "topology": "hemispheres" })"),
      quadric("ellipsoid_octants", "ellipsoid", R"("surface": { "type": "sphere_octant" })"),
      quadric("two_sheets", "two_sheets", R"("surface": { "type": "sphere_cap", "z_max": -0.35 })"),
      quadric("one_sheet", "one_sheet", collapsed_preimage),
      quadric("elliptic_paraboloid", "elliptic_paraboloid",
              R"("surface": { "type": "sphere_octant", "octants": [4, 5, 6, 7] })"),
      quadric("hyperbolic_paraboloid", "hyperbolic_paraboloid", R"("rulings": [[-1, 1], [-1, 1]])"),
      {"gc1_sphere", R"({ "type": "gc_octahedron", "basis": "sphere" })", true},
      {"gc1_cubic", R"({ "type": "gc_octahedron" })", false},
      {"gc1_rational", R"({ "type": "gc_octahedron", "basis": "rational" })", false},
      {"gc_cube", R"({ "type": "gc_complex" })", false},
      {"gc_torus", R"({ "type": "gc_complex", "complex": { "torus": [3, 2] } })", false},
      {"gc_triangles", gc_triangles, false},
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

std::vector<Subject> spheres_named(const std::vector<std::string>& names) {
  std::vector<Subject> chosen = subjects_named(names);
  std::erase_if(chosen, [&](const Subject& subject) {
    if (!subject.sphere && !names.empty()) {
      std::string known;
      for (const Subject& other : subjects())
        if (other.sphere) known += (known.empty() ? "\"" : ", \"") + other.name + "\"";
      throw std::runtime_error(fmt::format(
          "family \"{}\" is not the whole unit sphere, which this study compares with; these are: {}",
          subject.name, known));
    }
    return !subject.sphere;
  });
  return chosen;
}

std::vector<Subject> subjects_of_scene(const std::string& path, const Registry& registry) {
  const Scene scene = read_scene(path, registry);
  std::vector<Subject> chosen;
  for (std::size_t k = 0; k < scene.objects.size(); ++k) {
    const SceneObject& object = scene.objects[k];
    const Surface& surface = object.traced.surface;
    if (surface.patches.empty()) continue;
    Subject subject;
    subject.name = fmt::format("{}_{}", k, object.type);
    subject.object = fmt::format(R"({{ "type": "bezier", "closed": {}, "patches": [)", surface.closed);
    const dvec3 middle = net_point(surface.patches.front(), 0.25, 0.25);
    subject.size = 0.0;
    for (const Net& net : surface.patches) {
      subject.object += (&net == &surface.patches.front() ? "\n  " : ",\n  ") + net_text(net);
      for (const dvec2& at : {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1), dvec2(0.3, 0.3)})
        subject.size = std::max(subject.size, 0.5 * glm::distance(net_point(net, at.x, at.y), middle));
    }
    subject.object += " ] }";
    chosen.push_back(std::move(subject));
  }
  if (chosen.empty()) throw std::runtime_error(fmt::format("{}: no object has patches to study", path));
  return chosen;
}

Subject turned(Subject subject) {
  subject.object.replace(subject.object.find('{'), 1,
                         R"({ "transform": [ { "rotate": { "axis": [1, 2, 3], "angle": 40 } } ],)");
  return subject;
}

TracedSurface traced_subject(const Subject& subject, const Registry& registry) {
  const std::string text = fmt::format("{{ \"objects\": [ {} ] }}", subject.object);
  Scene scene = read_scene_text(subject.name, text, registry);
  return std::move(scene.objects.at(0).traced);
}

Surface surface_of(const Subject& subject, const Registry& registry) {
  return traced_subject(subject, registry).surface;
}

}  // namespace rondure
