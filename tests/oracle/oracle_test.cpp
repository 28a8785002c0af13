// The judge is judged: by closed forms, on surfaces and rays whose doubles are exact.

#include "tests/oracle/oracle.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tests/catch.h"
#include "tests/intersect/random_direction.h"
#include "tests/intersect/sphere_reference.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

using namespace rondure;

namespace {

// Where graphs stand: so that the frame's origin is not forgotten. All sums with it are exact.
constexpr dvec3 place(3.0, -2.0, 0.0);

// The graph z = f(u) + g(v) over the unit square, of coefficients of one degree.
Surface graph(const std::vector<double>& f, const std::vector<double>& g) {
  const int n = static_cast<int>(f.size()) - 1;
  TensorNet net(n, n);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      net.at(i, j) = dvec4(double(i) / n, double(j) / n,
                           f[static_cast<std::size_t>(i)] + g[static_cast<std::size_t>(j)], 1.0);
  Surface surface;
  surface.patches = {net};
  surface.origin = place;
  return surface;
}
const std::vector<double> square = {0.25, -0.25, 0.25};  // of (u - 1/2)^2
const std::vector<double> minus_square = {-0.25, 0.25, -0.25};
const std::vector<double> cube = {-1.0 / 8, 1.0 / 8, -1.0 / 8, 1.0 / 8};  // of (u - 1/2)^3
const std::vector<double> zero = {0.0, 0.0, 0.0};

// Along x through y = 1/2, from one unit before the square.
Ray along_x(double z) { return {place + dvec3(-1.0, 0.5, z), dvec3(1.0, 0.0, 0.0)}; }

}  // namespace

TEST_CASE("The oracle finds the chords of the sphere, each end once", "[oracle]") {
  std::mt19937_64 random(17);
  long wrong = 0, uncertified = 0, chords = 0;
  WorstCase t, cosine;
  for (const char* family :
       {R"({"type": "sphere_tiling", "topology": "cube"})",
        R"({"type": "sphere_tiling", "topology": "icosahedron_pairs"})", R"({"type": "sphere_octant"})"}) {
    const Surface surface = build_family(family);
    for (int k = 0; k < 100; ++k) {
      const dvec3 d = random_direction(random), side = random_direction(random);
      const Ray ray{1.3 * side - 3.0 * d * std::uniform_real_distribution<double>(0.5, 2.0)(random), d};
      const SphereReference exact = sphere_reference(ray.origin, d, dvec3(0.0), 1.0);
      if (std::fabs(exact.clearance) < 1e-3) continue;
      const std::vector<oracle::Crossing> found = oracle::crossings(oracle::meet(surface, ray), 1e-13);
      if (found.size() != (exact.clearance < 0.0 ? 2 : 0)) ++wrong;
      for (std::size_t end = 0; end < found.size() && found.size() == 2; ++end) {
        ++chords;
        uncertified += !found[end].certified || found[end].multiplicity != 1;
        const auto text = [&] { return std::string(family); };
        // The nets are rounded, 4 ulps at most in space, and that over the cosine along the ray.
        t.add(std::fabs(found[end].t - exact.t[end]), 4.0 * 0x1p-52 / exact.cosine + 0x1p-52 * exact.t[end],
              text);
        cosine.add(std::fabs(found[end].cosine - exact.cosine), 0x1p-45 / exact.cosine, text);
      }
    }
  }
  INFO("t: " << t.text() << "\ncosine: " << cosine.text());
  CHECK(wrong == 0);
  CHECK(uncertified == 0);
  CHECK(t.failures() == 0);
  CHECK(cosine.failures() == 0);
  CHECK(chords > 100);
}

