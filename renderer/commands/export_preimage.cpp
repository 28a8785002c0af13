#include "renderer/commands/export_preimage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/api/utf8.h"
#include "renderer/bezier/net_text.h"
#include "renderer/bezier/rational.h"
#include "renderer/projective/preimage.h"

namespace rondure {
namespace {

std::string text_of(const TensorPreimage& p) { return tensor_text(p); }
std::string text_of(const TrianglePreimage& p) { return triangle_text(p); }

// Of a sphere that a patch may lie on, about the surface's origin; to 13 digits, which undoes the rounding of
// the radius that a scene gave.
double radius_of(const Net& net) {
  const dvec4 p = net_first(net, 0.3, 0.4).value;
  return std::stod(fmt::format("{:.13g}", glm::length(dvec3(p)) / std::abs(p.w)));
}

Net scaled(Net net, double factor) {
  for (dvec4& p : points_of(net)) p = dvec4(dvec3(p) * factor, p.w);
  return net;
}

// A preimage is found to ten digits: what is less than that of the largest coordinate is 0.
Preimage cleaned(Preimage preimage) {
  std::visit(
      [](auto& p) {
        long double largest = 0;
        for (const lvec4& c : p.coefficients) largest = std::max(largest, glm::length(c));
        for (lvec4& c : p.coefficients) {
          for (int d = 0; d < 4; ++d) c[d] = std::abs(c[d]) < 1e-12L * largest ? 0 : c[d];
        }
      },
      preimage);
  return preimage;
}

bool on_unit_sphere(const Net& net) {
  const bool triangle = std::holds_alternative<TriangleNet>(net);
  double off = 0.0;
  for (int i = 0; i <= 8; ++i) {
    for (int j = 0; j <= (triangle ? 8 - i : 8); ++j) {
      const dvec4 p = net_first(net, i / 8.0, j / 8.0).value;
      off = std::max(off, std::abs(glm::length(dvec3(p)) - std::abs(p.w)) / glm::length(p));
    }
  }
  return off <= 1e-10;
}

std::string why_no_preimage(const Net& net) {
  if (!on_unit_sphere(net)) return "does not lie on a sphere about the surface's centre";
  const auto* tensor = std::get_if<TensorNet>(&net);
  const int m = tensor ? tensor->m : std::get<TriangleNet>(net).n, n = tensor ? tensor->n : m;
  if (m % 2 != 0 || n % 2 != 0)
    return "has an odd degree, and so a factor that its four coordinates have in common";
  return "has a factor that its four coordinates have in common";
}

}  // namespace

std::string preimage_members(const Scene& scene, const SceneObject& object) {
  const Surface& surface = object.traced.surface;
  const auto fail = [&](const std::string& what) {
    scene.fail(object.where, fmt::format("{}: {}", printable(object.name), what));
  };
  if (surface.patches.empty()) fail("is analytic: it has no nets");
  const double radius = radius_of(surface.patches.front());
  std::string out = fmt::format(
      R"("type": "projected_net", "closed": {}, "center": [{}, {}, {}], "radius": {}, "patches": [)",
      surface.closed, surface.origin.x, surface.origin.y, surface.origin.z, radius);
  for (std::size_t k = 0; k < surface.patches.size(); ++k) {
    const Net net = scaled(surface.patches[k], 1.0 / radius);
    const std::optional<Preimage> found = sphere_preimage(net);
    if (!found)
      fail(
          fmt::format("patch {} {}: it is no image of a net of half its degree (Dietz, Hoschek, Juettler "
                      "1993, theorem 2.2)",
                      k, why_no_preimage(net)));
    const Preimage preimage = cleaned(*found);
    std::string places;
    for (const dvec2& at : base_points(preimage, false, 4))
      places += fmt::format("{}({:.9g}, {:.9g})", places.empty() ? "" : ", ", at.x, at.y);
    if (!places.empty())
      fail(fmt::format("the preimage of patch {} has base points, where the patch is no point: (u, v) = {}",
                       k, places));
    out +=
        (k > 0 ? ",\n      " : "\n      ") + std::visit([](const auto& p) { return text_of(p); }, preimage);
  }
  return out + " ] }";
}

}  // namespace rondure
