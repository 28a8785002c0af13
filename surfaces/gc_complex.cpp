// Smooth surfaces over any geometrically continuous complex of triangles and squares (Vidunas 2005, section
// 5).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "renderer/api/registry.h"
#include "renderer/complex/local_basis.h"
#include "surfaces/complex_reader.h"
#include "surfaces/families.h"
#include "surfaces/gc_points.h"

namespace rondure {
namespace {

// The corners' places by polygon, from the key "vertices".
std::vector<std::vector<dvec3>> read_corners(Params& params, const ComplexChoice& choice) {
  const Value& value = *params.raw("vertices");
  if (value.kind != Value::Kind::array || value.items.size() != static_cast<std::size_t>(choice.vertex_count))
    params.fail(value, fmt::format("\"vertices\" is an array of {} points [x, y, z], one for every vertex",
                                   choice.vertex_count));
  std::vector<dvec3> points;
  for (const Value& item : value.items) {
    dvec3 p(0.0);
    bool good = item.kind == Value::Kind::array && item.items.size() == 3;
    for (std::size_t d = 0; good && d < 3; ++d) {
      good = item.items[d].kind == Value::Kind::number && std::isfinite(item.items[d].number);
      p[static_cast<int>(d)] = item.items[d].number;
    }
    if (!good) params.fail(item, "a vertex is [x, y, z]");
    points.push_back(p);
  }
  std::vector<std::vector<dvec3>> corners;
  for (const auto& polygon : choice.vertices) {
    corners.emplace_back();
    for (const int v : polygon) corners.back().push_back(points[static_cast<std::size_t>(v)]);
  }
  return corners;
}

SplineSpace space_of(Params& params, const SurfaceComplex& complex, int degree) {
  std::size_t unknowns = 0;
  for (const int sides : complex.sides)
    unknowns += static_cast<std::size_t>(coefficient_count(sides, degree));
  // Exact elimination of some 2000 unknowns takes seconds, and more than in proportion beyond.
  if (unknowns > 2000)
    params.fail(fmt::format("degree {} on {} polygons has {} coefficients, more than 2000", degree,
                            complex.sides.size(), unknowns));
  try {
    SplineSpace space = complex.exact ? local_spline_space(complex, degree) : spline_space(complex, degree);
    // Of larger functions control points lose more than the last four digits; rounded functions lose theirs.
    if (largest_entry(space.solutions) <= (complex.exact ? 1e4 : 100.0)) return space;
    return balanced_spline_space(complex, degree);
  } catch (const std::runtime_error& error) {
    params.fail(error.what());
  }
}

std::vector<Note> notes_of(const SplineSpace& space) {
  std::size_t widest = 0;
  for (std::size_t k = 0; k < space.dimension(); ++k) widest = std::max(widest, support_of(space, k).size());
  std::vector<Note> notes = {{"dimension", static_cast<double>(space.dimension()),
                              "of the space of geometrically continuous splines"},
                             {"widest_support", static_cast<double>(widest),
                              "polygons on which a function of its basis lives, at most"}};
  if (!space.solutions.exact)
    notes.push_back({"gap", space.solutions.gap,
                     "by which what counts in the rank of the conditions is above what rounding leaves"});
  return notes;
}

Surface build(Params& params) {
  const ComplexChoice choice = read_complex(params);
  const int degree = static_cast<int>(params.integer("degree", 3, 1, 8));
  const SplineSpace space = space_of(params, choice.complex, degree);
  const GcBasis basis = basis_of(choice.complex, space);
  // The functions add up to 1, so that the points span one dimension less.
  if (space.dimension() < 3)
    params.fail(
        "degree",
        fmt::format("there {} of degree {} on this complex, which make no surface: take a higher degree",
                    space.dimension() == 1 ? "is but 1 function" : "are but 2 functions", degree));
  std::vector<std::optional<BlendPoint>> defaults(basis.names.size());
  CoefficientTargets targets;
  if (params.has("vertices")) {
    targets = flat_targets(choice.complex, degree, read_corners(params, choice));
  } else if (choice.shape) {
    targets = choice.shape(degree);
  }
  if (!targets.empty()) {
    const std::vector<BlendPoint> fitted = fitted_points(basis, targets);
    for (std::size_t k = 0; k < fitted.size(); ++k) defaults[k] = fitted[k];
  }
  Surface surface =
      blended_surface(params, choice.complex, basis, read_blend_points(params, basis.names, defaults));
  const std::vector<Note> notes = notes_of(space);
  surface.notes.insert(surface.notes.begin(), notes.begin(), notes.end());
  return surface;
}

}  // namespace

void register_gc_complex(Registry& registry) {
  registry.add(SurfaceFamily{
      "gc_complex",
      "smooth surfaces over any complex of glued triangles and squares (Vidunas 2005, section 5)",
      {complex_doc(),
       {"degree", "integer 1 to 8", "3",
        "of the splines, in each direction on squares; mixed complexes need 4 or 5 to be regular"},
       {"vertices", "array of [x, y, z]", "none",
        "a place for every vertex, in the order of \"polygons\"' numbers or of the first corner at it: the "
        "surface is the one that comes nearest to the flat polygons. Without them the octahedron and the "
        "cube "
        "come near a sphere, the torus near one of radii 1 and 1/2"},
       control_points_doc("those that come nearest to the shape",
                          "of the basis functions, named \"p:ijk\" (triangles) or \"p:i,j\" (squares) after "
                          "polygon and coefficient; they replace what the vertices give")},
      build});
}

}  // namespace rondure
