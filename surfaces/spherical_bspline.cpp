// Tensor-product B-spline surfaces on the unit sphere: images of B-spline surfaces of projective 3-space
// under delta, one patch for each rectangle of knots (Dietz, Hoschek, Juettler 1993, section 4).
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "renderer/api/registry.h"
#include "renderer/bezier/bernstein.h"
#include "renderer/projective/bspline.h"
#include "renderer/projective/shared_points.h"
#include "surfaces/families.h"
#include "surfaces/spline_reader.h"

namespace rondure {
namespace {

using Kind = Value::Kind;

constexpr std::int64_t highest_degree = max_degree / 2;

void read_net(Params& params, BSplineSurface& surface) {
  const Value* rows = params.raw("net");
  if (!rows) params.fail("\"net\" is missing; it must be an array of rows of control points");
  if (rows->kind != Kind::array || rows->items.empty())
    params.fail(*rows, "\"net\" must be an array of rows of control points, net[i][j] with i along u");
  for (const Value& row : rows->items) {
    if (row.kind != Kind::array || row.items.empty() ||
        (surface.columns != 0 && row.items.size() != surface.columns))
      params.fail(row, "the rows of \"net\" must be arrays of equally many control points");
    surface.columns = row.items.size();
    for (const Value& point : row.items) surface.points.push_back(read_preimage_point(params, point));
  }
  const long double factor = squaring_factor(surface.points);
  for (lvec4& p : surface.points) p *= factor;
}

BSplineSurface read_surface(Params& params) {
  BSplineSurface surface;
  read_net(params, surface);
  const std::size_t counts[2] = {surface.points.size() / surface.columns, surface.columns};
  std::vector<std::int64_t> degree{2, 2};
  if (params.has("degree")) degree = params.integers("degree", 1, highest_degree);
  if (degree.size() != 2) params.fail("degree", "\"degree\" must be two integers, [along u, along v]");
  std::vector<long double> knots[2];
  const Value* given = params.raw("knots");
  if (given && (given->kind != Kind::array || given->items.size() != 2))
    params.fail(*given, "\"knots\" must be two arrays of numbers, [along u, along v]");
  for (std::size_t k = 0; k < 2; ++k) {
    const int d = static_cast<int>(degree[k]);
    if (counts[k] <= static_cast<std::size_t>(d))
      params.fail("net", fmt::format("degree {} needs at least {} control points along {}", d, d + 1,
                                     k == 0 ? "u" : "v"));
    knots[k] = given ? read_knots(params, given->items[k]) : clamped_knots(d, counts[k]);
    const std::string defect = knot_defect(d, knots[k], counts[k]);
    if (!defect.empty())
      params.fail(given ? given->items[k] : *params.raw("net"),
                  fmt::format("along {}: {}", k == 0 ? "u" : "v", defect));
  }
  surface.degree_u = static_cast<int>(degree[0]);
  surface.degree_v = static_cast<int>(degree[1]);
  surface.knots_u = std::move(knots[0]);
  surface.knots_v = std::move(knots[1]);
  return surface;
}

Surface build_spherical_bspline(Params& params) {
  const BSplineSurface spline = read_surface(params);
  Surface surface;
  for (const TensorPreimage& piece : bezier_pieces(spline)) {
    const std::vector<dvec2> found = base_points(piece, false, 1);
    if (!found.empty())
      params.fail("net",
                  fmt::format("the image is no point where p0 = p1 = p2 = p3 = 0, at (u, v) = ({:.9g}, "
                              "{:.9g}) of patch {}",
                              found[0].x, found[0].y, surface.patches.size()));
    surface.patches.push_back(sphere_image(piece));
  }
  share_control_points(surface.patches);
  surface.closed = params.boolean("closed", false);
  return surface;
}

}  // namespace

void register_spherical_bspline(Registry& registry) {
  registry.add(SurfaceFamily{
      "spherical_bspline",
      "a tensor-product B-spline surface on the unit sphere from one in projective 3-space, degree doubled "
      "(Dietz, Hoschek, Juettler 1993, section 4)",
      {{"net", "array of rows of control points [p0, p1, p2, p3]", "",
        "net[i][j] with i along u; the four coordinates must not vanish together on the surface"},
       {"degree", "two integers from 1 to 12", "[2, 2]", "of the surface in projective space, along u and v"},
       {"knots", "two arrays of numbers", "equidistant, the ends repeated",
        "along u and v, not decreasing; as many as control points and degree + 1. A simple knot leaves the "
        "surface differentiable degree - 1 times"},
       {"closed", "boolean", "false", "the patches bound a solid"}},
      build_spherical_bspline});
}

}  // namespace rondure
