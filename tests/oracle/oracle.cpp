#include "tests/oracle/oracle.h"

#include <algorithm>
#include <cmath>

#include "tests/oracle/exact_net.h"
#include "tests/oracle/turning.h"

namespace rondure::oracle {
namespace {

constexpr std::size_t piece_limit = 1 << 13;
constexpr int depth_limit = 1000;  // 10^-39 of a net takes some 400

// A 2x2 matrix times the pair.
struct Matrix {
  Real aa, ab, ba, bb;
  Real2 operator*(const Real2& f) const { return {aa * f[0] + ab * f[1], ba * f[0] + bb * f[1]}; }
};

struct Piece {
  PolynomialPair f;
  Real2 origin, along_a, along_b;  // (u, v) = origin + a along_a + b along_b
  Real2 place(const Real& a, const Real& b) const { return origin + a * along_a + b * along_b; }
};

// All that a polynomial may be on its piece, by its coefficients.
struct Span {
  Real low, high;

  Span(const Real& a, const Real& b) : low(a), high(b) {}
  Span(const PolynomialPair& f, std::size_t which) : low(f.c[0][which]), high(low) {
    for (const Real2& x : f.c) low = std::min(low, x[which]), high = std::max(high, x[which]);
  }
  // By more than 10^-30 of itself, where rounding is 10^-48.
  bool keeps_sign() const { return low > ldexp(high, -100) || high < ldexp(low, -100); }

  friend Span operator+(const Span& a, const Span& b) { return {a.low + b.low, a.high + b.high}; }
  friend Span operator-(const Span& a, const Span& b) { return {a.low - b.high, a.high - b.low}; }
  friend Span operator*(const Span& a, const Span& b) {
    const Real p[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
    return {*std::min_element(p, p + 4), *std::max_element(p, p + 4)};
  }
};

class Search {
 public:
  Search(const Net& net, int patch, const Line& line, double graze, double margin, Meeting& out)
      : net_(net), patch_(patch), line_(line), out_(out) {
    Piece whole;
    whole.f.degrees = net_.xy.degrees;
    Real weight = 0, position = 0;
    const Real offset[2] = {dot(line.normal[0], line.origin), dot(line.normal[1], line.origin)};
    for (std::size_t k = 0; k < net_.xy.c.size(); ++k) {
      const Real3 p{net_.xy.c[k][0], net_.xy.c[k][1], net_.zw.c[k][0]};
      const Real w = net_.zw.c[k][1];
      whole.f.c.push_back({dot(line.normal[0], p) - offset[0] * w, dot(line.normal[1], p) - offset[1] * w});
      weight = std::max(weight, Real(abs(w)));
      for (const Real& x : p) position = std::max(position, Real(abs(x)));
    }
    const Real origin = sqrt(dot(line.origin, line.origin));
    // 169 bits, ten operations for a coefficient and, at 400 halvings of degree 9, 3600 more.
    rounding_ = ldexp(position + origin * weight, -150);
    point_ = ldexp(position, -130);
    graze_ = Real(graze) * position;
    const Real by = margin;
    whole.f = whole.f.enlarged(by);
    const Real wide = 1 + (triangle() ? 3 : 2) * by;
    whole.origin = {-by, -by}, whole.along_a = {wide, 0}, whole.along_b = {0, wide};
    divide(whole, false);
  }

 private:
  const ExactNet net_;
  const int patch_;
  const Line& line_;
  Meeting& out_;
  Real rounding_, point_, graze_;
  std::vector<Real2> roots_;  // parameters of simple ones

  bool triangle() const { return net_.xy.degrees.triangle; }

  // Whether `by` . f keeps one sign, by more than `rounding`, in one of its components.
  static bool keeps_sign(const PolynomialPair& f, const Matrix& by, const Real2& rounding) {
    bool above[2] = {true, true}, below[2] = {true, true};
    for (const Real2& c : f.c) {
      const Real2 g = by * c;
      for (std::size_t k = 0; k < 2; ++k) {
        above[k] = above[k] && g[k] > rounding[k];
        below[k] = below[k] && g[k] < -rounding[k];
      }
      if (!above[0] && !above[1] && !below[0] && !below[1]) return false;
    }
    return true;
  }

