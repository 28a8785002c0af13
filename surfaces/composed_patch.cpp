// A part of any family's patch as a patch of its own, cut out by a planar patch in its parameters (Cobb 1988,
// section 9: f o g).
#include <fmt/format.h>

#include <algorithm>

#include "renderer/api/registry.h"
#include "renderer/bezier/compose.h"
#include "renderer/bezier/planar_domain.h"
#include "surfaces/families.h"
#include "surfaces/net_reader.h"

namespace rondure {
namespace {

template <class Polynomial>
PlanarMap<Polynomial> planar_map(const Polynomial& shape, const std::vector<dvec4>& points) {
  PlanarMap<Polynomial> map{shape, shape, shape};
  for (std::size_t k = 0; k < points.size(); ++k) {
    map.x.coefficients[k] = points[k].x;
    map.y.coefficients[k] = points[k].y;
    map.w.coefficients[k] = points[k].w;
  }
  return map;
}

// More digits than the net has, so that its coefficients are rounded once.
auto planar_map(const TensorNet& g) { return planar_map(TensorPolynomial<long double>(g.m, g.n), g.points); }
auto planar_map(const TriangleNet& g) { return planar_map(TrianglePolynomial<long double>(g.n), g.points); }

// The degree of f times that of g, by which the composition grows.
int total_degree(const TensorNet& f) { return f.m + f.n; }
int total_degree(const TriangleNet& f) { return f.n; }

std::string degree_text(const TensorNet& g, int times) {
  return fmt::format("({}, {})", times * g.m, times * g.n);
}
std::string degree_text(const TriangleNet& g, int times) { return fmt::format("{}", times * g.n); }

int largest_degree(const TensorNet& g) { return std::max(g.m, g.n); }
int largest_degree(const TriangleNet& g) { return g.n; }

void check_domain(const Params& params, const Params& domain, const Net& g, const Net& f) {
  const bool triangle = std::holds_alternative<TriangleNet>(f);
  const auto fault = domain_fault(g, triangle ? ParameterDomain::triangle : ParameterDomain::square);
  if (fault && fault->weight) {
    domain.fail("net", "the weight of \"domain\" must be positive all over it, and is not");
  }
  if (fault) {
    domain.fail("net", fmt::format("\"domain\" reaches ({:.6g}, {:.6g}), outside the patch's parameters, {}",
                                   fault->point.x, fault->point.y,
                                   triangle ? "x, y >= 0, x + y <= 1" : "[0, 1] x [0, 1]"));
  }
  if (const auto fold = planar_fold(g)) {
    domain.fail("net",
                fmt::format("\"domain\" folds over: it keeps the orientation of the parameters at (u, v) = "
                            "({:.6g}, {:.6g}) and turns it at ({:.6g}, {:.6g})",
                            fold->left.x, fold->left.y, fold->right.x, fold->right.y));
  }
  const int times = std::visit([](const auto& n) { return total_degree(n); }, f);
  const int degree = times * std::visit([](const auto& n) { return largest_degree(n); }, g);
  if (degree > max_degree) {
    const std::string text = std::visit([&](const auto& n) { return degree_text(n, times); }, g);
    params.fail("domain",
                fmt::format("the composed patch has degree {}, and {} is the most; take a \"domain\" or a "
                            "patch of lower degree",
                            text, max_degree));
  }
}

Surface build_composed_patch(Params& params) {
  const Surface whole = nested_surface(params, "of");
  if (whole.patches.empty())
    params.fail("of", "this surface is met analytically and has no patches to cut from");
  const auto last = static_cast<std::int64_t>(whole.patches.size()) - 1;
  const auto index = static_cast<std::size_t>(params.integer("patch", 0, 0, last));
  Params domain = params.object("domain");
  Net g = read_net(domain, {"[u, v] or [w u, w v, w]", max_degree, true, true});
  if (points_of(g).front().w < 0.0) {
    for (dvec4& p : points_of(g)) p = -p;
  }
  const Net& f = whole.patches[index];
  check_domain(params, domain, g, f);
  Surface surface;
  surface.origin = whole.origin;
  surface.patches.push_back(std::visit(
      [](const auto& outer, const auto& inner) -> Net { return compose(outer, planar_map(inner)); }, f, g));
  return surface;
}

}  // namespace

void register_composed_patch(Registry& registry) {
  registry.add(SurfaceFamily{
      "composed_patch",
      "a four- or three-sided part of a patch, cut out by a planar patch in its parameters (Cobb 1988, "
      "section 9)",
      {{"of", "object", "",
        "the whole: {\"type\": any family of patches, ...} with that family's parameters"},
       {"patch", "integer >= 0", "0", "which of its patches"},
       {"domain", "{\"kind\": \"tensor\" or \"triangle\", \"degree\", \"net\"}", "",
        "a net in the patch's (u, v), as in bezier but with control points [u, v] or [w u, w v, w], inside "
        "its "
        "domain; counter-clockwise keeps the normals' side. The degree is the sum of the patch's two (a "
        "triangle's one) times the domain's, at most 24"}},
      build_composed_patch});
}

}  // namespace rondure
