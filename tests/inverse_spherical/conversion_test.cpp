// Spherical triangles as quartics, triangles as tensor-product patches, tubes, and when patches close up.
#include <fmt/format.h>

#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/rational.h"
#include "renderer/bezier/triangle_to_tensor.h"
#include "renderer/bezier/tube.h"
#include "renderer/intersect/tracer.h"
#include "renderer/inverse_spherical/closed.h"
#include "renderer/inverse_spherical/partition.h"
#include "renderer/inverse_spherical/sphere_triangle.h"
#include "tests/bezier/oracle.h"
#include "tests/catch.h"
#include "tests/inverse_spherical/random_iss.h"
#include "tests/paths.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

// | |p| - 1 | without rounding.
double off_sphere(const Net& net, double u, double v) {
  const oracle::BigPoint p = oracle::derivative(net, 0, 0, oracle::Big(u), oracle::Big(v));
  const oracle::Big r2 = p.c[0] * p.c[0] + p.c[1] * p.c[1] + p.c[2] * p.c[2];
  return static_cast<double>(abs(r2 / (p.c[3] * p.c[3]) - 1) / 2);
}

}  // namespace

TEST_CASE("any spherical triangle is a quartic inverse spherical surface", "[iss]") {
  NetMaker make(61);
  WorstCase on_sphere, sides;
  int faults = 0, positive = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const std::array<dvec3, 3> t = random_triangle(make);
    const TriangleNet net = sphere_triangle({3.0 * t[0], t[1], 0.1 * t[2]});
    std::vector<dvec3> u;
    bool all = true;
    for (const dvec4& p : net.points) u.emplace_back(p), all = all && p.w > 0.0;
    positive += all;
    faults += partition_fault(4, u).has_value() + fold_fault(4, u).has_value();
    for (int k = 0; k < 12; ++k) {
      dvec2 at = make.in_triangle();
      if (k < 3) at = dvec2(at.x, 0.0);
      const auto say = [&] { return fmt::format("trial {} at ({}, {})", trial, at.x, at.y); };
      // Half an ulp of every control point, over a weight that falls to about a third of the corners'.
      on_sphere.add(off_sphere(net, at.x, at.y), 4.0 * epsilon, say);
      if (k >= 3) continue;
      const dvec3 normal = glm::normalize(glm::cross(t[0], t[2]));
      sides.add(std::abs(glm::dot(net_point(net, at.x, at.y), normal)), 16.0 * epsilon, say);
    }
  }
  INFO(on_sphere.text());
  INFO(sides.text());
  CHECK(on_sphere.failures() + sides.failures() == 0);
  // A very large triangle has a weight that is not positive until its degree is elevated.
  CHECK(positive >= 58);
  CHECK(faults == 0);
  CHECK_THROWS_WITH(sphere_triangle({dvec3(1, 0, 0), dvec3(1, 1, 0), dvec3(0, 1, 0)}),
                    Catch::Contains("on one great circle"));
}

