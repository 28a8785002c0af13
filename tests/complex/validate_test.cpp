// Conditions (1) to (5b) on surface complexes, each met and each broken in one place.
#include "renderer/complex/validate.h"

#include "renderer/complex/regular_joins.h"
#include "renderer/complex/shipped.h"
#include "tests/catch.h"

namespace rondure {
namespace {

const EdgeField to_corner{EdgeFunction(linear(0, -1)), EdgeFunction(1)};

std::string all_of(const SurfaceComplex& complex) {
  std::string text;
  for (const Violation& v : violations(complex)) text += text_of(v) + "\n";
  return text;
}

// Two pyramids of n triangles on one base. Triangle k of the upper one has its apex as corner 2 and the base
// as edge 0; the lower one is its mirror image.
SurfaceComplex bipyramid(int n, bool octahedron_rule) {
  std::vector<Gluing> gluings;
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    gluings.push_back({{k, 0}, {n + k, 0}, false});
    gluings.push_back({{k, 1}, {next, 2}, true});
    gluings.push_back({{n + k, 1}, {n + next, 2}, true});
  }
  const std::vector<int> sides(static_cast<std::size_t>(2 * n), 3);
  if (!octahedron_rule) return regular_complex(sides, gluings);
  SurfaceComplex complex{sides, {}, true};
  for (const Gluing& g : gluings)
    complex.joins.push_back(join_by_fields(g.p, g.q, edge_parameter(g.reversed), to_corner, to_corner));
  return complex;
}

// Triangles 1, 2, 4, 3 of the octahedron, around its vertex A.
SurfaceComplex around_a(int joins) {
  SurfaceComplex complex;
  complex.sides.assign(4, 3);
  const Gluing all[4] = {
      {{0, 0}, {1, 0}, false}, {{1, 2}, {3, 2}, false}, {{3, 0}, {2, 0}, false}, {{2, 2}, {0, 2}, false}};
  for (int k = 0; k < joins; ++k)
    complex.joins.push_back(join_by_fields(all[k].p, all[k].q, edge_parameter(false), to_corner, to_corner));
  return complex;
}

void check_one(const SurfaceComplex& complex, const std::string& condition, double amount,
               const std::string& part) {
  const std::vector<Violation> found = violations(complex);
  INFO(all_of(complex));
  REQUIRE(found.size() >= 1);
  CHECK(found[0].condition == condition);
  CHECK(found[0].amount == Approx(amount).margin(1e-12));
  CHECK(text_of(found[0]).find(part) != std::string::npos);
}

}  // namespace

TEST_CASE("the shipped complexes satisfy Definition 5.1 and have the right topology", "[complex]") {
  const auto check = [](const SurfaceComplex& complex, int vertices, int edges, int polygons) {
    CHECK(all_of(complex) == "");
    const Topology t = topology_of(complex);
    CHECK(t.vertices == vertices);
    CHECK(t.edges == edges);
    CHECK(t.polygons == polygons);
    CHECK(t.parts == 1);
    CHECK(t.boundary_edges == 0);
    CHECK(t.orientable);
    CHECK(complex.exact);
  };
  check(octahedron_complex(), 6, 12, 8);
  check(cube_complex(), 8, 12, 6);
  check(torus_complex(1, 1), 3, 6, 3);
  check(torus_complex(4, 3), 36, 72, 36);
  CHECK(topology_of(torus_complex(4, 3)).euler() == 0);
  // The paper's octahedron is the regular rule for four corners at every vertex.
  const SurfaceComplex h = octahedron_complex();
  std::vector<Gluing> gluings;
  for (const EdgeJoin& join : h.joins) gluings.push_back({join.p, join.q, false});
  const SurfaceComplex regular = regular_complex(h.sides, gluings);
  for (std::size_t k = 0; k < h.joins.size(); ++k) {
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < 2; ++j)
        CHECK((h.joins[k].bundle[i][j] - regular.joins[k].bundle[i][j]).zero());
    }
  }
}

