// Spheres and ellipsoids of patches, filled with glass or hollowed out of it.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// center + linear . (unit sphere).
struct GlassBody {
  const char* name;
  std::string object;  // its type and what that needs
  const char* solver;
  dmat3 linear{1.0};
  dvec3 center{0.0};
  double ior = 1.5;
};

// The body alone in a constant light.
inline std::string scene_of(const GlassBody& body, int max_depth) {
  std::string rows;
  for (int i = 0; i < 3; ++i)
    rows += fmt::format("[{:.17g}, {:.17g}, {:.17g}, {:.17g}], ", body.linear[0][i], body.linear[1][i],
                        body.linear[2][i], body.center[i]);
  return fmt::format(
      R"({{ "integrator": {{ "type": "path", "max_depth": {0}, "min_depth": {0} }},
  "materials": {{ "glass": {{ "type": "dielectric", "ior": {1:.17g} }} }}, "lights": [ {{ "type": "constant" }} ],
  "objects": [ {{ {2}, "solver": "{3}", "material": "glass", "transform": [ {4} [0, 0, 0, 1] ] }} ] }})",
      max_depth, body.ior, body.object, body.solver, rows);
}

inline std::vector<GlassBody> glass_bodies() {
  const auto tiling = [](const char* topology) {
    return fmt::format(R"("type": "sphere_tiling", "topology": "{}")", topology);
  };
  const std::string octants = R"("type": "sphere_octant")";
  // Casciola and Morigi 2004, Remark 7.3: eight quartic triangles.
  const std::string quartics =
      R"("type": "iss", "vertices": [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],
      "patches": [{"sphere": [0, 2, 4]}, {"sphere": [1, 2, 4]}, {"sphere": [0, 3, 4]}, {"sphere": [1, 3, 4]},
                  {"sphere": [0, 2, 5]}, {"sphere": [1, 2, 5]}, {"sphere": [0, 3, 5]}, {"sphere": [1, 3, 5]}])";
  // Rows (2, 3, 6), (3, -6, 2), (6, 2, -3) over 7: a rotation, rounded.
  const dmat3 turned = dmat3(2, 3, 6, 3, -6, 2, 6, 2, -3) / -7.0;
  const dmat3 egg = turned * dmat3(1.0, 0, 0, 0, 0.8, 0, 0, 0, 1.7);
  return {
      {"cube", tiling("cube"), "quadric"},
      {"cube", tiling("cube"), "newton", turned},
      {"hemispheres", tiling("hemispheres"), "newton"},
      {"hemispheres, turned", tiling("hemispheres"), "auto", 0.01 * turned, {3.0, -2.0, 1.0}},
      {"octants", octants, "newton", dmat3(100.0), {-30.0, 2e4, 1e3}},
      {"octants", octants, "quadric", dmat3(1.0), {-3.0, 2.0, 1e3}, 2.4},
      {"quartics", quartics, "radial"},
      {"quartics, turned", quartics, "auto", turned, dvec3(0.0), 1.1},
      {"icosahedron pairs", tiling("icosahedron_pairs"), "newton", 1e4 * turned, {1e5, 0.0, 0.0}, 1.0 / 1.5},
      {"icosahedron pairs", tiling("icosahedron_pairs"), "quadric", turned, dvec3(0.0), 1.01},
      {"egg of cube faces", tiling("cube"), "quadric", egg},
      {"egg of hemispheres", tiling("hemispheres"), "newton", egg, dvec3(0.0), 1.3},
      {"egg of octants, a bubble", octants, "auto", egg, {0.5, 0.25, 1.0}, 1.0 / 1.5},
      {"cube", tiling("cube"), "clipping"},
  };
}

}  // namespace rondure
