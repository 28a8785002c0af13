// The unit sphere in biquartic patches: two hemispheres (Cobb 1988, Table 2), six faces of a cube (Table 4),
// or the quadrilaterals of other polyhedra (section 7); and in patches of degree (2, 4), again faces of a
// cube (Dietz, Hoschek, Juettler 1993, theorem 3.10). Neighbours share the control points of their common
// edge bit for bit, in reverse order, wherever they share its weights.
#include <fmt/format.h>

#include <string>
#include <utility>

#include "renderer/api/registry.h"
#include "renderer/projective/cube_faces.h"
#include "renderer/projective/planar_patch.h"
#include "renderer/projective/shared_points.h"
#include "surfaces/families.h"
#include "surfaces/planar_weights.h"
#include "surfaces/polyhedral_tiles.h"

namespace rondure {
namespace {

std::vector<Net> hemispheres(double middle) {
  const TensorNet south = sphere_patch(disk(2, middle), 1);
  // A half turn about x = y, z = 0: the boundary maps to itself and the net keeps its orientation.
  const AxisRotation half_turn{{1, 0, 2}, {1.0, 1.0, -1.0}};
  return {rotated(south, AxisRotation{{0, 1, 2}, {1.0, 1.0, 1.0}}), rotated(south, half_turn)};
}

std::vector<Tile> tiles_of(const std::string& topology, std::int64_t reading) {
  if (topology == "tetrahedron_pairs") return tetrahedron_pairs();
  if (topology == "octahedron_pairs") return octahedron_pairs();
  if (topology == "icosahedron_pairs") return icosahedron_pairs();
  if (topology == "tetrahedron_quads") return tetrahedron_quads();
  if (topology == "octahedron_quads") return octahedron_quads();
  if (topology == "icosahedron_quads") return icosahedron_quads();
  return reading == 42 ? rhombicuboctahedron_42() : rhombicuboctahedron_54();
}

std::vector<Net> polyhedral(const Params& params, const std::vector<Tile>& tiles, QuadPatchOptions options) {
  std::vector<Net> patches;
  for (const Tile& tile : tiles) {
    const SphericalQuad quad = geodesic_quad(tile.corner);
    options.straight_corners = true;
    options.centre = tile.centre;
    if (const auto defect = defect_of(shape_of(quad, tile.centre), options.straight_corners)) {
      params.fail("topology", "this division has a quadrilateral without a patch: " + defect->text +
                                  " (Cobb 1988, section 7)");
    }
    QuadPatch patch = quad_patch(quad, options);
    if (!patch.regular) params.fail("middle_weight", "the patches may fold with this middle weight");
    patches.emplace_back(std::move(patch.net));
  }
  share_control_points(patches);
  return patches;
}

Surface build_sphere_tiling(Params& params) {
  const Value* given = params.raw("topology");
  // Not among the choices, as it cannot be built: the tool says why.
  const bool impossible = given && given->string == "tetrahedron_pairs";
  const std::string topology =
      impossible ? given->string
                 : params.choice(
                       "topology",
                       {"hemispheres", "cube", "cube_2_4", "icosahedron_pairs", "octahedron_pairs",
                        "tetrahedron_quads", "octahedron_quads", "icosahedron_quads", "rhombicuboctahedron"},
                       "cube");
  if (topology == "cube_2_4") {
    for (const char* without_meaning : {"middle_weight", "corner_weights", "reading"}) {
      if (params.has(without_meaning))
        params.fail(without_meaning, fmt::format("\"{}\" has no meaning for \"cube_2_4\"", without_meaning));
    }
    Surface surface;
    surface.closed = true;
    surface.patches = cube_of(cube_face_2_4());
    return surface;
  }
  const double middle = read_middle_weight(params);
  const CornerWeights corners = read_corner_weights(params);
  // Known everywhere, read only where it has a meaning.
  std::int64_t reading = 54;
  if (params.has("reading") && topology == "rhombicuboctahedron") {
    reading = params.integer("reading", 42, 54);
    if (reading != 42 && reading != 54) params.fail("reading", "\"reading\" must be 42 or 54");
  }
  Surface surface;
  surface.closed = true;
  if (topology == "cube") {
    surface.patches = cube_of(sphere_patch(cube_square(middle), 1));
  } else if (topology == "hemispheres") {
    surface.patches = hemispheres(middle);
  } else {
    QuadPatchOptions options;
    options.corner_weights = corners;
    options.middle_weight = middle;
    options.may_double = false;
    surface.patches = polyhedral(params, tiles_of(topology, reading), options);
  }
  return surface;
}

}  // namespace

void register_sphere_tiling(Registry& registry) {
  registry.add(SurfaceFamily{
      "sphere_tiling",
      "the whole unit sphere in patches of degree (4, 4) (Cobb 1988, sections 5 to 7) or (2, 4) (Dietz, "
      "Hoschek, Juettler 1993, theorem 3.10)",
      {{"topology",
        "\"hemispheres\", \"cube\", \"cube_2_4\", \"icosahedron_pairs\", \"octahedron_pairs\", "
        "\"tetrahedron_quads\", "
        "\"octahedron_quads\", \"icosahedron_quads\" or \"rhombicuboctahedron\"",
        "\"cube\"",
        "2 hemispheres, singular at four points of the equator; 6 faces of a cube; the same of degree (2, "
        "4), the least "
        "there is, without parameters; triangles of a polyhedron "
        "joined in pairs (10, or 4 with two singular corners each) or divided in three (12, 24, 60); the "
        "rhombicuboctahedron with divided triangles. All but hemispheres and octahedron_pairs are regular; "
        "\"tetrahedron_pairs\", with corners of 240 degrees, is refused"},
       {"reading", "42 or 54", "54 for the rhombicuboctahedron, which alone takes it",
        "54: edge to edge, the twelve squares between the axes halved; 42: whole squares, beside which the "
        "triangles have a corner in the middle of the edge"},
       middle_weight_doc("1"),
       corner_weights_doc()},
      build_sphere_tiling});
}

}  // namespace rondure