TEST_CASE("The oracle parts two roots however near, and tells where they are one", "[oracle]") {
  for (const auto& across : {square, minus_square, zero}) {
    const Surface surface = graph(square, across);
    long wrong = 0;
    for (int k = 2; k <= 30; ++k) {
      const double h = std::ldexp(1.0, -k);
      const oracle::Meeting m = oracle::meet(surface, along_x(h * h));
      const bool right = !m.exhausted && m.roots.size() == 2 && m.roots[0].t == 1.5 - h &&
                         m.roots[1].t == 1.5 + h && m.roots[0].u == 0.5 - h && m.roots[0].v == 0.5 &&
                         m.roots[0].multiplicity == 1 && m.roots[1].multiplicity == 1 &&
                         m.roots[0].certified && m.roots[1].certified && m.roots[0].way == -m.roots[1].way;
      wrong += !right;
    }
    CHECK(wrong == 0);
    // Touching; and two that are 2^-99 apart, which is as good.
    for (const double z : {0.0, 0x1p-200}) {
      const oracle::Meeting m = oracle::meet(surface, along_x(z));
      CHECK_FALSE(m.exhausted);
      REQUIRE(m.roots.size() == 1);
      CHECK(m.roots[0].t == 1.5);
      CHECK(m.roots[0].multiplicity == 2);
      CHECK(m.roots[0].certified);
      CHECK(m.roots[0].cosine < 1e-15);
    }
  }
}

TEST_CASE("The oracle tells by how much a line misses, where that is rounding", "[oracle]") {
  const Surface bowl = graph(square, square);
  for (const double depth : {0x1p-47, 0x1p-50, 0x1p-53}) {
    const oracle::Meeting m = oracle::meet(bowl, along_x(-depth));
    CHECK(m.roots.empty());
    REQUIRE(m.grazes.size() == 1);
    CHECK(m.grazes[0].t == Approx(1.5));
    CHECK(m.grazes[0].depth == Approx(depth));
  }
  const oracle::Meeting clear = oracle::meet(bowl, along_x(-0x1p-40));
  CHECK(clear.roots.empty());
  CHECK(clear.grazes.empty());
  CHECK_FALSE(clear.exhausted);
}

TEST_CASE("The oracle claims no more than it proves", "[oracle]") {
  // Three roots in one.
  const std::vector<double> flat = {0.0, 0.0, 0.0, 0.0};
  const oracle::Meeting triple = oracle::meet(graph(cube, flat), along_x(0.0));
  for (const oracle::Root& root : triple.roots) {
    CHECK(root.t == Approx(1.5).margin(1e-12));
    CHECK(root.multiplicity != 1);
    CHECK(root.multiplicity != 2);
    CHECK_FALSE(root.certified);
  }
  CHECK((triple.exhausted || !triple.roots.empty()));
  // A line within a flat patch has a root everywhere.
  const oracle::Meeting within = oracle::meet(graph(zero, zero), along_x(0.0));
  CHECK((within.exhausted || !within.roots.empty()));
  for (const oracle::Root& root : within.roots) CHECK_FALSE(root.certified);
  // A side that is a point.
  const Surface octants = build_family(R"({"type": "sphere_octant"})");
  long poles = 0;
  for (const oracle::Root& root :
       oracle::meet(octants, {dvec3(0.0, 0.0, 3.0), dvec3(0.0, 0.0, -1.0)}).roots) {
    CHECK((!root.certified || root.multiplicity == 1));
    poles += root.t == 2.0 || root.t == 4.0;
  }
  CHECK(poles >= 2);
}

TEST_CASE("The oracle takes roots of neighbours at a shared edge for one crossing", "[oracle]") {
  const Surface cube_faces = build_family(R"({"type": "sphere_tiling", "topology": "cube"})");
  const oracle::Meeting m = oracle::meet(cube_faces, {dvec3(2.0, 2.0, 0.0), dvec3(-1.0, -1.0, 0.0)});
  CHECK(m.roots.size() == 4);
  const std::vector<oracle::Crossing> found = oracle::crossings(m, 0x1p-44);
  REQUIRE(found.size() == 2);
  for (const oracle::Crossing& c : found) {
    CHECK(c.patches.size() == 2);
    CHECK(c.certified);
    CHECK(c.multiplicity == 1);
    CHECK_FALSE(c.touches);
  }
  CHECK(std::fabs(found[0].t - (2.0 - std::sqrt(0.5))) <= 0x1p-50);
  CHECK(std::fabs(found[1].t - (2.0 + std::sqrt(0.5))) <= 0x1p-50);
}
