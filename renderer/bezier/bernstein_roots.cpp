#include "renderer/bezier/bernstein_roots.h"

#include <algorithm>

#include "renderer/bezier/curve.h"

namespace rondure {
namespace {

// Halves are told apart to this part of [0, 1]; what noise leaves undecided then is one root.
constexpr int most_halvings = 40;
// What noise hides so near an end is told with it.
constexpr double at_end = 0x1p-24;

struct RootInterval {
  double c[max_degree + 1];
  double low, width;
  int depth;
};

// Of the coefficients: how many are above and below the noise, and how often those change sign.
struct Signs {
  int above = 0, below = 0, changes = 0;
};

Signs signs_of(const double* c, int n, double noise) {
  Signs s;
  int previous = 0;
  for (int k = 0; k <= n; ++k) {
    const int sign = c[k] > noise ? 1 : c[k] < -noise ? -1 : 0;
    s.above += sign > 0, s.below += sign < 0;
    if (sign == 0) continue;
    s.changes += previous != 0 && sign != previous;
    previous = sign;
  }
  return s;
}

// Noise stands between the signs alone, so that whatever it hides there is one change.
bool noise_between(const double* c, int n, double noise) {
  int previous = 0, gap = 0;
  for (int k = 0; k <= n; ++k) {
    const int sign = c[k] > noise ? 1 : c[k] < -noise ? -1 : 0;
    if (sign == 0) {
      if (previous == 0) return false;
      ++gap;
      continue;
    }
    if (gap > 0 && sign == previous) return false;
    gap = 0;
    previous = sign;
  }
  return gap == 0;
}

// Of a polynomial that noise hides at one end alone, all else being beyond it: how far from there at most. It
// is above the lower hull of its coefficients, whose first edge is the least steep of those from the end.
double hidden_at_end(const double* c, int n, double noise, bool high) {
  const double end = std::fabs(c[high ? n : 0]);
  double slope = INFINITY;
  for (int k = 1; k <= n; ++k) slope = std::min(slope, n * (std::fabs(c[high ? n - k : k]) - end) / k);
  return 2.0 * noise / slope;
}

}  // namespace

void isolate_roots(int n, const double* scaled, double noise, BernsteinRoots& out) noexcept {
  RootInterval stack[most_halvings + 2];
  int top = 0;
  RootInterval& whole = stack[top++];
  for (int k = 0; k <= n; ++k) whole.c[k] = scaled[k] / binomial(n, k);
  whole.low = 0.0, whole.width = 1.0, whole.depth = 0;
  // A root between two pieces is found in both, and a doubtful one in several: one is enough.
  const auto propose = [&](double t, bool simple, double width) {
    if (out.count > 0) {
      const BernsteinRoot& last = out.items[static_cast<std::size_t>(out.count - 1)];
      if (!simple && std::fabs(t - last.t) <= 0x1p-36) return;
    }
    out.add({t, simple, width});
  };
  while (top > 0) {
    const RootInterval piece = stack[--top];
    const Signs s = signs_of(piece.c, n, noise);
    if (s.above == n + 1 || s.below == n + 1) continue;
    // One end may be zero, and nothing beyond it: but not where the polynomial is so flat there that the
    // noise hides another root.
    const bool alone = s.above + s.below == n && (s.above == 0 || s.below == 0);
    const bool low = std::fabs(piece.c[0]) <= noise, high = std::fabs(piece.c[n]) <= noise;
    if (alone && (low || high)) {
      const double hidden = piece.width * hidden_at_end(piece.c, n, noise, high);
      if (hidden <= at_end) {
        propose(piece.low + (high ? piece.width : 0.0), false, hidden);
        continue;
      }
    }
    if (s.changes == 1 && noise_between(piece.c, n, noise)) {
      double c[max_degree + 1];
      for (int k = 0; k <= n; ++k) c[k] = binomial(n, k) * piece.c[k];
      propose(piece.low + piece.width * detail::simple_root<dynamic>(n, c), true, 0.0);
      continue;
    }
    if (piece.depth == most_halvings || (s.above == 0 && s.below == 0)) {
      propose(piece.low + 0.5 * piece.width, false, 0.5 * piece.width);
      continue;
    }
    RootInterval &upper = stack[top], &lower = stack[top + 1];
    curve_halve(piece.c, n, 1, lower.c, upper.c);
    lower.width = upper.width = 0.5 * piece.width;
    lower.low = piece.low, upper.low = piece.low + lower.width;
    lower.depth = upper.depth = piece.depth + 1;
    top += 2;
  }
}

}  // namespace rondure
