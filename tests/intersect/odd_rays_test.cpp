// Rays that no camera makes: not finite, without direction, of extreme length; and rays that lie in a
// surface.

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/closed_models.h"
#include "tests/intersect/placed.h"
#include "tests/intersect/sphere_reference.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;

namespace {
constexpr double inf = std::numeric_limits<double>::infinity(),
                 no_number = std::numeric_limits<double>::quiet_NaN();
}

TEST_CASE("Rays that are not finite or have no direction hit nothing", "[hits]") {
  const Solver solver = GENERATE(Solver::newton, Solver::quadric);
  const Tracer tracer({{build_family(R"({"type": "sphere_tiling", "topology": "cube"})"), solver}});
  const dvec3 good(0.0, 0.0, -3.0), along(0.0, 0.0, 1.0);
  for (const double bad : {no_number, inf, -inf}) {
    for (int k = 0; k < 3; ++k) {
      dvec3 origin = good, direction = along;
      origin[k] = bad;
      CHECK_FALSE(tracer.closest({origin, along}));
      direction[k] = bad;
      CHECK_FALSE(tracer.closest({good, direction}));
      CHECK_FALSE(tracer.occluded({good, direction}));
      CHECK(tracer.all({good, direction}).empty());
    }
    CHECK_FALSE(tracer.closest({good, along, no_number, inf}));
    CHECK_FALSE(tracer.closest({good, along, 0.0, no_number}));
  }
  CHECK_FALSE(tracer.closest({good, dvec3(0.0)}));
  CHECK_FALSE(tracer.closest({good, along, 5.0, 1.0}));
  CHECK(tracer.closest({good, along}));
}

TEST_CASE("The length of the direction changes t alone", "[hits]") {
  const Solver solver = GENERATE(Solver::newton, Solver::quadric);
  const Tracer tracer({{build_family(R"({"type": "sphere_tiling", "topology": "hemispheres"})"), solver}});
  // Few bits, which the smallest scale leaves whole.
  const dvec3 origin(0.1, 0.2, -3.0), direction(0x1p-7, -0x1p-6, 1.0);
  const Hit unit = tracer.closest({origin, direction});
  REQUIRE(unit);
  for (const int exponent : {-1020, -600, -40, 1, 40, 600, 1000}) {
    const double scale = std::ldexp(1.0, exponent);
    const Hit hit = tracer.closest({origin, direction * scale});
    CAPTURE(exponent);
    REQUIRE(hit);
    CHECK(hit.point == unit.point);
    CHECK(hit.t * scale == unit.t);
  }
}

TEST_CASE("A direction of denormal length meets what it reaches at a t that is a number", "[hits]") {
  const Solver solver = GENERATE(Solver::newton, Solver::clipping, Solver::quadric);
  const Surface cube = build_family(R"({"type": "sphere_tiling", "topology": "cube"})");
  // So small and so near that the largest double is steps enough.
  const Tracer tracer({{placed(cube, 0x1p-40, dvec3(0.0)), solver}});
  const dvec3 origin = 0x1p-40 * dvec3(0.25, 0.5, -3.0), along(0.0, 0.0, 1.0);
  const int exponent = GENERATE(-1022, -1060);
  const dvec3 step(0.0, 0.0, std::ldexp(1.0, exponent));
  const Hit unit = tracer.closest({origin, along}), hit = tracer.closest({origin, step});
  REQUIRE(unit);
  REQUIRE(hit);
  CHECK(hit.point == unit.point);
  CHECK(std::ldexp(hit.t, exponent) == unit.t);
  CHECK(tracer.occluded({origin, step}));
  const std::vector<Hit> all = tracer.all({origin, step});
  REQUIRE(all.size() == 2);
  CHECK(all[0].t == hit.t);
  CHECK_FALSE(tracer.closest({origin, step, 0.0, 0.5 * hit.t}));
  CHECK_FALSE(tracer.occluded({origin, step, 2.0 * all[1].t}));
  Hit batch;
  const Ray ray{origin, step};
  tracer.closest({&ray, 1}, {&batch, 1});
  CHECK(batch.t == hit.t);
  // From here t would be beyond the largest double.
  CHECK_FALSE(tracer.closest({dvec3(0.0, 0.0, -8.0), step}));
}

