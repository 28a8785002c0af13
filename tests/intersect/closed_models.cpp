#include "tests/intersect/closed_models.h"

#include <fmt/core.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/local_ray.h"
#include "renderer/intersect/root.h"
#include "tests/intersect/placed.h"
#include "tests/intersect/random_direction.h"
#include "tests/oracle/oracle.h"
#include "tests/paths.h"
#include "tests/render/staged_scene.h"
#include "tests/surfaces/build_family.h"

namespace rondure {
namespace {

constexpr int grid = 16;
constexpr std::size_t pool = 8;  // points inside

// Parameters of the grid's points.
std::vector<dvec2> grid_of(const Net& net) {
  const bool triangle = std::holds_alternative<TriangleNet>(net);
  std::vector<dvec2> out;
  for (int i = 0; i <= grid; ++i)
    for (int j = 0; j <= (triangle ? grid - i : grid); ++j)
      out.emplace_back(double(i) / grid, double(j) / grid);
  return out;
}

// Of a sphere about the frame's zero that contains the control points where weights are positive.
double radius_of(const Surface& surface) {
  double radius = 0.0;
  for (const Net& net : surface.patches)
    for (const dvec2 p : grid_of(net)) radius = std::max(radius, glm::length(net_point(net, p.x, p.y)));
  return 1.05 * radius;
}

bool has_singular_corner(const Surface& surface) {
  for (const Net& net : surface.patches)
    for (const dvec2 p : {dvec2(0.0), dvec2(1.0, 0.0), dvec2(0.0, 1.0), dvec2(1.0)}) {
      if (std::holds_alternative<TriangleNet>(net) && p == dvec2(1.0)) continue;
      const SurfaceJet jet = surface_jet(net, p.x, p.y);
      if (glm::length(glm::cross(jet.du, jet.dv)) <= 1e-9 * glm::length(jet.du) * glm::length(jet.dv))
        return true;
    }
  return false;
}

// Candidates in the ball about the frame's zero; an odd number of certified crossings ahead says inside.
std::vector<dvec3> points_inside(const Surface& surface, double radius) {
  std::vector<dvec3> out;
  std::mt19937_64 random(41);
  for (int tries = 0; tries < 400 && out.size() < pool; ++tries) {
    const dvec3 way = random_direction(random), direction = random_direction(random);
    const double part = std::uniform_real_distribution<double>(0.0, 1.0)(random);
    const Ray ray{surface.origin + 0.9 * radius * std::cbrt(part) * way, direction};
    bool sure = true;
    int ahead = 0;
    for (const oracle::Crossing& c : oracle::crossings(oracle::meet(surface, ray), 0x1p-40 * radius)) {
      sure = sure && c.certified && c.multiplicity == 1 && std::fabs(c.t) > 1e-3 * radius;
      ahead += c.t > 0.0;
    }
    if (sure && ahead % 2 == 1) out.push_back(ray.origin);
  }
  return out;
}

ClosedModel model_of(const std::string& name, Surface surface, bool sphere) {
  ClosedModel out;
  out.name = name;
  out.radius = sphere ? 1.0 : radius_of(surface);
  out.sphere = sphere;
  out.singular = has_singular_corner(surface);
  out.band = tangency_band(surface, out.radius) / out.radius;
  out.inside = points_inside(surface, out.radius);
  out.surface = std::move(surface);
  return out;
}

std::vector<ClosedModel> build() {
  std::vector<ClosedModel> out;
  for (const char* parameters :
       {R"("topology": "cube")", R"("topology": "hemispheres")", R"("topology": "cube_2_4")",
        R"("topology": "icosahedron_pairs")", R"("topology": "octahedron_pairs")",
        R"("topology": "tetrahedron_quads")", R"("topology": "octahedron_quads")",
        R"("topology": "icosahedron_quads")", R"("topology": "rhombicuboctahedron", "reading": 42)",
        R"("topology": "rhombicuboctahedron")",
        R"("topology": "icosahedron_pairs", "corner_weights": "unit")",
        R"("topology": "octahedron_quads", "middle_weight": 30)"})
    out.push_back(model_of(
        parameters, build_family(fmt::format(R"({{"type": "sphere_tiling", {}}})", parameters)), true));
  out.push_back(model_of("octants", build_family(R"({"type": "sphere_octant"})"), true));
  for (const char* file : {"casciola/closed_models", "casciola/figure_1", "casciola/sphere_triangles",
                           "vidunas/complexes", "vidunas/curvature", "vidunas/figure_3", "vidunas/figure_3d",
                           "vidunas/figure_4", "vidunas/regular", "vidunas/sphere"}) {
    const std::string path = source_folder() + "/scenes/" + file + ".json";
    const Scene scene = read_scene(path, StagedScene::builtins(), {});
    for (const SceneObject& object : scene.objects) {
      const Surface& s = object.traced.surface;
      const bool wanted =
          object.type == "iss" || object.type == "gc_octahedron" || object.type == "gc_complex";
      if (wanted && s.closed) out.push_back(model_of(fmt::format("{}: {}", file, object.name), s, false));
    }
  }
  return out;
}

}  // namespace

double tangency_band(const Surface& surface, double radius) {
  double worst = 0.0;
  for (Net net : surface.patches) {
    Net magnitudes = net;
    for (dvec4& p : points_of(magnitudes)) p = glm::abs(p);
    for (const dvec2 p : grid_of(net)) {
      const dvec4 sum = net_first(magnitudes, p.x, p.y).value;
      const double w = net_first(net, p.x, p.y).value.w;
      worst = std::max(worst, (largest(dvec3(sum)) + radius * sum.w) / w);
    }
  }
  constexpr double roundoffs = 12.0;  // not the solvers' own number, lest a larger one widened the band
  return 1.25 * roundoffs * unit_roundoff * worst;
}

const std::vector<ClosedModel>& closed_models() {
  static const std::vector<ClosedModel> models = build();
  return models;
}

ClosedModel placed(const ClosedModel& model, double scale, const dvec3& center) {
  ClosedModel out = model;
  out.name =
      fmt::format("{} times {:g} at ({:g}, {:g}, {:g})", model.name, scale, center.x, center.y, center.z);
  out.surface = placed(model.surface, scale, center);
  out.radius *= scale;
  for (dvec3& p : out.inside) p = center + scale * (p - model.surface.origin);
  return out;
}

}  // namespace rondure