TEST_CASE("vertices with 3, 5, 6, 8 triangles need their own rule", "[complex]") {
  for (const int n : {3, 5, 6, 8, 12}) {
    CAPTURE(n);
    const SurfaceComplex regular = bipyramid(n, false);
    CHECK(all_of(regular) == "");
    CHECK(regular.exact == (n == 3 || n == 6));
    const std::vector<Violation> found = violations(bipyramid(n, true));
    REQUIRE(found.size() == 2);  // the two apexes
    for (const Violation& v : found) {
      CHECK(v.condition == "5b");
      CHECK(v.where.find(std::to_string(n) + " corners meet") != std::string::npos);
    }
    // A quarter turn n times: the identity for 8 and 12, but round 2 and 3 times.
    if (n % 4 == 0) CHECK(found[0].amount == Approx(n / 4 - 1));
    // Otherwise a rotation by 90 (n mod 4) degrees, in the basis of the two edges: 1 or 2 off.
    if (n % 4 != 0) CHECK(found[0].amount == (n % 4 == 2 ? 2.0 : 1.0));
  }
}

TEST_CASE("an open fan must leave room, a closed one may fill the plane", "[complex]") {
  CHECK(all_of(around_a(2)) == "");
  CHECK(all_of(around_a(4)) == "");
  // Glued in a row, ends apart: four quarters leave no room.
  check_one(around_a(3), "5a", 0.0, "fill 1 turns");
}

TEST_CASE("what breaks a condition is named, with its amount", "[complex]") {
  const SurfaceComplex good = octahedron_complex();
  SurfaceComplex c = good;
  c.sides[3] = 5;
  check_one(c, "1", 5, "polygon 3: it has 5 sides");
  check_one(SurfaceComplex{}, "1", 0, "there are no polygons");

  c = good;
  c.joins.push_back(c.joins[4]);
  check_one(c, "2", 2, "is glued more than once");
  c = good;
  c.joins[0].q = c.joins[0].p;
  check_one(c, "2", 2, "edge 0 of polygon 0: it is glued to itself");
  c = good;
  c.joins[0].q.edge = 3;
  check_one(c, "2", 0, "there is no such edge");

  const EdgeField image{EdgeFunction(0), EdgeFunction(-1)};
  const auto with_parameter = [&](const EdgeFunction& parameter) {
    SurfaceComplex changed = good;
    changed.joins[0] = join_by_image(good.joins[0].p, good.joins[0].q, parameter, image);
    return changed;
  };
  check_one(with_parameter(EdgeFunction(linear(0, 1) * linear(0, 1))), "3", 0, "near s = 0");
  check_one(with_parameter(EdgeFunction(linear(Exact(1) / 4, 1))), "3", std::hypot(0.25, 0.25), "0.25, 1.25");
  check_one(with_parameter(EdgeFunction(linear(0, -1), linear(1, -2))), "3", 0, "pole at s = 0.5");

  c = good;
  c.joins[0].bundle[1][0] = EdgeFunction(EdgePolynomial(Exact(1) / 8));
  check_one(c, "4a", 0.125, "vectors along the edge are not taken to such vectors");
  c = good;
  c.joins[0].bundle[0][0] = EdgeFunction(linear(1, Exact(1) / 2));
  check_one(c, "4a", 0.5, "not the derivative of that of parameters");
  c = good;
  c.joins[0].bundle[0][1] = EdgeFunction(1, linear(1, -3));
  check_one(c, "4", 0, "inward to along has a pole at s = 0.3333");
  c = good;
  c.joins[0].bundle[1][1] = EdgeFunction(1);
  check_one(c, "4c", 1, "corner 0 of polygon 0 (edge 0 of polygon 0, glued to edge 0 of polygon 1)");
  REQUIRE(violations(c).size() == 2);
  CHECK(violations(c)[1].condition == "4b");
  // Negative at the ends and positive between: -1 + 5 s (1 - s) is 1/4 in the middle.
  c.joins[0].bundle[1][1] =
      EdgeFunction(EdgePolynomial(-1) + EdgePolynomial(5) * linear(0, 1) * linear(1, -1));
  check_one(c, "4b", 0.25, "the sides overlap");

  c = good;
  c.joins[0].bundle[0][1] = EdgeFunction(linear(Exact(1) / 10, 2));
  check_one(c, "5b", 0.1, "an entry is off by 0.1");
}

}  // namespace rondure
