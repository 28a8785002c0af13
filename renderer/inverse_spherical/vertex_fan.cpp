#include "renderer/inverse_spherical/vertex_fan.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "renderer/bezier/triangle_keys.h"

namespace rondure {
namespace {

// Cosine of 2 pi m / N, with the exact zeros and halves where there are such.
double turn_cosine(int m, int sides) {
  const int twelfths = 12 * m;
  if (twelfths % sides == 0) {
    constexpr double half_root = 0.86602540378443864676;
    constexpr double table[12] = {1,  half_root,  0.5,  0, -0.5, -half_root,
                                  -1, -half_root, -0.5, 0, 0.5,  half_root};
    return table[((twelfths / sides) % 12 + 12) % 12];
  }
  return std::cos(2.0 * std::numbers::pi * m / sides);
}

double turn_sine(int m, int sides) {
  // sin x = cos(x - pi / 2), where a quarter of the turn is a whole number of steps.
  return sides % 4 == 0        ? turn_cosine(m - sides / 4, sides)
         : 12 * m % sides == 0 ? turn_cosine(12 * m / sides - 3, 12)
                               : std::sin(2.0 * std::numbers::pi * m / sides);
}

class Fan {
 public:
  Fan(int sides, int n, std::vector<std::vector<double>>& weights)
      : sides_(sides), n_(n), weights_(weights) {}

  double& at(int patch, int i, int j) {
    return weights_[static_cast<std::size_t>((patch + sides_) % sides_)]
                   [static_cast<std::size_t>(triangle_index(n_, i, j))];
  }
  double spoke(int m, int j) { return at(m, n_ - j, j); }
  // Both patches at a spoke hold its weights.
  void set_spoke(int m, int j, double value) {
    at(m, n_ - j, j) = value;
    at(m - 1, n_ - j, 0) = value;
  }
  double& after(int m, int j) { return at(m, n_ - 1 - j, j); }       // R+_j, in patch m
  double& before(int m, int j) { return at(m - 1, n_ - 1 - j, 1); }  // R-_j, in patch m - 1

 private:
  int sides_, n_;
  std::vector<std::vector<double>>& weights_;
};

// The spokes' first weights become linear in the domain: their mean is the centre's, their first harmonic
// stays.
void make_plane(Fan& fan, int sides) {
  const double centre = fan.spoke(0, 0);
  double along_a = 0.0, along_b = 0.0;
  for (int m = 0; m < sides; ++m) {
    along_a += (fan.spoke(m, 1) - centre) * turn_cosine(m, sides) * 2.0 / sides;
    along_b += (fan.spoke(m, 1) - centre) * turn_sine(m, sides) * 2.0 / sides;
  }
  for (int m = 0; m < sides; ++m) {
    fan.set_spoke(m, 0, centre);
    fan.set_spoke(m, 1, centre + along_a * turn_cosine(m, sides) + along_b * turn_sine(m, sides));
  }
}

// N = 4, where cos = 0: t_{m-1} + t_m = 2 d_m leaves one twist; the spokes' second weights are free.
void settle_four_twists(Fan& fan) {
  double offset = 0.0, fit = 0.0;
  double wanted[4];
  for (int m = 0; m < 4; ++m) {
    wanted[m] = m == 0 ? 0.0 : 2.0 * fan.spoke(m, 1) - wanted[m - 1];
    fit += (m % 2 == 0 ? 1.0 : -1.0) * (fan.after(m, 1) - wanted[m]);
  }
  offset = fit / 4.0;
  for (int m = 0; m < 4; ++m) fan.after(m, 1) = wanted[m] + (m % 2 == 0 ? offset : -offset);
}

}  // namespace

dvec3 FanDomain::corner(int m) const { return centre + turn_cosine(m, sides) * a + turn_sine(m, sides) * b; }

std::vector<PlanarIss> smooth_fan(const FanDomain& domain, int n, std::vector<std::vector<double>> weights) {
  const int sides = domain.sides;
  if (sides < 3 || n < 2) throw std::invalid_argument("a fan has at least 3 patches, of degree 2 or more");
  const double c = turn_cosine(1, sides);
  Fan fan(sides, n, weights);
  make_plane(fan, sides);
  for (int m = 0; m < sides; ++m) {
    for (int j = 2; j <= n; ++j) fan.set_spoke(m, j, fan.spoke(m, j));
  }
  if (sides == 4) {
    settle_four_twists(fan);
  } else {
    for (int m = 0; m < sides; ++m) {
      const double twists = fan.before(m, 1) + fan.after(m, 1);
      fan.set_spoke(m, 2, (twists - (2.0 - 2.0 * c) * fan.spoke(m, 1)) / (2.0 * c));
    }
  }
  for (int m = 0; m < sides; ++m) {
    for (int j = 2; j < n; ++j) {
      const double wanted = 2.0 * c * fan.spoke(m, j + 1) + (2.0 - 2.0 * c) * fan.spoke(m, j);
      const double half = 0.5 * (wanted - (fan.before(m, j) + fan.after(m, j)));
      fan.before(m, j) += half;
      fan.after(m, j) += half;
    }
  }
  std::vector<PlanarIss> patches;
  for (int m = 0; m < sides; ++m) {
    PlanarIss s{n,
                {domain.centre, domain.corner(m), domain.corner((m + 1) % sides)},
                weights[static_cast<std::size_t>(m)]};
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n - i; ++j) {
        const double w = s.weights[static_cast<std::size_t>(triangle_index(n, i, j))];
        if (w > 0.0) continue;
        throw std::invalid_argument(fmt::format("smoothing makes weight {} of patch {} {:.6g}, not positive",
                                                triangle_key_name(n, i, j), m, w));
      }
    }
    patches.push_back(std::move(s));
  }
  return patches;
}

}  // namespace rondure
