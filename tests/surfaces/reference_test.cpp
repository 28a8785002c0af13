// The families' nets, points and normals against values computed independently to 40 digits.
#include <fmt/format.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/bezier/rational.h"
#include "tests/catch.h"
#include "tests/reference_data.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using Big = boost::multiprecision::cpp_bin_float_50;
using nlohmann::json;

struct CobbCase {
  const char* name;    // in cobb_nets.json
  const char* object;  // the same surface as an object
  double scale;        // Table 3 is nine times our net
};

const CobbCase cobb_cases[] = {
    {"hemisphere", R"({"type": "sphere_cap"})", 1.0},
    {"hemisphere", R"({"type": "sphere_tiling", "topology": "hemispheres"})", 1.0},
    {"cap_3_5", R"({"type": "sphere_cap", "z_max": 0.6, "middle_weight": 1})", 9.0},
    {"cap_3_5_weight_3", R"({"type": "sphere_cap", "z_max": 0.6, "middle_weight": 3})", 9.0},
    {"cap_m3_5", R"({"type": "sphere_cap", "z_max": -0.6})", 9.0},
    {"cap_12_13", R"({"type": "sphere_cap", "z_max": 0.92307692307692313, "middle_weight": 1})", 9.0},
    {"cube_face", R"({"type": "sphere_tiling", "topology": "cube"})", 1.0},
    {"octant", R"({"type": "sphere_octant"})", 1.0}};

json cobb_entry(const std::string& name) {
  static const json all = reference_data("cobb_nets.json");
  return reference_entry(all, name);
}

}  // namespace

TEST_CASE("nets are the tabulated ones, rounded once", "[surfaces]") {
  WorstCase worst;
  for (const CobbCase& c : cobb_cases) {
    const json expected = cobb_entry(c.name);
    const Surface surface = build_family(c.object);
    const auto& net = std::get<TensorNet>(surface.patches.front());
    REQUIRE(net.m == expected["degree"][0].get<int>());
    REQUIRE(net.n == expected["degree"][1].get<int>());
    double largest = 0.0;
    for (const dvec4& p : net.points) largest = std::max(largest, glm::length(p));
    // z_max itself is rounded: a relative 2^-54 of it moves the radius and with it the net, by up to 1 / (1 -
    // z).
    const double input = std::string(c.name).rfind("cap", 0) == 0 ? 13.0 * 0x1p-54 * largest : 0.0;
    for (int i = 0; i <= net.m; ++i) {
      for (int j = 0; j <= net.n; ++j) {
        for (int d = 0; d < 4; ++d) {
          const Big exact = Big(expected["net"][i][j][d].get<std::string>()) / c.scale;
          const double error = static_cast<double>(abs(exact - Big(net.at(i, j)[d])));
          const double half_ulp =
              0x1p-53 *
              std::max(1e-300,
                       std::exp2(std::floor(std::log2(std::abs(static_cast<double>(exact)) + 1e-300))));
          // Half a unit in the last place, and room for the extended precision that it was computed in.
          worst.add(error, 1.01 * half_ulp + input,
                    [&] { return fmt::format("{} ({}, {}) {}: {}", c.name, i, j, d, error); });
        }
      }
    }
  }
  INFO(worst.text());
  CHECK(worst.count() == 7 * 100 + 36);
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("points and normals are the tabulated ones", "[surfaces]") {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  WorstCase points, normals;
  for (const CobbCase& c : cobb_cases) {
    const json expected = cobb_entry(c.name);
    const Net net = build_family(c.object).patches.front();
    double weight = 0.0;
    for (const dvec4& p : points_of(net)) weight = std::max(weight, std::abs(p.w));
    for (const json& sample : expected["samples"]) {
      const double u = number(sample["u"]), v = number(sample["v"]);
      // Parameters such as 1/3 are rounded too: half an eps times derivatives of at most 10. The homogeneous
      // sum is good to some eps of the largest weight, and is divided by the weight.
      const double w = net_first(net, u, v).value.w;
      const double error = glm::length(net_point(net, u, v) - vector(sample["point"]));
      points.add(error, (5.0 + 4.0 * weight / w) * eps,
                 [&] { return fmt::format("{} ({}, {}): {}", c.name, u, v, error); });
      const double turned = glm::length(unit_normal(net, u, v) - vector(sample["normal"]));
      normals.add(turned, 1e-14, [&] { return fmt::format("{} ({}, {}): {}", c.name, u, v, turned); });
    }
    for (const json& s : expected["singular"]) {
      const double turned =
          glm::length(unit_normal(net, number(s["u"]), number(s["v"])) - vector(s["normal"]));
      normals.add(turned, 1e-14, [&] { return fmt::format("singular corner of {}: {}", c.name, turned); });
    }
  }
  INFO(points.text());
  INFO(normals.text());
  CHECK(points.count() == 8 * 10);
  CHECK(points.failures() == 0);
  CHECK(normals.failures() == 0);
}

}  // namespace rondure