  // `asked`: whether grazes were looked for in a piece that contains this one. `depth`: halvings so far; a
  // ray inside a flat patch has a root everywhere, and no end of them.
  void divide(const Piece& piece, bool asked, int depth = 0) {
    if (++out_.pieces > piece_limit || depth > depth_limit) out_.exhausted = true;
    if (out_.exhausted) return;
    const Real wide = std::max(size_of(piece.along_a), size_of(piece.along_b));
    Real largest = 0;
    for (const Real2& c : piece.f.c) largest = std::max(largest, size_of(c));
    // Nothing at this size is a graze's side any more.
    const bool small = wide < 0x1p-26 || largest < 4 * graze_;
    const Real still = asked ? rounding_ : std::max(rounding_, graze_);
    if (keeps_sign(piece.f, {1, 0, 0, 1}, {still, still})) return;

    const Real middle = triangle() ? Real(1) / 3 : Real(0.5);
    const Real2 da = piece.f.derivative(0)(middle, middle), db = piece.f.derivative(1)(middle, middle);
    const Real det = da[0] * db[1] - da[1] * db[0];
    if (det != 0) {
      const Matrix inverse{db[1] / det, -db[0] / det, -da[1] / det, da[0] / det};
      const Real2 band{still * (abs(inverse.aa) + abs(inverse.ab)),
                       still * (abs(inverse.ba) + abs(inverse.bb))};
      if (keeps_sign(piece.f, inverse, band)) return;
      if (contracts(piece.f, inverse) && solve(piece, inverse)) return;
    }
    if (small && !asked) look_for_graze(piece, {middle, middle});
    if (largest < point_) return keep_cluster(piece);

    int edge = 0;
    Real most = -1;
    for (int k = 0; k < piece.f.degrees.edges(); ++k)
      if (const Real change = piece.f.change(k); change > most) most = change, edge = k;
    const auto halves = piece.f.halves(edge);
    for (int k = 0; k < 2; ++k)
      divide(half(piece, halves[static_cast<std::size_t>(k)], edge, k), asked || small, depth + 1);
  }

  // `second`: the half at the edge's end.
  static Piece half(const Piece& p, const PolynomialPair& f, int edge, int second) {
    const Real h = 0.5;
    Piece out{f, p.origin, p.along_a, p.along_b};
    if (!f.degrees.triangle) {
      Real2& along = edge == 0 ? out.along_a : out.along_b;
      along = h * along;
      if (second == 1) out.origin = out.origin + along;
      return out;
    }
    // Corners at the ends of the edges: a = 1, b = 1, the origin.
    std::array<Real2, 3> corner{p.origin + p.along_a, p.origin + p.along_b, p.origin};
    const auto from = static_cast<std::size_t>(edge), to = static_cast<std::size_t>((edge + 1) % 3);
    corner[second == 1 ? from : to] = h * (corner[from] + corner[to]);
    out.origin = corner[2], out.along_a = corner[0] - corner[2], out.along_b = corner[1] - corner[2];
    return out;
  }

  // Whether |inverse . Jacobian - 1| < 1/2, in the maximum norm, all over the piece.
  static bool contracts(const PolynomialPair& f, const Matrix& inverse) {
    Real2 row{0, 0};
    for (int k = 0; k < 2; ++k) {
      Real2 most{0, 0};
      for (const Real2& c : f.derivative(k).c) {
        const Real2 d = inverse * c - Real2{k == 0 ? 1 : 0, k == 1 ? 1 : 0};
        for (std::size_t j = 0; j < 2; ++j) most[j] = std::max(most[j], Real(abs(d[j])));
      }
      row = row + most;
    }
    return size_of(row) < 0.49;
  }

