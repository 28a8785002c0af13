#include "renderer/complex/complex_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/index.h"
#include "renderer/bezier/rational.h"
#include "renderer/bezier/transform.h"
#include "renderer/complex/weld.h"

namespace rondure {
namespace {

ExactPatch raised(const ExactPatch& patch, int degree) {
  ExactPatch out = patch;
  for (PolygonPolynomial& p : out) p = elevated(p, degree);
  return out;
}

bool positive_weights(const ExactPatch& patch) {
  return std::all_of(patch[3].coefficients.begin(), patch[3].coefficients.end(),
                     [](const Exact& w) { return w > 0; });
}

// By how much the degree must be raised for all weights to be positive; 0 if 4 is not enough.
int needed_raise(const ExactPatch& patch) {
  for (int more = 0; more <= 4; ++more) {
    if (positive_weights(more == 0 ? patch : raised(patch, patch[0].degree + more))) return more;
  }
  return 0;
}

// A number times which all coordinates are doubles; 1 where there is none that is short, and where all
// weights are 1 and should stay so.
Exact common_multiple(const std::vector<ExactPatch>& patches) {
  constexpr int longest = 1 << 20;
  Integer multiple = 1;
  bool rational = false;
  for (const ExactPatch& patch : patches) {
    for (const PolygonPolynomial& p : patch) {
      for (const Exact& c : p.coefficients) {
        Integer odd = denominator(c);
        odd >>= lsb(odd);
        multiple = boost::multiprecision::lcm(multiple, odd);
        if (multiple > longest) return 1;
      }
    }
    for (const Exact& w : patch[3].coefficients) rational = rational || w != 1;
  }
  if (!rational) return 1;
  const Exact factor(multiple);
  for (const ExactPatch& patch : patches) {
    for (const PolygonPolynomial& p : patch) {
      for (const Exact& c : p.coefficients) {
        const Exact whole = c * factor;
        if (exact_of(rounded(whole)) != whole) return 1;
      }
    }
  }
  return factor;
}

Net rounded_net(const ExactPatch& patch, const Exact& factor, std::size_t& roundings) {
  const int n = patch[0].degree;
  Net net = patch[0].sides == 3 ? Net(TriangleNet(n)) : Net(TensorNet(n, n));
  std::vector<dvec4>& points = points_of(net);
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (int d = 0; d < 4; ++d) {
      const Exact exact = patch[index(d)].coefficients[k] * factor;
      points[k][d] = rounded(exact);
      if (!std::isfinite(points[k][d]) || exact_of(points[k][d]) != exact) ++roundings;
    }
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

RoundedNets nets_of(const std::vector<ExactPatch>& patches) {
  std::vector<ExactPatch> positive;
  for (const ExactPatch& patch : patches)
    positive.push_back(raised(patch, patch[0].degree + needed_raise(patch)));
  const Exact factor = common_multiple(positive);
  RoundedNets out;
  for (const ExactPatch& patch : positive) out.nets.push_back(rounded_net(patch, factor, out.roundings));
  return out;
}

Surface oriented_surface(const SurfaceComplex& complex, std::vector<Net> nets) {
  weld(complex, nets);
  const Topology topology = topology_of(complex);
  Surface surface;
  std::vector<bool> turned = topology.turned;
  std::vector<double> volume(index(topology.parts), 0.0);
  for (std::size_t k = 0; k < nets.size(); ++k) {
    surface.patches.push_back(turned[k] ? reversed(nets[k]) : std::move(nets[k]));
    volume[index(topology.part[k])] += cone_volume(surface.patches.back());
  }
  surface.closed = topology.boundary_edges == 0 && topology.orientable;
  for (std::size_t k = 0; surface.closed && k < surface.patches.size(); ++k) {
    if (!(volume[index(topology.part[k])] < 0.0)) continue;
    surface.patches[k] = reversed(surface.patches[k]);
    turned[k] = !turned[k];
  }
  for (const EdgeJoin& join : complex.joins) {
    const auto side = [&](const EdgeRef& e) {
      return turned[index(e.polygon)] ? reversed_side(complex.sides[index(e.polygon)], e.edge) : e.edge;
    };
    const bool opposite = join.parameter.at(Exact(0)) != 0;
    surface.joins.push_back({join.p.polygon, side(join.p), join.q.polygon, side(join.q),
                             opposite != (turned[index(join.p.polygon)] != turned[index(join.q.polygon)])});
  }
  return surface;
}

}  // namespace rondure
