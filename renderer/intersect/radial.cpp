#include "renderer/intersect/radial.h"

#include <algorithm>
#include <array>
#include <glm/matrix.hpp>

#include "renderer/bezier/bernstein_roots.h"
#include "renderer/bezier/dispatch.h"
#include "renderer/bezier/product.h"
#include "renderer/bezier/quotient.h"
#include "renderer/bezier/triangle.h"
#include "renderer/intersect/cell.h"
#include "renderer/intersect/projected_net.h"
#include "renderer/intersect/settle.h"

namespace rondure {
namespace {

// Roundoffs by which control vectors may miss their even places.
constexpr double even = 8.0;
// With a larger error of the polynomial its roots lead Newton's method nowhere: slivers, and moduli far
// apart.
constexpr double noisiest = 1e-9;
// Newton's method squares a step below this.
constexpr double close = 1e-8;
// Below this sine it is rounding that tells in which way the ray crosses.
constexpr double blurred = 1e-6;
// A stretch of the ray of this part of the piece, all zeros: it has no isolated root.
constexpr double in_surface = 1e-3;

// A part of the ray, between two values of its parameter.
struct Stretch {
  double from = -INFINITY, to = INFINITY;

  // Keeps where at + s slope >= 0.
  void clip(double at, double slope) {
    if (slope > 0.0)
      from = std::max(from, -at / slope);
    else if (slope < 0.0)
      to = std::min(to, -at / slope);
    else if (at < 0.0)
      to = -INFINITY;
  }
};

// product *= a + b x, of the coefficients of powers of x (a Bernstein polynomial's, scaled); degree n before.
inline void times_linear(double* product, int n, double a, double b) {
  product[n + 1] = b * product[n];
  for (int k = n; k > 0; --k) product[k] = a * product[k] + b * product[k - 1];
  product[0] *= a;
}

// W(b) - h^(n-1) along the stretch from b = c0 to c1, scaled coefficients.
template <int N>
void polynomial(const RadialPiece& piece, const dvec3& c0, const dvec3& c1, double* out) {
  const int n = N >= 0 ? N : piece.n;
  constexpr int length = (N >= 0 ? N : max_degree) + 1;
  double third[length][length];  // powers of b_3
  third[0][0] = 1.0;
  for (int k = 1; k <= n; ++k) {
    for (int m = 0; m < k; ++m) third[k][m] = third[k - 1][m];
    times_linear(third[k], k - 1, c0.z, c1.z);
  }
  // Horner's scheme in b_1, and in b_2 for each of its coefficients.
  const double* weights = piece.weights.data();
  out[0] = weights[triangle_index(n, n, 0)];
  for (int i = n - 1; i >= 0; --i) {
    const int d = n - i;
    double inner[length];
    inner[0] = weights[triangle_index(n, i, d)];
    for (int k = 1; k <= d; ++k) {
      times_linear(inner, k - 1, c0.y, c1.y);
      const double a = weights[triangle_index(n, i, d - k)];
      for (int m = 0; m <= k; ++m) inner[m] += a * third[k][m];
    }
    times_linear(out, d - 1, c0.x, c1.x);
    for (int m = 0; m <= d; ++m) out[m] += inner[m];
  }
  double power[length + 1];
  power[0] = 1.0;
  const double h0 = c0.x + c0.y + c0.z, h1 = c1.x + c1.y + c1.z;
  for (int k = 1; k < n; ++k) times_linear(power, k - 1, h0, h1);
  times_linear(power, n - 1, 1.0, 1.0);
  for (int k = 0; k <= n; ++k) out[k] -= power[k];
}

double power_of(double x, int n) {
  double p = 1.0;
  for (int k = 0; k < n; ++k) p *= x;
  return p;
}

// Newton's method on the net itself, from parameters that the polynomial gave; near a double root it takes
// many steps. The sine between the projected derivatives at the end: how far the ray is from touching the
// patch. Negative where the method does not settle: the ray touches the patch there, if it meets it.
template <int N>
double polish(const TriangleNet& net, const LocalRay& ray, dvec2& at, int steps, double enough) {
  dvec2 p = at;
  double moved = INFINITY, sine = 0.0;
  for (int k = 0; k < steps && !(moved < enough); ++k) {
    const FirstOrder<dvec4> s = triangle_first<N>(net.points.data(), net.n, p.x, p.y);
    const dvec2 f = project(ray, s.value), fu = project(ray, s.du), fv = project(ray, s.dv);
    const double det = fu.x * fv.y - fu.y * fv.x, r = quotient(1.0, det);
    const dvec2 step(r * (fv.y * f.x - fv.x * f.y), r * (fu.x * f.y - fu.y * f.x));
    p -= step;
    moved = std::max(std::fabs(step.x), std::fabs(step.y));
    if (!(moved < 1e-3)) return -1.0;
    sine = std::fabs(det) / (glm::length(fu) * glm::length(fv));
  }
  at = p;
  return moved < close ? sine : -1.0;
}

// Whether the ray runs inside the surface: its polynomial is zero all along the part, or along a longer one
// about the middle of a part that is very short.
template <int N>
bool lies_in(const RadialPiece& piece, const dvec3& base, const dvec3& slope, const Stretch& part,
             double noise, const LocalRay& ray) {
  const int n = N >= 0 ? N : piece.n;
  const double half =
                   std::max(0.5 * (part.to - part.from), in_surface * piece.extent / std::sqrt(ray.length2)),
               middle = 0.5 * (part.from + part.to);
  double f[(N >= 0 ? N : max_degree) + 1];
  polynomial<N>(piece, base + (middle - half) * slope, base + (middle + half) * slope, f);
  for (int k = 0; k <= n; ++k)
    if (!(std::fabs(f[k]) <= 2.0 * noise * binomial(n, k))) return false;
  return true;
}

template <int N>
void solve(const RadialPiece& piece, const Leaf& leaf, const TriangleNet& net, const LocalRay& ray,
           std::vector<Root>& roots) noexcept {
  const int n = N >= 0 ? N : piece.n;
  const dvec3 base(glm::dot(piece.rows[0], ray.base), glm::dot(piece.rows[1], ray.base),
                   glm::dot(piece.rows[2], ray.base));
  const dvec3 slope(glm::dot(piece.rows[0], ray.direction), glm::dot(piece.rows[1], ray.direction),
                    glm::dot(piece.rows[2], ray.direction));
  Stretch part;
  for (int k = 0; k < 3; ++k) part.clip(base[k] + piece.rounding[k], slope[k]);
  const double h = base.x + base.y + base.z, h_slope = slope.x + slope.y + slope.z;
  part.clip(h - piece.low, h_slope);
  part.clip(piece.high - h, -h_slope);
  if (!(part.from <= part.to)) return;

  const dvec3 c0 = base + part.from * slope, c1 = base + part.to * slope;
  double f[(N >= 0 ? N : max_degree) + 1];
  polynomial<N>(piece, c0, c1, f);
  const double top = std::max(c0.x + c0.y + c0.z, c1.x + c1.y + c1.z);
  const double noise = piece.roundoffs * power_of(top, n - 1);
  BernsteinRoots found;
  bernstein_roots<N>(n, f, noise, found);
  if (found.count == 0 || (!found.items[0].simple && lies_in<N>(piece, base, slope, part, noise, ray)))
    return;

  const std::size_t known = roots.size();
  const auto add = [&](Root root) {
    for (std::size_t k = known; k < roots.size(); ++k)
      if (std::max(std::fabs(roots[k].u - root.u), std::fabs(roots[k].v - root.v)) < 1e-12) return;
    if (settle(net, leaf.scale, ray, root)) roots.push_back(root);
  };
  const auto parameters = [&](double t) {
    const dvec3 b = c0 + t * (c1 - c0);
    return leaf.to_patch(dvec2(b) / (b.x + b.y + b.z));
  };
  for (const BernsteinRoot& root : found) {
    if (root.simple) {
      dvec2 at = parameters(root.t);
      if (polish<N>(net, ray, at, 4, close) >= 0.0) {
        add({at.x, at.y, false});
        continue;
      }
    }
    // Two roots, hidden from each other by the noise, are reached from either side.
    bool reached = false;
    for (const double t : {root.t - root.width, root.t + root.width}) {
      dvec2 at = parameters(t);
      const double sine = polish<N>(net, ray, at, 32, 1e-4 * close);
      if (sine < 0.0) continue;
      add({at.x, at.y, sine < blurred});
      reached = true;
    }
    const dvec2 at = parameters(root.t);
    if (!reached) add({at.x, at.y, true});
  }
}

dvec3 corner(const TriangleNet& net, int k) {
  return dvec3(k == 0 ? net.at(net.n, 0) : k == 1 ? net.at(0, net.n) : net.at(0, 0));
}

double longest_corner(const TriangleNet& net) {
  double longest = 0.0;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, glm::length(corner(net, k)));
  return longest;
}

bool divides_evenly(const TriangleNet& net) {
  const double n = net.n, limit = even * unit_roundoff * longest_corner(net);
  const dvec3 a = corner(net, 0), b = corner(net, 1), c = corner(net, 2);
  for (int i = 0; i <= net.n; ++i) {
    for (int j = 0; j <= net.n - i; ++j) {
      const dvec3 place = (i / n) * a + (j / n) * b + ((net.n - i - j) / n) * c;
      if (!(largest(dvec3(net.at(i, j)) - place) <= limit)) return false;
    }
  }
  return true;
}

dmat3 corners_of(const TriangleNet& net) { return {corner(net, 0), corner(net, 1), corner(net, 2)}; }

// Of a net whose corners are in no plane with the origin.
RadialPiece piece_of(const TriangleNet& net) {
  const int n = net.n;
  RadialPiece piece;
  double least = INFINITY, most = 0.0;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n - i; ++j) {
      const dvec4& p = net.at(i, j);
      least = std::min(least, p.w), most = std::max(most, p.w);
      piece.extent = std::max(piece.extent, glm::length(dvec3(p)) / p.w);
      piece.weights.push_back(trinomial(n, i, j) * p.w);
    }
  }
  piece.n = n;
  piece.rows = glm::transpose(glm::inverse(corners_of(net)));
  // h is 1 / w(tau), and w lies between the coefficients.
  piece.low = (1.0 - 8.0 * unit_roundoff) / most, piece.high = (1.0 + 8.0 * unit_roundoff) / least;
  // A coordinate: `even` roundoffs of the net, as many for the inverse, the ray's base and direction, and the
  // products. At points of the ray no further away than the piece, on which |T| h bounds |p| too.
  double relative = 0.0;
  for (int k = 0; k < 3; ++k) {
    piece.rounding[k] = 4.0 * even * unit_roundoff * glm::length(piece.rows[k]) *
                        (piece.extent + longest_corner(net) * piece.high);
    relative = std::max(relative, piece.rounding[k] / piece.low);
  }
  const double slack = piece.rounding.x + piece.rounding.y + piece.rounding.z;
  piece.low -= slack, piece.high += slack;
  // Sums of some 3 n products of n coordinates each.
  piece.roundoffs = n * (8.0 * unit_roundoff + 3.0 * relative) * (most * piece.high + 1.0);
  return piece;
}