TEST_CASE("spheres of quartic triangles close up, whatever the triangles", "[iss]") {
  const Surface octants = build_family(
      R"({"type": "iss", "vertices": [[1,0,0],[-1,0,0],[0,1,0],[0,-1,0],[0,0,1],[0,0,-1]], "patches": [
        {"sphere": [0,2,4]}, {"sphere": [1,2,4]}, {"sphere": [0,3,4]}, {"sphere": [1,3,4]},
        {"sphere": [0,2,5]}, {"sphere": [1,2,5]}, {"sphere": [0,3,5]}, {"sphere": [1,3,5]}]})");
  CHECK(octants.closed);
  const std::string four = R"("vertices": [[3,1,-1],[-1,2,1],[0,-1,4],[-2,-3,-2]])";
  const Surface unlike = build_family(R"({"type": "iss", )" + four + R"(, "patches": [
        {"sphere": [0,1,2]}, {"sphere": [0,3,1]}, {"sphere": [1,3,2]}, {"sphere": [2,3,0]}]})");
  CHECK(unlike.closed);
  const Surface open = build_family(R"({"type": "iss", )" + four + R"(, "patches": [
        {"sphere": [0,1,2]}, {"sphere": [0,3,1]}, {"sphere": [1,3,2]}]})");
  CHECK_FALSE(open.closed);
  // Twice the same patch is no solid, nor are sides that agree at their ends alone.
  const Surface twice =
      build_family(R"({"type": "iss", "patches": [{"triangle": [0,1,2]}, {"triangle": [0,1,2]}]})");
  CHECK_FALSE(twice.closed);
  const Surface bent = build_family(R"({"type": "iss", "degree": 2, )" + four + R"(, "patches": [
        {"triangle": [0,1,2]}, {"triangle": [0,3,1]}, {"triangle": [1,3,2]}, {"triangle": [2,3,0], "c": {"110": 1.0001, "rest": 1}}]})");
  CHECK_FALSE(bent.closed);
  const Surface straight = build_family(R"({"type": "iss", "degree": 2, )" + four + R"(, "patches": [
        {"triangle": [0,1,2]}, {"triangle": [0,3,1]}, {"triangle": [1,3,2]}, {"triangle": [2,3,0]}],
        "modify": [{"elevate": 5}, {"quarter": {}}]})");
  CHECK(straight.closed);
  CHECK(straight.patches.size() == 16);
}

TEST_CASE("triangles in tensor form are the same surface", "[iss]") {
  NetMaker make(62);
  WorstCase worst;
  for (int n = 1; n <= 8; ++n) {
    const TriangleNet net = make.triangle(n);
    const TensorNet whole = as_degenerate_tensor(net);
    const std::array<TensorNet, 3> parts = as_three_tensors(net);
    const dvec2 corner[3] = {{1, 0}, {0, 1}, {0, 0}};
    REQUIRE((whole.m == n && whole.n == n));
    double size = 0.0;
    for (const dvec4& p : net.points) size = std::max(size, glm::length(p));
    for (int k = 0; k < 8; ++k) {
      const double s = make.uniform(0.0, 1.0), t = make.uniform(0.0, 1.0);
      const auto compare = [&](const TensorNet& tensor, dvec2 at, const char* what) {
        const oracle::BigPoint p = oracle::derivative(net, 0, 0, oracle::Big(at.x), oracle::Big(at.y));
        // at is rounded: half an epsilon times a derivative of at most 2 n size.
        worst.add(oracle::distance(net_first(tensor, s, t).value, p), (4.0 + 3.0 * n) * epsilon * size,
                  [&] { return fmt::format("{}, degree {}", what, n); });
      };
      compare(whole, dvec2(1.0 - s, s * (1.0 - t)), "degenerate");
      for (std::size_t part = 0; part < 3; ++part) {
        const dvec2 a = corner[part], next = 0.5 * (a + corner[(part + 1) % 3]),
                    before = 0.5 * (a + corner[(part + 2) % 3]), centre(1.0 / 3.0);
        compare(parts[part],
                (1 - s) * (1 - t) * a + s * (1 - t) * next + (1 - s) * t * before + s * t * centre, "third");
      }
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("tensor forms have the reference's control points", "[iss]") {
  std::ifstream file(source_folder() + "/tests/data/triangle_to_tensor.json");
  WorstCase worst;
  for (const auto& item : nlohmann::json::parse(file)) {
    const Surface surface = build_family(item["object"].dump());
    const auto& net = std::get<TriangleNet>(surface.patches[0]);
    const std::string kind = item["kind"];
    const TensorNet tensor = kind == "degenerate" ? as_degenerate_tensor(net)
                                                  : as_three_tensors(net)[item["corner"].get<std::size_t>()];
    const double factor = item["net"][0][0][3].get<double>() / tensor.at(0, 0).w;
    for (int i = 0; i <= tensor.m; ++i) {
      for (int j = 0; j <= tensor.n; ++j) {
        const auto& e = item["net"][static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
        const dvec4 q(e[0].get<double>(), e[1].get<double>(), e[2].get<double>(), e[3].get<double>());
        // The data is point times weight, rounded; the sums are of positive weights, rounded once.
        worst.add(glm::distance(factor * tensor.at(i, j), q), 8.0 * epsilon * glm::length(q),
                  [&] { return fmt::format("{} ({}, {})", kind, i, j); });
      }
    }
  }
  INFO(worst.text());
  CHECK(worst.count() == 4 * (25 + 49 + 16));
  CHECK(worst.failures() == 0);
}

TEST_CASE("rays meet all three forms of a model alike", "[iss][hits]") {
  const std::string object =
      R"({"type": "iss", "octants": {"degree": 4, "interior": [{"112": 0.4, "rest": 0.6}, 0.6, 0.6,
    0.5, {"112": 1.4, "rest": 1.1}, 1.1, 1.2, 1.1]})";
  const Tracer triangles({{build_family(object + "}"), Solver::newton}});
  NetMaker make(63);
  for (const char* form : {"degenerate", "quadrilaterals"}) {
    const Surface surface = build_family(object + R"(, "form": ")" + form + "\"}");
    CHECK(surface.closed);
    const Tracer tensors({{surface, Solver::newton}});
    WorstCase worst;
    int unlike = 0, hits = 0;
    for (int k = 0; k < 3000; ++k) {
      const dvec3 origin = 3.0 * dvec3(make.point()), target = 0.8 * dvec3(make.point());
      const Ray ray{origin, target - origin};
      const std::vector<Hit> a = triangles.all(ray), b = tensors.all(ray);
      unlike += a.size() != b.size();
      for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        ++hits;
        const double cosine = std::abs(glm::dot(a[i].normal, ray.direction)) / glm::length(ray.direction);
        // 16 ulps of the surface (radius about 1) on each side, along the ray 1 / cos.
        worst.add(std::abs(a[i].t - b[i].t),
                  32.0 * epsilon / cosine / glm::length(ray.direction) + 8.0 * epsilon * a[i].t,
                  [&] { return fmt::format("{} ray {}", form, k); });
      }
    }
    INFO(form << ": " << hits << " hits, " << worst.text());
    CHECK(unlike == 0);
    CHECK(hits > 1000);
    CHECK(worst.failures() == 0);
  }
}