  // The one root that the piece, enlarged, may have. False when that is not proven.
  bool solve(const Piece& piece, const Matrix& inverse) {
    // From the middle, steps p - inverse f stay within half of its distance, at most 1/2 or 2/3, of a root.
    const Real by = triangle() ? Real(2) / 3 : Real(0.25);
    const PolynomialPair wide = piece.f.enlarged(by);
    // Its own parameters are shorter by (1 + 2 by) or (1 + 3 by): so are the derivatives by them longer.
    const Real stretch = 1 / (1 + (triangle() ? 3 : 2) * by);
    if (!contracts(wide,
                   {stretch * inverse.aa, stretch * inverse.ab, stretch * inverse.ba, stretch * inverse.bb}))
      return false;
    const PolynomialPair fa = piece.f.derivative(0), fb = piece.f.derivative(1);
    const Real middle = triangle() ? Real(1) / 3 : Real(0.5);
    Real2 p{middle, middle};
    // Precise enough when the step is of the size that rounding makes.
    const Real enough =
        4 * rounding_ * (abs(inverse.aa) + abs(inverse.ab) + abs(inverse.ba) + abs(inverse.bb));
    for (int k = 0; k < 64; ++k) {
      const Real2 value = piece.f(p[0], p[1]), da = fa(p[0], p[1]), db = fb(p[0], p[1]);
      const Real det = da[0] * db[1] - da[1] * db[0];
      const Real2 step = Matrix{db[1] / det, -db[0] / det, -da[1] / det, da[0] / det} * value;
      p = p - step;
      if (outside(p) > by) return false;  // full steps may stray; then the piece is halved further
      if (size_of(step) > enough) continue;
      // A ball of twice the last (preconditioned) residual holds the root.
      const Real radius = 2 * size_of(inverse * piece.f(p[0], p[1])) + enough;
      if (outside(p) > by - radius) return false;
      if (outside(p) > radius) return true;
      if (keep_simple(piece.place(p[0], p[1]), radius * (size_of(piece.along_a) + size_of(piece.along_b))) <
          1e-3)
        look_for_graze(piece, p);
      return true;
    }
    return false;
  }

  Real outside(const Real2& p) const {
    return triangle() ? std::max({Real(-p[0]), Real(-p[1]), Real(p[0] + p[1] - 1)})
                      : std::max({Real(-p[0]), Real(p[0] - 1), Real(-p[1]), Real(p[1] - 1)});
  }

  Root make_root(const Real2& p) const {
    const ExactNet::Place s = net_.at(p[0], p[1]);
    Root root;
    root.patch = patch_, root.u = rounded(p[0]), root.v = rounded(p[1]), root.outside = rounded(outside(p));
    root.t = rounded(along(s.point));
    for (int k = 0; k < 3; ++k) root.point[k] = rounded(s.point[static_cast<std::size_t>(k)]);
    const Real3 n = cross(s.du, s.dv);
    const Real length = sqrt(dot(n, n)), speed = sqrt(dot(s.du, s.du) * dot(s.dv, s.dv));
    if (length > 0 && length > ldexp(speed, -100))
      root.cosine = rounded(dot(n, line_.direction) / length / sqrt(dot(line_.direction, line_.direction)));
    root.way = root.cosine > 0.0 ? 1 : root.cosine < 0.0 ? -1 : 0;
    root.cosine = std::fabs(root.cosine);
    return root;
  }

  Real along(const Real3& point) const {
    Real3 way;
    for (std::size_t k = 0; k < 3; ++k) way[k] = point[k] - line_.origin[k];
    return dot(way, line_.direction) / dot(line_.direction, line_.direction);
  }

  // On the border of two pieces a root is found from both. Its cosine.
  double keep_simple(const Real2& p, const Real& radius) {
    for (const Real2& other : roots_)
      if (size_of(p - other) <= 2 * radius + Real(1e-40)) return 1.0;
    roots_.push_back(p);
    Root root = make_root(p);
    root.multiplicity = 1;
    out_.roots.push_back(root);
    return root.cosine;
  }

  void keep_cluster(const Piece& piece) {
    const Real middle = triangle() ? Real(1) / 3 : Real(0.5);
    Root root = make_root(piece.place(middle, middle));
    // The next pieces of the same cluster: one root. At a collapsed edge they spread along it.
    for (const Root& other : out_.roots)
      if (other.patch == patch_ && other.multiplicity != 1 && other.t == root.t) return;
    root.multiplicity = turns_once(piece) ? 2 : 0;
    root.certified = root.multiplicity == 2;
    out_.roots.push_back(root);
  }