TEST_CASE("t_min and t_max bound the hits", "[hits]") {
  const Solver solver = GENERATE(Solver::newton, Solver::quadric);
  const Tracer tracer({{build_family(R"({"type": "sphere_tiling", "topology": "cube"})"), solver}});
  const dvec3 origin(0.1, 0.2, -3.0), direction(0.0, 0.0, 1.0);
  const std::vector<Hit> both = tracer.all({origin, direction});
  REQUIRE(both.size() == 2);
  const double near = both[0].t, far = both[1].t, middle = 0.5 * (near + far);
  CHECK(tracer.closest({origin, direction, middle, inf}).t == far);
  CHECK(tracer.closest({origin, direction, 0.0, middle}).t == near);
  CHECK(tracer.all({origin, direction, middle, inf}).size() == 1);
  CHECK_FALSE(tracer.occluded({origin, direction, near + 1e-9, far - 1e-9}));
  CHECK(tracer.occluded({origin, direction, near, far}));
  CHECK_FALSE(tracer.closest({origin, direction, far + 1e-9, inf}));
  // Behind the origin there is nothing unless it is asked for.
  CHECK_FALSE(tracer.closest({origin, -direction}));
  CHECK(tracer.closest({origin, -direction, -10.0, inf}).t == -far);
}

TEST_CASE("Of two grazing hits the one on a patch's edge counts as much as the one inside", "[hits]") {
  // On the sharp edge between two patches, which the ray crosses on one at 20 degrees and on the other at
  // 0.02: there its two hits are 1.5e-3 apart, and rounding puts one of them at v = -1e-13.
  const auto& models = closed_models();
  const auto crystal = std::find_if(models.begin(), models.end(), [](const ClosedModel& m) {
    return m.name == "casciola/figure_1: crystal";
  });
  REQUIRE(crystal != models.end());
  const Ray ray{dvec3(1.9753159699000471, -0.91974059994657653, 0.11793400923289127),
                dvec3(-0.61005611566862183, 0.66379403854258323, -0.64716497099963355)};
  for (const Solver solver : {Solver::newton, Solver::clipping}) {
    const std::vector<Hit> hits = Tracer({{crystal->surface, solver}}).all(ray);
    REQUIRE(hits.size() == 4);
    CHECK(hits[0].patch == 6);
    CHECK(hits[1].patch == 7);
    CHECK(std::fabs(hits[1].t - hits[0].t) < 1e-12);
    CHECK(hits[2].patch == 7);
    CHECK(hits[3].patch == 5);
  }
}

TEST_CASE("A ray that grazes two patches along their seam has both of its hits", "[hits]") {
  // In the plane of the seam, at 0.07 degrees: both hits are at v = 0 of the one patch and u = 0 of the
  // other, and a search that leaves that by its last bit finds one of them.
  const Ray ray{dvec3(0.0, 4.0012492080025357, -0.99999921973937866), dvec3(0.0, -1.0, 0.0)};
  const SphereReference exact = sphere_reference(ray.origin, ray.direction, dvec3(0.0), 1.0);
  const char* family =
      R"({"type": "sphere_tiling", "topology": "icosahedron_pairs", "corner_weights": "unit"})";
  for (const Solver solver : {Solver::newton, Solver::clipping, Solver::quadric}) {
    const std::vector<Hit> hits = Tracer({{build_family(family), solver}}).all(ray);
    REQUIRE(hits.size() == 2);
    // As in sphere_hits_test: 8 ulps of the radius, over the cosine of incidence.
    for (int k = 0; k < 2; ++k)
      CHECK(std::fabs(hits[std::size_t(k)].t - exact.t[k]) < 8.0 * 0x1p-52 * (4.0 + 0.5 / exact.cosine));
  }
}

