// Patches between plane sections of ruled quadrics: theorems 3.9 and 3.10 with ruled_image in delta's place.
#include "renderer/projective/ruled_patch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

// Lines at these angles.
RuledPoint at(long double s, long double t) {
  return {{std::cos(s), std::sin(s)}, {std::cos(t), std::sin(t)}};
}

lvec4 image_of(const RuledPoint& p) { return ruled_point(p.a, p.b); }
lvec4 image_of(const lvec4& p) { return ruled_image(p, p); }

lvec4 plane_of(const lvec4& p, const lvec4& q, const lvec4& r) {
  lvec4 h;
  for (int k = 0; k < 4; ++k) {
    lmat4 m(p, q, r, lvec4(0));
    m[3][k] = 1;
    h[k] = glm::determinant(m);
  }
  return glm::normalize(h);
}

struct Sides {
  RuledQuad quad;
  std::array<RuledPoint, 4> between;  // a point of each arc
};

// Corners near a square in the lines' angles, each side bent by up to `bend`.
Sides random_sides(NetMaker& make, double bend) {
  const long double s0 = make.uniform(0, 3), t0 = make.uniform(0, 3);
  std::array<lvec2, 4> angle;
  const lvec2 square[4] = {{0, 0}, {0.9L, 0}, {0.9L, 0.9L}, {0, 0.9L}};
  for (std::size_t k = 0; k < 4; ++k)
    angle[k] = square[k] + lvec2(s0 + make.uniform(-0.2, 0.2), t0 + make.uniform(-0.2, 0.2));
  Sides sides;
  for (std::size_t k = 0; k < 4; ++k) sides.quad.corner[k] = at(angle[k].x, angle[k].y);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    const lvec2 way = angle[next] - angle[k];
    // Both angles go the same way between the ends as along the chord.
    const lvec2 middle =
        angle[k] + lvec2(0.5L + make.uniform(-bend, bend), 0.5L + make.uniform(-bend, bend)) * way;
    sides.between[k] = at(middle.x, middle.y);
    sides.quad.arc[k] = section_through(sides.quad.corner[k], sides.between[k], sides.quad.corner[next]);
  }
  return sides;
}

// Control points of the image along side k, from its corner to the next.
std::vector<lvec4> side_of(const TensorPreimage& p, std::size_t k) {
  const auto square = multiply(p, p, [](const lvec4& a, const lvec4& b) { return ruled_image(a, b); });
  std::vector<lvec4> side;
  const int m = square.m, n = square.n;
  for (int i = 0; i <= (k % 2 == 0 ? m : n); ++i)
    side.push_back(k == 0   ? square.at(i, 0)
                   : k == 1 ? square.at(m, i)
                   : k == 2 ? square.at(m - i, n)
                            : square.at(0, n - i));
  return side;
}

lvec4 value(std::vector<lvec4> c, long double t) {
  for (; c.size() > 1; c.pop_back()) {
    for (std::size_t k = 0; k + 1 < c.size(); ++k) c[k] = (1 - t) * c[k] + t * c[k + 1];
  }
  return c[0];
}

// 1 minus the cosine between homogeneous points, which may have either sign.
long double apart(const lvec4& p, const lvec4& q) {
  return 1 - std::abs(glm::dot(p, q)) / (glm::length(p) * glm::length(q));
}

void check_sides(const TensorPreimage& p, const Sides& sides, const std::string& name, WorstCase& worst) {
  for (std::size_t k = 0; k < 4; ++k) {
    const auto text = [&] { return fmt::format("{}, side {}", name, k); };
    const std::vector<lvec4> side = side_of(p, k);
    const lvec4 from = image_of(sides.quad.corner[k]), to = image_of(sides.quad.corner[(k + 1) % 4]);
    const lvec4 h = plane_of(from, image_of(sides.between[k]), to);
    for (const lvec4& c : side)
      worst.add(static_cast<double>(std::abs(glm::dot(h, c))),
                1e-15 * static_cast<double>(1 + glm::length(c)), text);
    worst.add(static_cast<double>(apart(side.front(), from)), 1e-17, text);
    worst.add(static_cast<double>(apart(side.back(), to)), 1e-17, text);
    // The arc that was asked for passes its point: the nearest of 1001 is off by less than their distance.
    long double least = 1;
    for (int i = 0; i <= 1000; ++i)
      least = std::min(least, apart(value(side, i / 1000.0L), image_of(sides.between[k])));
    worst.add(static_cast<double>(least), 1e-5, text);
  }
}

}  // namespace