  // Whether there are two roots at most on the piece, or none and all but two: on the zeros of one
  // combination f, which are graphs because a derivative keeps its sign, the other is bent one way only,
  // because the rate at which J changes along them (turning.h) keeps its sign. (Were they in several arcs,
  // each would have two; so small is the piece that this is only where all derivatives vanish.)
  bool turns_once(const Piece& piece) const {
    const Real middle = triangle() ? Real(1) / 3 : Real(0.5);
    Real2 p{middle, middle};
    Jet s = jet(piece.f, middle, middle);
    if (find_turn(piece, p)) s = jet(piece.f, p[0], p[1]);
    const Real angle = rotation(s), c = cos(angle), d = sin(angle);
    PolynomialPair f = piece.f;
    for (Real2& x : f.c) x = {c * x[0] + d * x[1], c * x[1] - d * x[0]};
    const PolynomialPair da = f.derivative(0), db = f.derivative(1), daa = da.derivative(0),
                         dab = da.derivative(1), dbb = db.derivative(1);
    const Span fa(da, 0), fb(db, 0), ga(da, 1), gb(db, 1);
    if (!fa.keeps_sign() && !fb.keeps_sign()) return false;
    const Span faa(daa, 0), fab(dab, 0), fbb(dbb, 0), gaa(daa, 1), gab(dab, 1), gbb(dbb, 1);
    const Span ja = faa * gb + fa * gab - fab * ga - fb * gaa, jb = fab * gb + fa * gbb - fbb * ga - fb * gab;
    return (fb * ja - fa * jb).keeps_sign();
  }

  // Newton's method for the place where f, of the gradient that there is, vanishes and the other turns.
  static bool find_turn(const Piece& piece, Real2& p) {
    for (int k = 0; k < 8; ++k) {
      Jet s = jet(piece.f, p[0], p[1]);
      rotate(s);
      const Real j = s.da[0] * s.db[1] - s.db[0] * s.da[1];
      const Real ja = s.daa[0] * s.db[1] + s.da[0] * s.dab[1] - s.dab[0] * s.da[1] - s.db[0] * s.daa[1],
                 jb = s.dab[0] * s.db[1] + s.da[0] * s.dbb[1] - s.dbb[0] * s.da[1] - s.db[0] * s.dab[1];
      const Real d = s.da[0] * jb - s.db[0] * ja;
      if (d == 0) return false;
      const Real2 step{(jb * s.value[0] - s.db[0] * j) / d, (s.da[0] * j - ja * s.value[0]) / d};
      p = p - step;
      if (size_of(p) > 1000) return false;
      if (size_of(step) < 1e-20) break;
    }
    return true;
  }

  void look_for_graze(const Piece& piece, Real2 p) {
    if (!find_turn(piece, p)) return;
    Jet s = jet(piece.f, p[0], p[1]);
    rotate(s);
    const Real2 at = piece.place(p[0], p[1]);
    if (outside(at) > 1e-6) return;
    const ExactNet::Place place = net_.at(at[0], at[1]);
    const Real3 n = cross(place.du, place.dv);
    if (dot(n, n) < 1e-12 * dot(place.du, place.du) * dot(place.dv, place.dv)) return;
    Graze g;
    g.patch = patch_, g.t = rounded(along(place.point)), g.outside = rounded(outside(at));
    g.depth = rounded(abs(s.value[1]) / abs(net_.zw(at[0], at[1])[1]));
    for (const Graze& other : out_.grazes)
      if (other.patch == patch_ && std::fabs(other.t - g.t) <= 1e-12 * std::fabs(g.t) &&
          std::fabs(other.depth - g.depth) <= 1e-3 * g.depth)
        return;
    out_.grazes.push_back(g);
  }
};

// Whether the control points are on either side of both planes, as doubles see it, or within 10^4 times what
// rounding and the patch's extension make of them: most patches need no more.
bool may_meet(const Net& net, const Line& line) {
  for (const Real3& normal : line.normal) {
    double n[3], most = 0.0;
    for (std::size_t k = 0; k < 3; ++k) n[k] = rounded(normal[k]);
    const double offset = rounded(dot(normal, line.origin));
    bool above = true, below = true;
    for (const dvec4& p : points_of(net))
      most = std::max({most, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z), std::fabs(offset * p.w)});
    for (const dvec4& p : points_of(net)) {
      const double f = n[0] * p.x + n[1] * p.y + n[2] * p.z - offset * p.w;
      above = above && f > 1e-7 * most, below = below && f < -1e-7 * most;
    }
    if (above || below) return false;
  }
  return true;
}

}  // namespace

Meeting meet(const Surface& surface, const Ray& ray, double graze, double margin) {
  Meeting out;
  const Line line = line_of(ray, surface.origin);
  for (std::size_t k = 0; k < surface.patches.size(); ++k)
    if (may_meet(surface.patches[k], line))
      Search(surface.patches[k], static_cast<int>(k), line, graze, margin, out);
  std::stable_sort(out.roots.begin(), out.roots.end(),
                   [](const Root& a, const Root& b) { return a.t < b.t; });
  return out;
}

}  // namespace rondure::oracle
