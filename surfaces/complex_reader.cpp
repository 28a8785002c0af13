#include "surfaces/complex_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "renderer/bezier/index.h"
#include "renderer/complex/regular_joins.h"
#include "renderer/complex/shipped.h"
#include "renderer/complex/validate.h"
#include "surfaces/edge_data_reader.h"

namespace rondure {
namespace {

using Kind = Value::Kind;

constexpr double two_pi = 6.28318530717958647693;

// Flat targets between these corners, moved by a map of space.
template <class Map>
std::function<CoefficientTargets(int)> shaped(const SurfaceComplex& complex,
                                              const std::vector<std::vector<dvec3>>& corners, Map map) {
  return [complex, corners, map](int n) {
    CoefficientTargets targets = flat_targets(complex, n, corners);
    for (auto& polygon : targets) {
      for (dvec3& p : polygon) p = map(p);
    }
    return targets;
  };
}

dvec3 on_sphere(const dvec3& p) { return glm::normalize(p); }

ComplexChoice octahedron_choice() {
  ComplexChoice out{octahedron_complex(), {}, 0, {}};
  std::vector<std::vector<dvec3>> corners;
  for (int k = 0; k < 8; ++k) {
    const double x = (k & 4) != 0 ? -1 : 1, y = (k & 2) != 0 ? -1 : 1, z = (k & 1) != 0 ? -1 : 1;
    corners.push_back({dvec3(x, 0, 0), dvec3(0, y, 0), dvec3(0, 0, z)});
  }
  out.shape = shaped(out.complex, corners, on_sphere);
  return out;
}

ComplexChoice cube() {
  ComplexChoice out{cube_complex(), {}, 0, {}};
  std::vector<std::vector<dvec3>> corners;
  for (const auto& face : cube_corners()) {
    std::vector<dvec3> points;
    for (const auto& p : face) points.emplace_back(p[0], p[1], p[2]);
    corners.push_back(points);
  }
  out.shape = shaped(out.complex, corners, on_sphere);
  return out;
}

// A torus of revolution with radii 1 and 1/2: k cells go round it, l round its tube.
ComplexChoice torus(int k, int l) {
  ComplexChoice out{torus_complex(k, l), {}, 0, {}};
  std::vector<std::vector<dvec3>> corners;
  for (const auto& rhombus : torus_corners(k, l)) {
    std::vector<dvec3> points;
    for (const auto& p : rhombus) points.emplace_back(p[0] / k, p[1] / l, 0);
    corners.push_back(points);
  }
  out.shape = shaped(out.complex, corners, [](const dvec3& p) {
    const double a = two_pi * p.x, b = two_pi * p.y;
    const double r = 1.0 + 0.5 * std::cos(b);
    return dvec3(r * std::cos(a), r * std::sin(a), 0.5 * std::sin(b));
  });
  return out;
}

// Polygons as lists of vertex numbers: two that share two neighbouring vertices are glued along that edge.
ComplexChoice from_polygons(Params& object) {
  ComplexChoice out;
  const Value& list = *object.raw("polygons");
  if (list.kind != Kind::array || list.items.empty() || list.items.size() > 1000)
    object.fail(list, "\"polygons\" is an array of 1 to 1000 triangles and quadrilaterals");
  std::vector<int> sides;
  for (const Value& item : list.items) {
    bool good = item.kind == Kind::array && (item.items.size() == 3 || item.items.size() == 4);
    std::vector<int> polygon;
    for (std::size_t k = 0; good && k < item.items.size(); ++k) {
      const Value& v = item.items[k];
      good = v.kind == Kind::number && v.integral && v.number >= 0 && v.number <= 4000;
      if (good) polygon.push_back(static_cast<int>(v.number));
      good = good && std::count(polygon.begin(), polygon.end(), polygon.back()) == 1;
    }
    if (!good) object.fail(item, "a polygon is an array of 3 or 4 different numbers of vertices, from 0 on");
    for (const int v : polygon) out.vertex_count = std::max(out.vertex_count, v + 1);
    sides.push_back(static_cast<int>(polygon.size()));
    out.vertices.push_back(std::move(polygon));
  }
  std::vector<Gluing> gluings;
  std::map<std::pair<int, int>, std::vector<EdgeRef>> by_ends;
  for (std::size_t p = 0; p < sides.size(); ++p) {
    for (int e = 0; e < sides[p]; ++e) {
      const auto start = [&](const EdgeRef& r) { return out.vertices[index(r.polygon)][index(r.edge)]; };
      const EdgeRef here{static_cast<int>(p), e};
      const int from = start(here), to = out.vertices[p][index((e + 1) % sides[p])];
      std::vector<EdgeRef>& met = by_ends[std::minmax(from, to)];
      if (met.size() == 2)
        object.fail(list.items[p], fmt::format("the edge between vertices {} and {} belongs to more than two "
                                               "polygons",
                                               from, to));
      if (met.size() == 1) gluings.push_back({met[0], here, start(met[0]) != from});
      met.push_back(here);
    }
  }
  out.complex = regular_complex(sides, gluings);
  // A number that stands for two vertices would tear the surface there.
  std::vector<int> fan_of_vertex(index(out.vertex_count), -1);
  const auto fans = fan_of_corner(out.complex, vertex_fans(out.complex));
  for (std::size_t p = 0; p < sides.size(); ++p) {
    for (std::size_t c = 0; c < out.vertices[p].size(); ++c) {
      int& fan = fan_of_vertex[index(out.vertices[p][c])];
      if (fan >= 0 && fan != fans[p][c])
        object.fail(list.items[p], fmt::format("the polygons at vertex {} do not form one fan around it",
                                               out.vertices[p][c]));
      fan = fans[p][c];
    }
  }
  return out;
}

void check(Params& params, const Value& value, const SurfaceComplex& complex) {
  const std::vector<Violation> found = violations(complex);
  if (found.empty()) return;
  params.fail(value, fmt::format("this is no geometrically continuous complex: {}{}", text_of(found[0]),
                                 found.size() > 1 ? fmt::format(" (and {} more)", found.size() - 1) : ""));
}

ComplexChoice from_object(Params& params) {
  Params object = params.object("complex");
  const char* found = nullptr;
  for (const char* form : {"torus", "polygons", "sides"}) {
    if (!object.has(form)) continue;
    if (found) object.fail(form, fmt::format("give either \"{}\" or \"{}\", not both", found, form));
    found = form;
  }
  if (!found) object.fail("a complex is given by \"torus\", \"polygons\", or \"sides\" and \"joins\"");
  ComplexChoice out;
  if (found == std::string("torus")) {
    const std::vector<std::int64_t> cells = object.integers("torus", 1, 41);
    // 3 k l rhombi of 16 coefficients in degree 3, the least that has surfaces.
    if (cells.size() != 2 || cells[0] * cells[1] > 41)
      object.fail(
          "torus",
          "\"torus\" is [k, l], numbers of cells with a product of 41 at most: 3 k l squares have 2000 "
          "coefficients at most");
    out = torus(static_cast<int>(cells[0]), static_cast<int>(cells[1]));
  } else if (found == std::string("polygons")) {
    out = from_polygons(object);
  } else {
    out.complex = read_joined_polygons(object);
  }
  object.finish();
  check(params, *params.raw("complex"), out.complex);
  return out;
}

}  // namespace

ComplexChoice read_complex(Params& params) {
  const Value* value = params.raw("complex");
  ComplexChoice out;
  if (value && value->kind == Kind::object) {
    out = from_object(params);
  } else {
    const std::string name = params.choice("complex", {"octahedron", "cube", "torus"}, "cube");
    out = name == "octahedron" ? octahedron_choice() : name == "cube" ? cube() : torus(4, 3);
  }
  if (out.vertices.empty()) {
    const std::vector<VertexFan> fans = vertex_fans(out.complex);
    out.vertices = fan_of_corner(out.complex, fans);
    out.vertex_count = static_cast<int>(fans.size());
  }
  return out;
}

ParameterDoc complex_doc() {
  return {"complex",
          "\"octahedron\", \"cube\", \"torus\", {\"torus\": [k, l]}, {\"polygons\": [[0, 1, 2], ...]} or "
          "{\"sides\": [3, 4, ...], \"joins\": [...]}",
          "\"cube\"",
          "what is glued to what: six squares; 3 k l rhombi, k l at most 41 (k = 4, l = 3); triangles and "
          "quadrilaterals as "
          "lists of vertices; or by edges, each join {\"edges\": [[polygon, edge], [polygon, edge]], "
          "\"reversed\", \"parameter\", and \"fields\" or \"theta\"} with functions of the edge's parameter: "
          "a number, \"p/q\", Bernstein coefficients, or {\"numerator\", \"denominator\"}"};
}

}  // namespace rondure
