// Nets, points, normals and first hits of the cases in tests/data/inverse_spherical, computed at 50 digits.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/rational.h"
#include "renderer/bezier/triangle_keys.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using Json = nlohmann::json;

struct Case {
  std::string name;
  Json data;
  Surface surface;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> made;
    for (const auto& entry :
         std::filesystem::directory_iterator(source_folder() + "/tests/data/inverse_spherical")) {
      std::ifstream stream(entry.path());
      Case c{entry.path().stem().string(), Json::parse(stream), {}};
      c.surface = build_family(c.data["object"].dump());
      made.push_back(std::move(c));
    }
    return made;
  }();
  return all;
}

dvec3 vector_of(const Json& j) { return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()}; }

}  // namespace

TEST_CASE("iss nets are the reference's", "[iss]") {
  WorstCase worst;
  for (const Case& c : cases()) {
    REQUIRE(c.surface.patches.size() == c.data["patches"].size());
    for (std::size_t k = 0; k < c.surface.patches.size(); ++k) {
      const Json& expected = c.data["patches"][k];
      const auto& net = std::get<TriangleNet>(c.surface.patches[k]);
      REQUIRE(net.n == expected["degree"].get<int>());
      // A common factor is free.
      const double factor =
          expected["net"][triangle_key_name(net.n, net.n, 0)][3].get<double>() / net.at(net.n, 0).w;
      for (const auto& [key, value] : expected["net"].items()) {
        const dvec4& p = net.points[*triangle_key(net.n, key)];
        const dvec4 q(vector_of(value), value[3].get<double>());
        // The data is rounded, the input coefficients are, and the constructions take some ten sums:
        // elevation by four degrees, the blossoms of a subdivision, the relations along edges.
        worst.add(glm::length(factor * p - q), 16.0 * epsilon * glm::length(q),
                  [&] { return fmt::format("{} patch {} {}", c.name, k, key); });
      }
    }
    INFO(c.name);
    CHECK(c.surface.closed == (c.name.rfind("closed", 0) == 0));
  }
  INFO(worst.text());
  CHECK(cases().size() == 17);
  CHECK(worst.failures() == 0);
}

TEST_CASE("iss points and normals are the reference's", "[iss]") {
  WorstCase points, normals;
  for (const Case& c : cases()) {
    for (const Json& s : c.data["samples"]) {
      const Net& net = c.surface.patches[s["patch"].get<std::size_t>()];
      const double u = s["uv"][0].get<double>(), v = s["uv"][1].get<double>();
      const auto say = [&] { return fmt::format("{} {}", c.name, s.dump()); };
      const dvec3 p = vector_of(s["point"]);
      // Parameters and net are rounded; the surfaces move by less than 10 for a unit of a parameter.
      points.add(glm::distance(net_point(net, u, v), p), 16.0 * epsilon * std::fmax(1.0, glm::length(p)),
                 say);
      normals.add(glm::distance(unit_normal(net, u, v), vector_of(s["normal"])), 1e-13, say);
    }
  }
  INFO("points: " << points.text());
  INFO("normals: " << normals.text());
  CHECK(points.count() > 150);
  CHECK(points.failures() == 0);
  CHECK(normals.failures() == 0);
}

TEST_CASE("iss first hits are the reference's", "[iss][hits]") {
  WorstCase t, parameter;
  int rays = 0, hits = 0, either = 0, wrong = 0;
  std::string what;
  for (const Case& c : cases()) {
    for (const Solver solver : {Solver::newton, Solver::clipping}) {
      const Tracer tracer({{c.surface, solver}});
      for (const Json& ray : c.data["rays"]) {
        ++rays;
        const dvec3 direction = vector_of(ray["direction"]);
        const Hit hit = tracer.closest({vector_of(ray["origin"]), direction});
        const auto say = [&] { return c.name + " " + ray.dump(); };
        const bool boundary = ray.contains("patches"), expected = ray["hit"].get<bool>();
        if (static_cast<bool>(hit) != expected) {
          // Aimed at the rim of an open patch, within its rounding: either answer is right.
          const bool open_rim = !c.surface.closed && (boundary || ray.contains("near_miss"));
          open_rim ? ++either : ++wrong;
          if (!open_rim) what = say();
          continue;
        }
        if (!expected) continue;
        ++hits;
        if (ray.contains("near_miss") && hit.t < ray["t"].get<double>()) {
          ++either;  // the rim in front of the hit was met
          continue;
        }
        // 16 ulps of the surface, stretched along the ray by 1 / cos.
        const double off = 16.0 * epsilon / ray["cosine"].get<double>();
        const double expected_t = ray["t"].get<double>();
        t.add(std::fabs(hit.t - expected_t), off / glm::length(direction) + 4.0 * epsilon * expected_t, say);
        const int patch = ray["patch"].get<int>();
        if (boundary) {
          const auto allowed = ray["patches"].get<std::vector<int>>();
          if (std::find(allowed.begin(), allowed.end(), hit.patch) == allowed.end()) ++wrong, what = say();
          if (hit.patch != patch) continue;
        } else if (hit.patch != patch) {
          ++wrong, what = say();
          continue;
        }
        // Parameters run faster than the surface by up to 10.
        const dvec2 uv(ray["uv"][0].get<double>(), ray["uv"][1].get<double>());
        parameter.add(glm::distance(dvec2(hit.u, hit.v), uv), 10.0 * off + 16.0 * epsilon, say);
      }
    }
  }
  INFO(rays << " rays, " << hits << " hits, " << either << " decided by rounding, " << wrong
            << " wrong: " << what);
  INFO("t: " << t.text());
  INFO("parameters: " << parameter.text());
  CHECK(rays >= 300);
  CHECK(hits > 200);
  CHECK(either <= 14);
  CHECK(wrong == 0);
  CHECK(t.failures() == 0);
  CHECK(parameter.failures() == 0);
}

}  // namespace rondure
