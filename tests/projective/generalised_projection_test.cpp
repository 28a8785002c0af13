// The lemmas of Dietz, Hoschek and Juettler (1993, section 3). Small integers make every test exact.
#include "renderer/projective/generalised_projection.h"

#include <glm/matrix.hpp>

#include "renderer/projective/quadric.h"
#include "tests/catch.h"
#include "tests/projective/integer_points.h"

namespace rondure {
namespace {

constexpr int rounds = 200;

// Counts what is false, so that a test asserts once.
struct ProjectionTally {
  int checks = 0, wrong = 0;
  void operator()(bool right) { ++checks, wrong += !right; }
};

long double determinant(const lvec4& a, const lvec4& b, const lvec4& c, const lvec4& d) {
  return glm::determinant(lmat4(a, b, c, d));
}

// Of three vectors that span less than three dimensions every 3 x 3 minor vanishes.
bool coplanar(const lvec4& a, const lvec4& b, const lvec4& c) {
  for (int k = 0; k < 4; ++k) {
    lvec4 unit(0);
    unit[k] = 1;
    if (determinant(a, b, c, unit) != 0) return false;
  }
  return true;
}

bool parallel(const lvec4& a, const lvec4& b) {
  for (const long double g : pluecker(a, b)) {
    if (g != 0) return false;
  }
  return true;
}

long double on_sphere(const lvec4& x) { return x.x * x.x + x.y * x.y + x.z * x.z - x.w * x.w; }

// The point of the line through p and q that lies on the plane.
lvec4 meet_line(const lvec4& p, const lvec4& q, const lvec4& plane) {
  return glm::dot(plane, q) * p - glm::dot(plane, p) * q;
}

}  // namespace

TEST_CASE("delta is sigma after theta, onto the sphere", "[projective]") {
  IntegerPoints make(1);
  ProjectionTally right;
  for (int k = 0; k < rounds; ++k) {
    const lvec4 p = make.point();
    right(on_sphere(delta(p)) == 0);
    right(delta(p).w > 0);
    // Proposition 3.1, common factors kept.
    right(sigma(theta(p)) == (p[0] * p[0] + p[3] * p[3]) * delta(p));
    const lvec4 plane(p[0], p[1], p[2], 0);
    right(delta(plane) == sigma(plane));
    right(sigma_inverse(sigma(plane)) == 2 * p[0] * plane);
    const lvec4 q = make.point();
    right(delta(p + q) == delta(p) + delta(q) + 2.0L * delta(p, q));
  }
  CHECK(right.wrong == 0);
  CHECK(right.checks == 6 * rounds);
}

TEST_CASE("the preimages of a point are one line (lemma 3.2)", "[projective]") {
  IntegerPoints make(2);
  ProjectionTally right;
  int apart = 0;
  for (int k = 0; k < rounds; ++k) {
    const lvec4 p = make.point(), q = make.point();
    const long double s = make.number(9), t = make.number(9);
    right(delta(s * p + t * perp(p)) == (s * s + t * t) * delta(p));
    const lvec4 planar(p[0], p[1], p[2], 0);
    right(perp(planar) == lvec4(0, p[2], -p[1], p[0]));
    const lvec4 basis[] = {p, perp(p), bar(p), perp(bar(p))};
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < a; ++b) right(glm::dot(basis[a], basis[b]) == 0);
    }
    // w w' - x x' - y y' - z z' is zero where the images are one; that is a sum of squares, which vanishes
    // on the line of p and perp(p) only.
    const lvec4 x = delta(p), y = delta(q);
    const long double apartness = 2 * x.w * y.w - glm::dot(x, y) - x.w * y.w;
    const long double one = glm::dot(bar(p), q), two = glm::dot(perp(bar(p)), q);
    right(x.w * y.w - (glm::dot(x, y) - x.w * y.w) == 2 * (one * one + two * two));
    apart += apartness != 0;
  }
  CHECK(right.wrong == 0);
  CHECK(apart > rounds / 2);
}

TEST_CASE("projecting lines lie in two linear complexes (theorem 3.3)", "[projective]") {
  IntegerPoints make(3);
  ProjectionTally right;
  int others = 0;
  for (int k = 0; k < rounds; ++k) {
    const lvec4 p = make.point(), q = make.point();
    const auto g = pluecker(p, perp(p));
    right(g[0] == g[3]);
    right(g[1] == g[4]);
    const auto h = pluecker(p, q);
    right(h[0] * h[3] + h[1] * h[4] + h[2] * h[5] == 0);  // equation (5)
    const bool projecting = parallel(delta(p), delta(q));
    right(projecting == (h[0] == h[3] && h[1] == h[4]) || parallel(p, q));
    others += !projecting;
  }
  CHECK(right.wrong == 0);
  CHECK(others > rounds / 2);
}