TEST_CASE("A ray that skims a singular corner has its other hit too", "[hits]") {
  // It runs within rounding of the surface beside the corner, which takes a hundred candidates; the second
  // hit, 3e-5 radii on, comes after them.
  const Ray ray{dvec3(-0.32192691661406703, -1.0000594248483352, -3.4976197832938865),
                dvec3(0.20473146426954064, 3.7791609169008833e-05, 2.2243334829635089)};
  const SphereReference exact = sphere_reference(ray.origin, ray.direction, dvec3(0.0), 1.0);
  for (const Solver solver : {Solver::newton, Solver::clipping, Solver::quadric}) {
    const Tracer tracer({{build_family(R"({"type": "sphere_tiling", "topology": "hemispheres"})"), solver}});
    const std::vector<Hit> hits = tracer.all(ray);
    REQUIRE(hits.size() == 2);
    // As in sphere_hits_test: 8 ulps of the radius, over the cosine of incidence.
    for (int k = 0; k < 2; ++k)
      CHECK(std::fabs(hits[std::size_t(k)].t - exact.t[k]) < 8.0 * 0x1p-52 * (2.0 + 0.5 / exact.cosine));
  }
}

TEST_CASE("A ray inside a plane patch ends, and a ray across it hits once", "[hits]") {
  const Tracer tracer({{build_family(R"({"type": "bezier", "patches": [{"kind": "tensor", "degree": [1, 1],
      "net": [[[-1, -1, 0, 1], [-1, 1, 0, 1]], [[1, -1, 0, 1], [1, 1, 0, 1]]]}]})"),
                        Solver::newton}});
  CHECK(tracer.all({dvec3(-3.0, 0.1, 0.0), dvec3(1.0, 0.0, 0.0)}).empty());
  CHECK(tracer.all({dvec3(-3.0, -3.0, 0.0), dvec3(1.0, 1.0, 0.0)}).empty());
  CHECK(tracer.all({dvec3(0.3, 0.1, 2.0), dvec3(0.0, 0.0, -1.0)}).size() == 1);
  CHECK(tracer.all({dvec3(1.0, 1.0, 2.0), dvec3(0.0, 0.0, -1.0)}).size() == 1);
  CHECK(tracer.all({dvec3(1.0 + 1e-9, 1.0, 2.0), dvec3(0.0, 0.0, -1.0)}).empty());
  const std::vector<Hit> slanted = tracer.all({dvec3(-3.0, 0.0, 3e-9), dvec3(1.0, 0.0, -1e-9)});
  REQUIRE(slanted.size() == 1);
  CHECK(std::fabs(slanted[0].t - 3.0) < 1e-6);
}

TEST_CASE("Nets that cannot be bounded are refused by object and patch", "[hits]") {
  Surface surface;
  TensorNet net(1, 1);
  for (int k = 0; k < 4; ++k)
    net.points[static_cast<std::size_t>(k)] = dvec4(k % 2, k / 2, 0.0, k == 3 ? -1.0 : 1.0);
  surface.patches.push_back(net);
  CHECK_THROWS_WITH(Tracer({{surface, Solver::newton}}),
                    Catch::Matchers::StartsWith("object 0: patch 0: a weight is not positive near"));
  // The weight (u - v)^2 + 10^-12 is positive, but no cell on its diagonal shows that before some 10^6 are
  // left there: that must not take the memory of the machine.
  TensorNet grooved(2, 2);
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; j <= 2; ++j) {
      const double w = (i == 2 ? 1.0 : 0.0) - 0.5 * i * j + (j == 2 ? 1.0 : 0.0) + 1e-12;
      grooved.at(i, j) = dvec4(0.5 * i, 0.5 * j, 0.0, w);
    }
  surface.patches[0] = grooved;
  CHECK_THROWS_WITH(Tracer({{surface, Solver::newton}}),
                    Catch::Matchers::StartsWith("object 0: patch 0: a weight is not positive near"));
  net.points[3] *= -1e-17;
  surface.patches[0] = net;
  CHECK_THROWS_WITH(Tracer({{surface, Solver::newton}}),
                    Catch::Matchers::StartsWith("object 0: patch 0: the weight of a corner is 1e-17 of the"));
  net.points[3].w = 1.0;
  net.points[2].x = no_number;
  surface.patches[0] = net;
  CHECK_THROWS_WITH(Tracer({{surface, Solver::newton}}), "object 0: patch 0: a control point is not finite");
}

TEST_CASE("An empty scene is met by nothing", "[hits]") {
  const Tracer tracer(std::vector<TracedSurface>{});
  CHECK_FALSE(tracer.closest({dvec3(0.0), dvec3(0.0, 0.0, 1.0)}));
  CHECK(tracer.statistics().leaves == 0);
}