TEST_CASE("points of the ruled quadric are two lines", "[projective]") {
  NetMaker make(81);
  WorstCase worst;
  for (int k = 0; k < 200; ++k) {
    const lvec4 x = image_of(lvec4(make.point(-1.0, 1.0)));
    const RuledPoint p = ruled_preimage(x);
    worst.add(static_cast<double>(apart(image_of(p), x)), 1e-18, [&] { return fmt::format("point {}", k); });
    worst.add(static_cast<double>(apart(image_of(to_preimage(p)), x)), 1e-18,
              [&] { return fmt::format("net {}", k); });
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("any four sections that bound a region have patches of degree (2, 4)", "[projective]") {
  NetMaker make(82);
  WorstCase worst;
  int regular = 0, rounds = 100;
  for (int k = 0; k < rounds; ++k) {
    const Sides sides = random_sides(make, 0.2);
    const lvec2 h = holonomy(sides.quad);
    REQUIRE((h.x > 0 && h.y > 0));
    const TensorPreimage v = linear_quadratic_preimage(sides.quad), u = quadratic_linear_preimage(sides.quad);
    CHECK((v.m == 1 && v.n == 2 && u.m == 2 && u.n == 1));
    check_sides(v, sides, fmt::format("quad {} along v", k), worst);
    check_sides(u, sides, fmt::format("quad {} along u", k), worst);
    // Where it says so the lines' angles turn one way on a grid.
    for (const TensorPreimage& p : {v, u}) {
      if (!is_regular_ruled(p)) continue;
      ++regular;
      CHECK(base_points(p, true, 1).empty());
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(regular > rounds);
}

TEST_CASE("degree (2, 2) needs the condition of theorem 3.9", "[projective]") {
  NetMaker make(83);
  WorstCase worst;
  int unequal = 0;
  for (int k = 0; k < 100; ++k) {
    Sides sides = random_sides(make, 0.2);
    // The last section is turned about its chord until the factors agree; every other time it is not.
    const lvec2 h = holonomy(sides.quad);
    const bool closes = k % 2 == 0;
    if (closes) {
      SectionArc& last = sides.quad.arc[3];
      const long double part = std::sqrt(h.x / h.y);
      last = {last.x / part, last.y * part};
      const RuledPoint &from = sides.quad.corner[3], &to = sides.quad.corner[0];
      sides.between[3] = {from.a + last.x * to.a, from.b + last.y * to.b};
    }
    // Where two sections meet again: on the line that their planes share.
    const auto second = [&](std::size_t corner) {
      const std::size_t before = (corner + 3) % 4, after = (corner + 1) % 4;
      const auto point_of = [&](std::size_t i) { return image_of(sides.quad.corner[i]); };
      const lvec4 c = point_of(corner);
      const lvec4 in = plane_of(point_of(before), image_of(sides.between[before]), c);
      const lvec4 out = plane_of(c, image_of(sides.between[corner]), point_of(after));
      const lvec4 d = plane_of(in, out, c);
      const auto form = [](const lvec4& p, const lvec4& q) {
        return p.x * q.x + p.y * q.y - p.z * q.z - p.w * q.w;
      };
      return glm::normalize(form(d, d) * c - 2 * form(c, d) * d);
    };
    const lvec4 h4 = plane_of(image_of(sides.quad.corner[0]), second(1), image_of(sides.quad.corner[2]));
    const long double off = std::abs(glm::dot(h4, second(3)));
    const auto text = [&] { return fmt::format("quad {}", k); };
    if (!closes) {
      unequal += off > 1e-6L;
      continue;
    }
    worst.add(static_cast<double>(off), 1e-13, text);
    const TensorPreimage p = bilinear_preimage(sides.quad);
    CHECK((p.m == 1 && p.n == 1));
    check_sides(p, sides, text(), worst);
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(unequal > 45);
}

TEST_CASE("a plane gives the finite arc, the shorter of two", "[projective]") {
  NetMaker make(84);
  WorstCase worst;
  const lvec4 weight(0, 0, 0, 1);
  int finite = 0, through_infinity = 0;
  for (int k = 0; k < 300; ++k) {
    // On the hyperboloid x^2 + y^2 = z^2 + 1.
    const RuledPoint p = at(make.uniform(-0.3, 0.3), make.uniform(-0.3, 0.3)),
                     r = at(make.uniform(-0.7, 0.7), make.uniform(-0.7, 0.7)),
                     q = at(make.uniform(-0.7, 0.7), make.uniform(-0.7, 0.7));
    const SectionArc through = section_through(p, r, q);
    const auto found = section_in_plane(p, q, plane_of(image_of(p), image_of(r), image_of(q)), weight);
    if (!found) {
      ++through_infinity;
      continue;
    }
    ++finite;
    worst.add(static_cast<double>(std::abs(found->x / found->y / (through.x / through.y) - 1)), 1e-13,
              [&] { return fmt::format("arc {}", k); });
    // Its weight has no zero.
    for (int i = 0; i <= 50; ++i) {
      const long double t = i / 50.0L;
      const lvec4 x = ruled_point((1 - t) * p.a + t * found->x * q.a, (1 - t) * p.b + t * found->y * q.b);
      worst.add(x.w * image_of(p).w > 0 ? 0.0 : 1.0, 0.5, [&] { return fmt::format("arc {} at {}", k, i); });
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(finite > 100);
  CHECK(through_infinity > 50);
  // On the waist the shorter arc stays on its side; along a line it is the line.
  const RuledPoint east = at(0, 0), north = at(0.7L, 0.7L);
  const auto waist = section_in_plane(east, north, {0, 0, 1, 0}, weight);
  REQUIRE(waist);
  const lvec4 middle = ruled_point(east.a + waist->x * north.a, east.b + waist->y * north.b);
  CHECK(middle.x / middle.w > 0.7L);
  const RuledPoint along = at(0, 0.5L);
  const auto line =
      section_in_plane(east, along, plane_of(image_of(east), image_of(along), {0, 0, 0, 1}), weight);
  REQUIRE(line);
  CHECK((line->x == 1 && line->y == 1));
}

}  // namespace rondure