TEST_CASE("circles have ruled preimages (lemma 3.4, equation 27)", "[projective]") {
  IntegerPoints make(4);
  ProjectionTally right;
  // From (p0, p1, p2, p3) to (p1, p2, p3, p0), the coordinates of a space with p0 for its weight.
  const auto weight_last = [](const lmat4& m) {
    lmat4 out;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) out[i][j] = m[(i + 1) % 4][(j + 1) % 4];
    }
    return out;
  };
  const auto kind_of = [&](const lmat4& m) {
    const auto found = classify(weight_last(m));
    return std::get<Quadric>(found).kind;
  };
  for (int k = 0; k < rounds; ++k) {
    // The circle about (a, b) of radius r in the plane p3 = 0, and its image's plane.
    const long double a = make.number(9), b = make.number(9), r = make.number(4) + 5;
    const long double c = a * a + b * b - r * r;
    const lmat4 found = preimage_of_plane({-a, -b, (1 - c) / 2, (1 + c) / 2});
    const lmat4 expected = {{c, -a, -b, 0}, {-a, 1, 0, -b}, {-b, 0, 1, a}, {0, -b, a, c}};
    right(found == expected);
    right(glm::determinant(found) == r * r * r * r);
    right(kind_of(found) == QuadricKind::one_sheet);
    // The line a x + b y = d.
    const long double d = make.number(9);
    if (a == 0 && b == 0) continue;
    right(kind_of(preimage_of_plane({a, b, d, -d})) == QuadricKind::hyperbolic_paraboloid);
  }
  CHECK(right.wrong == 0);
}

TEST_CASE("lines go to circles (lemma 3.5)", "[projective]") {
  IntegerPoints make(5);
  ProjectionTally right;
  int circles = 0, lines = 0;
  for (int k = 0; k < rounds; ++k) {
    const lvec4 p = make.point();
    lvec4 q = make.point();
    if (k % 2 == 0) q[3] = p[3], q[0] = p[0];  // parallel to the plane p3 = 0
    const bool one_point = parallel(delta(p), delta(q));
    if (one_point) continue;
    // Control points of the conic in the plane: collinear, (their determinant vanishes) or not.
    const auto planar = [](const lvec4& x, const lvec4& y) {  // polar form of theta
      return lvec4(2 * (x[0] * y[0] + x[3] * y[3]), x[0] * y[1] + y[0] * x[1] - x[2] * y[3] - y[2] * x[3],
                   x[1] * y[3] + y[1] * x[3] + x[0] * y[2] + y[0] * x[2], 0);
    };
    right(planar(p, p) == 2.0L * theta(p));
    const bool straight = coplanar(planar(p, p), planar(p, q), planar(q, q));
    const bool meets_at_infinity = p[0] * q[3] == p[3] * q[0];
    right(straight == meets_at_infinity);
    // On the sphere three control points of a curve that is no point span a plane: a circle.
    right(!coplanar(delta(p), delta(p, q), delta(q)));
    circles += !straight, lines += straight;
  }
  CHECK(right.wrong == 0);
  CHECK(circles > rounds / 4);
  CHECK(lines > rounds / 4);
}

TEST_CASE("the lines of a plane go to the circles through a point (lemma 3.6)", "[projective]") {
  IntegerPoints make(6);
  ProjectionTally right;
  for (int k = 0; k < rounds; ++k) {
    const lvec4 plane = make.point();
    // Its projecting line. Every other one meets it in a point only (lemma 3.7).
    const lvec4 own = bar(plane);
    right(glm::dot(plane, own) == 0 && glm::dot(plane, perp(own)) == 0);
    // Three points of the plane.
    const auto in_plane = [&] { return meet_line(make.point(3), make.point(3), plane); };
    const lvec4 a = in_plane(), b = in_plane(), c = in_plane();
    if (coplanar(a, b, c)) continue;
    // The circles of ab and ac lie in planes that contain delta(own).
    right(determinant(delta(a), delta(a, b), delta(b), delta(own)) == 0);
    right(determinant(delta(a), delta(a, c), delta(c), delta(own)) == 0);
    // When they meet on the projecting line, the tangents there are one line.
    right(coplanar(delta(own), delta(own, b), delta(own, c)));
    right(!coplanar(delta(a), delta(a, b), delta(a, c)) || parallel(delta(a), delta(own)));
  }
  CHECK(right.wrong == 0);
  CHECK(right.checks > 4 * rounds);
}

TEST_CASE("planes meet projecting lines and are spanned by them (lemmas 3.7 and 3.8)", "[projective]") {
  IntegerPoints make(7);
  ProjectionTally right;
  for (int k = 0; k < rounds; ++k) {
    const lvec4 p = make.point(), plane = make.point(), r = make.point();
    const lvec4 meet = meet_plane(p, plane);
    right(glm::dot(plane, meet) == 0);
    const bool contained = glm::dot(plane, p) == 0 && glm::dot(plane, perp(p)) == 0;
    right((meet == lvec4(0)) == contained);
    if (!contained) right(parallel(delta(meet), delta(p)));
    const lvec4 through = plane_through(p, r);
    right(glm::dot(through, p) == 0 && glm::dot(through, r) == 0 && glm::dot(through, perp(r)) == 0);
    right((through == lvec4(0)) == parallel(delta(p), delta(r)));
  }
  CHECK(right.wrong == 0);
}

TEST_CASE("three points have the circle of the reference (lemma 3.7)", "[projective]") {
  // Preimages of (0, 0, -1), (1, 2, -2) / 3 and (6, 2, 3) / 7.
  const lvec4 p(2, 0, 0, 0), r(5, 1, 2, 0), q(4, 6, 2, 0);
  const lvec4 b0 = meet_plane(p, bar(r)), b1 = meet_plane(q, bar(r));
  CHECK(b0 == lvec4(4, 0, 0, 8));
  CHECK(b1 == lvec4(-104, -160, -40, -8));
  CHECK(delta(b0) == lvec4(0, 0, -80, 80));
  CHECK(delta(b0, b1) == lvec4(-320, -1440, 480, -480));
  CHECK(delta(b1) == lvec4(32640, 10880, 16320, 38080));
}

}  // namespace rondure
