#include "renderer/complex/complex_surface.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/bezier/transform.h"

namespace rondure {
namespace {

std::size_t index(int k) { return static_cast<std::size_t>(k); }

ExactPatch raised(const ExactPatch& patch, int degree) {
  ExactPatch out = patch;
  for (PolygonPolynomial& p : out) p = elevated(p, degree);
  return out;
}

bool positive_weights(const ExactPatch& patch) {
  return std::all_of(patch[3].coefficients.begin(), patch[3].coefficients.end(),
                     [](const Exact& w) { return w > 0; });
}

Net rounded_net(const ExactPatch& patch) {
  const int n = patch[0].degree;
  Net net = patch[0].sides == 3 ? Net(TriangleNet(n)) : Net(TensorNet(n, n));
  std::vector<dvec4>& points = points_of(net);
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (int d = 0; d < 4; ++d) points[k][d] = rounded(patch[index(d)].coefficients[k]);
  }
  return net;
}

// Three times the volume of the cone over the patch, by the midpoint rule: good for its sign.
double cone_volume(const Net& net) {
  constexpr int cells = 12;
  const bool triangle = std::holds_alternative<TriangleNet>(net);
  double sum = 0.0;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const double u = (i + 0.5) / cells;
      const double v = (j + 0.5) / cells * (triangle ? 1.0 - u : 1.0);
      const SurfaceJet jet = surface_jet(net, u, v);
      sum += glm::dot(jet.point, glm::cross(jet.du, jet.dv)) * (triangle ? 1.0 - u : 1.0);
    }
  }
  return sum;
}

}  // namespace

std::vector<ExactPatch> blend(const GcBasis& basis, const std::vector<BlendPoint>& points, bool weighted) {
  std::vector<ExactPatch> patches;
  for (std::size_t p = 0; p < basis.denominators.size(); ++p) {
    const PolygonPolynomial& like = basis.functions.front()[p];
    const PolygonPolynomial zero{like.sides, like.degree, std::vector<Exact>(like.coefficients.size())};
    ExactPatch patch{zero, zero, zero, zero};
    if (!weighted) patch[3] = basis.denominators[p];
    for (std::size_t k = 0; k < basis.functions.size(); ++k) {
      const std::vector<Exact>& f = basis.functions[k][p].coefficients;
      for (std::size_t c = 0; c < f.size(); ++c) {
        if (f[c] == 0) continue;
        const Exact size = weighted ? Exact(f[c] * points[k].weight) : f[c];
        for (std::size_t d = 0; d < 3; ++d) patch[d].coefficients[c] += size * points[k].point[d];
        if (weighted) patch[3].coefficients[c] += size;
      }
    }
    const int degree = std::max(patch[0].degree, patch[3].degree);
    patches.push_back(raised(patch, degree));
  }
  return patches;
}

Net net_of(const ExactPatch& patch) {
  for (int more = 0; more <= 4; ++more) {
    const ExactPatch tried = more == 0 ? patch : raised(patch, patch[0].degree + more);
    if (positive_weights(tried)) return rounded_net(tried);
  }
  return rounded_net(patch);
}

Surface oriented_surface(const SurfaceComplex& complex, std::vector<Net> nets) {
  const Topology topology = topology_of(complex);
  Surface surface;
  std::vector<double> volume(index(topology.parts), 0.0);
  for (std::size_t k = 0; k < nets.size(); ++k) {
    surface.patches.push_back(topology.turned[k] ? reversed(nets[k]) : std::move(nets[k]));
    volume[index(topology.part[k])] += cone_volume(surface.patches.back());
  }
  surface.closed = topology.boundary_edges == 0 && topology.orientable;
  for (std::size_t k = 0; surface.closed && k < surface.patches.size(); ++k) {
    if (volume[index(topology.part[k])] < 0.0) surface.patches[k] = reversed(surface.patches[k]);
  }
  return surface;
}

}  // namespace rondure