NetScale scale_of(const TriangleNet& net) {
  NetScale scale;
  for (const dvec4& p : net.points) {
    scale.position = std::max(scale.position, largest(dvec3(p)));
    scale.weight = std::max(scale.weight, p.w);
  }
  return scale;
}

// Four parts for each of `depth` steps.
void divide(const TriangleNet& net, const TriangleCell& cell, int depth, int patch, LeafSet& set,
            std::vector<RadialPiece>& pieces) {
  if (depth == 0) {
    Leaf leaf{};
    leaf.patch = patch;
    leaf.corner = cell.corner[2];
    leaf.edge_a = cell.corner[0] - cell.corner[2];
    leaf.edge_b = cell.corner[1] - cell.corner[2];
    leaf.scale = scale_of(net);
    Box box;
    for (const dvec4& p : net.points) box.add(dvec3(p) / p.w);
    set.leaves.push_back(leaf);
    set.boxes.push_back(box);
    pieces.push_back(piece_of(net));
    return;
  }
  std::array<TriangleNet, 4> parts;
  for (TriangleNet& part : parts) part = TriangleNet(net.n);
  triangle_quarter(net.points.data(), net.n, parts[0].points.data(), parts[1].points.data(),
                   parts[2].points.data(), parts[3].points.data());
  const dvec2 a = cell.corner[0], b = cell.corner[1], c = cell.corner[2];
  const dvec2 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ac = 0.5 * (a + c);
  const TriangleCell cells[4] = {{{a, ab, ac}}, {{ab, b, bc}}, {{ac, bc, c}}, {{bc, ac, ab}}};
  for (std::size_t k = 0; k < 4; ++k) divide(parts[k], cells[k], depth - 1, patch, set, pieces);
}

}  // namespace

bool has_radial_form(const Net& any) {
  const auto* net = std::get_if<TriangleNet>(&any);
  if (!net || net->n < 1 || net->n > max_degree) return false;
  for (const dvec4& p : net->points)
    if (!(p.w > 0.0) || !std::isfinite(p.w)) return false;
  if (glm::determinant(corners_of(*net)) == 0.0 || !divides_evenly(*net)) return false;
  const RadialPiece whole = piece_of(*net);
  return whole.low > 0.0 && whole.roundoffs < noisiest;
}

void add_radial_leaves(const Net& net, int patch, int depth, LeafSet& set, std::vector<RadialPiece>& pieces) {
  divide(std::get<TriangleNet>(net), {}, depth, patch, set, pieces);
}

void solve_radial(const RadialPiece& piece, const Leaf& leaf, const Net& net, const LocalRay& ray,
                  std::vector<Root>& roots) noexcept {
  const auto& triangle = std::get<TriangleNet>(net);
  with_degree(piece.n, [&](auto n) { solve<n>(piece, leaf, triangle, ray, roots); });
}

}  // namespace rondure
