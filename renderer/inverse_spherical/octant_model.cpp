#include "renderer/inverse_spherical/octant_model.h"

namespace rondure {
namespace {

constexpr int axis_bit(int axis) { return 1 << axis; }

// Weights by octant and by the powers of the three axes.
struct OctantWeights {
  int n;
  const std::array<std::vector<double>, 8>* weights;

  double at(int octant, const std::array<int, 3>& p) const {
    return (
        *weights)[static_cast<std::size_t>(octant)][static_cast<std::size_t>(triangle_index(n, p[0], p[1]))];
  }
};

// Half the sum of the weights one step off an edge, on its two sides: the edge runs in the plane where axis
// `zero` vanishes.
double across(const OctantWeights& w, int octant, int zero, std::array<int, 3> p) {
  p[static_cast<std::size_t>(zero)] = 1;
  return 0.5 * (w.at(octant, p) + w.at(octant ^ axis_bit(zero), p));
}

}  // namespace

// Along the edge where axis d vanishes, k + l = n, with c and c' on its two sides:
// 2 (n - 1) c_kl0 = k (c_{k-1,l,1} + c'_{k-1,l,1}) + l (c_{k,l-1,1} + c'_{k,l-1,1}).
std::array<PlanarIss, 8> octant_model(int n, const std::array<std::vector<double>, 8>& interior) {
  std::array<std::vector<double>, 8> weights = interior;
  const OctantWeights net{n, &weights};
  const auto set = [&](int octant, const std::array<int, 3>& p, double value) {
    weights[static_cast<std::size_t>(octant)][static_cast<std::size_t>(triangle_index(n, p[0], p[1]))] =
        value;
  };
  // Between the corners' neighbours an edge depends on interior weights alone.
  for (int o = 0; o < 8; ++o) {
    for (int zero = 0; zero < 3; ++zero) {
      const auto a = static_cast<std::size_t>((zero + 1) % 3), b = static_cast<std::size_t>((zero + 2) % 3);
      for (int k = 2; k <= n - 2; ++k) {
        std::array<int, 3> p{};
        p[a] = k, p[b] = n - k;
        std::array<int, 3> pa = p, pb = p;
        --pa[a], --pb[b];
        set(o, p, (k * across(net, o, zero, pa) + (n - k) * across(net, o, zero, pb)) / (n - 1.0));
      }
    }
  }
  // At a corner, the first weights of its four edges and its own solve a small system: with m the mean of the
  // four twists, the edges' mean is e = m (n - 1) / (n - 2), each edge is its own two twists' mean plus
  // e / (n - 1), the corner is e n / (n - 1).
  for (int o = 0; o < 8; ++o) {
    for (int axis = 0; axis < 3; ++axis) {
      const int b = (axis + 1) % 3, c = (axis + 2) % 3;
      std::array<int, 3> twist{1, 1, 1};
      twist[static_cast<std::size_t>(axis)] = n - 2;
      const int over_b = o ^ axis_bit(b), over_c = o ^ axis_bit(c);
      // Symmetric in the octants, so that each of the four computes the same bits.
      const int base = o & axis_bit(axis);
      const double sum =
          (net.at(base, twist) + net.at(base | axis_bit(b), twist)) +
          (net.at(base | axis_bit(c), twist) + net.at(base | axis_bit(b) | axis_bit(c), twist));
      const double mean = 0.25 * sum * (n - 1.0) / (n - 2.0);
      std::array<int, 3> p{};
      p[static_cast<std::size_t>(axis)] = n;
      set(o, p, mean * n / (n - 1.0));
      p[static_cast<std::size_t>(axis)] = n - 1;
      p[static_cast<std::size_t>(b)] = 1;
      set(o, p, 0.5 * (net.at(o, twist) + net.at(over_c, twist)) + mean / (n - 1.0));
      p[static_cast<std::size_t>(b)] = 0;
      p[static_cast<std::size_t>(c)] = 1;
      set(o, p, 0.5 * (net.at(o, twist) + net.at(over_b, twist)) + mean / (n - 1.0));
    }
  }
  std::array<PlanarIss, 8> out;
  for (int o = 0; o < 8; ++o) {
    PlanarIss& s = out[static_cast<std::size_t>(o)];
    s.n = n;
    for (int axis = 0; axis < 3; ++axis) {
      s.corners[static_cast<std::size_t>(axis)][axis] = (o & axis_bit(axis)) != 0 ? -1.0 : 1.0;
    }
    s.weights = weights[static_cast<std::size_t>(o)];
  }
  return out;
}

}  // namespace rondure
