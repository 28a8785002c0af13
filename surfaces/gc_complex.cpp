// Smooth surfaces over any geometrically continuous complex of triangles and squares (Vidunas 2005, section
// 5).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "renderer/api/registry.h"
#include "renderer/complex/local_basis.h"
#include "renderer/continuity/regularity.h"
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

constexpr std::size_t most_coefficients = 2000;

SplineSpace space_of(Params& params, const SurfaceComplex& complex, int degree) {
  std::size_t unknowns = 0;
  for (const int sides : complex.sides)
    unknowns += static_cast<std::size_t>(coefficient_count(sides, degree));
  // Exact elimination of some 2000 unknowns takes seconds, and more than in proportion beyond.
  if (unknowns > most_coefficients)
    params.fail(
        fmt::format("degree {} on {} polygons has {} coefficients, more than {}: take a lower degree or "
                    "fewer polygons",
                    degree, complex.sides.size(), unknowns, most_coefficients));
  try {
    if (!complex.exact) return rounded_local_space(complex, degree);
    SplineSpace space = local_spline_space(complex, degree);
    // Of larger functions control points lose more than the last four digits.
    return largest_entry(space.solutions) <= 1e4 ? space : rounded_local_space(complex, degree);
  } catch (const std::runtime_error& error) {
    params.fail(error.what());
  }
}

std::vector<Note> notes_of(const SurfaceComplex& complex, const SplineSpace& space) {
  std::size_t widest = 0, local = 0;
  for (std::size_t k = 0; k < space.dimension(); ++k) {
    const std::size_t width = support_of(space, k).size();
    widest = std::max(widest, width);
    local += 2 * width <= complex.sides.size() ? 1 : 0;
  }
  std::vector<Note> notes = {{"dimension", static_cast<double>(space.dimension()),
                              "of the space of geometrically continuous splines"},
                             {"widest_support", static_cast<double>(widest),
                              "polygons on which a function of its basis lives, at most"}};
  if (space.solutions.exact) return notes;
  notes.push_back({"gap", space.solutions.gap,
                   "by which what counts in the rank of the conditions is above what rounding leaves"});
  notes.push_back({"local", static_cast<double>(local),
                   complex.exact
                       ? "functions on half of the polygons at most, all of them rounded: exact functions "
                         "on few polygons would exceed 10^4 here, and their control points lose digits"
                       : "functions on half of the polygons at most, all of them rounded, since the "
                         "complex is not rational"});
  return notes;
}

// Few or thin cells do not reach round a shape in every degree (Vidunas 2005, Theorem 2.3 asks for regular
// patches).
void warn_if_singular(Surface& surface) {
  constexpr long budget = 20000;
  const Regularity found = regularity_of(surface, budget);
  if (found.verdict == Regularity::Verdict::regular) return;
  const SingularPoint& at = found.singular.empty() ? found.least_at : found.singular.front();
  surface.warnings.push_back(fmt::format(
      "the surface {} singular, so that it is not smooth, in patch {} at (u, v) = ({:.6g}, {:.6g}){}: "
      "take a higher degree, more polygons or \"control_points\"",
      found.singular.empty() ? "may be" : "is", at.patch, at.u, at.v,
      found.singular.size() > 1 ? " and elsewhere" : ""));
}

Surface build_gc_complex(Params& params) {
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
  if (!params.has("control_points") && !targets.empty()) warn_if_singular(surface);
  const std::vector<Note> notes = notes_of(choice.complex, space);
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
        "of the splines, in each direction on squares; mixed complexes need 4 or 5 to be regular, tori with "
        "k or l "
        "= 1 too. All polygons have 2000 coefficients at most: 16 each on squares in degree 3, 25 in degree "
        "4"},
       {"vertices", "array of [x, y, z]", "none",
        "a place for every vertex, in the order of \"polygons\"' numbers or of the first corner at it: the "
        "surface is the one that comes nearest to the flat polygons. Without them the octahedron and the "
        "cube "
        "come near a sphere, the torus near one of radii 1 and 1/2"},
       control_points_doc("those that come nearest to the shape",
                          "of the basis functions, named \"p:ijk\" (triangles) or \"p:i,j\" (squares) after "
                          "polygon and coefficient; they replace what the vertices give")},
      build_gc_complex});
}

}  // namespace rondure