TEST_CASE("tubes are round", "[iss]") {
  NetMaker make(64);
  WorstCase worst, outward;
  const auto check = [&](const std::vector<TensorNet>& nets, std::size_t patches, auto distance,
                         double radius) {
    CHECK(nets.size() == patches);
    for (const TensorNet& tube : nets) {
      const Net net = tube;
      for (int k = 0; k < 10; ++k) {
        const double u = make.uniform(0.0, 1.0), v = make.uniform(0.0, 1.0);
        const dvec3 p = net_point(net, u, v);
        worst.add(std::abs(distance(p) - radius), 32.0 * epsilon,
                  [&] { return fmt::format("({}, {})", u, v); });
        const double ahead = distance(p + 1e-4 * unit_normal(net, u, v)) - radius;
        outward.add(std::abs(ahead - 1e-4), 1e-9, [&] { return fmt::format("({}, {})", u, v); });
      }
    }
  };
  for (int trial = 0; trial < 20; ++trial) {
    const dvec3 a(make.point()), b(make.point());
    const dvec3 along = glm::normalize(b - a);
    check(
        straight_tube(a, b, 0.05), 3, [&](const dvec3& p) { return glm::length(glm::cross(p - a, along)); },
        0.05);
    const dvec3 axis = glm::normalize(glm::cross(a, b));
    const auto to_circle = [&](const dvec3& p) {
      const double up = glm::dot(p, axis), out = glm::length(p - up * axis) - 1.0;
      return std::sqrt(up * up + out * out);
    };
    const dvec3 from = glm::normalize(a);
    const double angle = std::acos(glm::dot(from, glm::normalize(b)));
    check(circle_tube({dvec3(0.0), from, glm::cross(axis, from), angle}, 0.05), glm::dot(a, b) < 0.0 ? 6 : 3,
          to_circle, 0.05);
  }
  INFO(worst.text());
  INFO(outward.text());
  CHECK(worst.failures() == 0);
  CHECK(outward.failures() == 0);
  CHECK(straight_tube(dvec3(1), dvec3(1), 0.1).empty());
}

}  // namespace rondure
