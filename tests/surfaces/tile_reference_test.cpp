// The nets of the polyhedral tilings, of spherical quadrilaterals and of projected rectangles against nets
// computed independently to 40 digits.
#include <fmt/format.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "tests/catch.h"
#include "tests/reference_data.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using Big = boost::multiprecision::cpp_bin_float_50;
using nlohmann::json;

struct TileCase {
  const char* name;    // in tile_nets.json
  const char* object;  // a surface with that patch
  double scale;        // the reference's net divided by ours
};

const TileCase tile_cases[] = {
    {"icosahedron_pair", R"({"type": "sphere_tiling", "topology": "icosahedron_pairs"})", 1.0},
    {"icosahedron_pair_unit",
     R"({"type": "sphere_tiling", "topology": "icosahedron_pairs", "corner_weights": "unit"})", 1.0},
    {"icosahedron_quad", R"({"type": "sphere_tiling", "topology": "icosahedron_quads"})", 1.0},
    {"octahedron_quad", R"({"type": "sphere_tiling", "topology": "octahedron_quads"})", 1.0},
    {"tetrahedron_quad", R"({"type": "sphere_tiling", "topology": "tetrahedron_quads"})", 1.0},
    {"octahedron_pair", R"({"type": "sphere_tiling", "topology": "octahedron_pairs"})", 1.0},
    {"square_on_axis", R"({"type": "sphere_tiling", "topology": "rhombicuboctahedron"})", 1.0},
    {"square_on_axis", R"({"type": "sphere_tiling", "topology": "rhombicuboctahedron", "reading": 42})", 1.0},
    {"square_between_axes", R"({"type": "sphere_tiling", "topology": "rhombicuboctahedron", "reading": 42})",
     1.0},
    {"half_square", R"({"type": "sphere_tiling", "topology": "rhombicuboctahedron"})", 1.0},
    {"third_of_triangle", R"({"type": "sphere_tiling", "topology": "rhombicuboctahedron"})", 1.0},
    {"stereographic_1", R"({"type": "stereographic_patch"})", 4.0},
    {"stereographic_2", R"({"type": "stereographic_patch", "x": [-2, 2], "y": [-2, 2]})", 4.0},
    {"stereographic_4", R"({"type": "stereographic_patch", "x": [-2, 2], "y": [-2, 2], "plane_z": 0})", 4.0}};

json tile_entry(const std::string& name) {
  static const json all = reference_data("tile_nets.json");
  return reference_entry(all, name);
}

// The net over the square turned by 90 degrees: (u, v) of the result is (v, 1 - u) of the net.
TensorNet turned(const TensorNet& net) {
  TensorNet out(net.n, net.m);
  for (int i = 0; i <= out.m; ++i) {
    for (int j = 0; j <= out.n; ++j) out.at(i, j) = net.at(net.m - j, i);
  }
  return out;
}

// The patch of the surface whose corners are the reference's, turned so that they come in its order.
std::optional<TensorNet> same_patch(const Surface& surface, const json& expected) {
  const int m = expected["degree"][0].get<int>(), n = expected["degree"][1].get<int>();
  for (const Net& patch : surface.patches) {
    auto net = std::get<TensorNet>(patch);
    for (int turn = 0; turn < 4; ++turn, net = turned(net)) {
      double off = 0.0;
      for (const auto& [i, j] : {std::pair(0, 0), std::pair(m, 0), std::pair(m, n), std::pair(0, n)}) {
        const json& p = expected["net"][static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
        const dvec3 corner = vector(p) / number(p[3]);
        off = std::max(off, glm::length(corner - net_point(net, i / m, j / n)));
      }
      if (off < 1e-9) return net;
    }
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("tiles have the reference's nets, rounded once", "[surfaces]") {
  WorstCase worst, points, normals;
  for (const TileCase& c : tile_cases) {
    const json expected = tile_entry(c.name);
    const auto net = same_patch(build_family(c.object), expected);
    INFO(c.name);
    REQUIRE(net.has_value());
    double largest = 0.0;
    for (const dvec4& p : net->points) largest = std::max(largest, glm::length(p));
    for (int i = 0; i <= net->m; ++i) {
      for (int j = 0; j <= net->n; ++j) {
        for (int d = 0; d < 4; ++d) {
          const Big exact = Big(expected["net"][i][j][d].get<std::string>()) / c.scale;
          const double error = static_cast<double>(abs(exact - Big(net->at(i, j)[d])));
          const double size = std::abs(static_cast<double>(exact));
          const double half_ulp = size > 0.0 ? 0x1p-53 * std::exp2(std::floor(std::log2(size))) : 0.0;
          // Half a unit in the last place, and some tens of roundings of extended precision.
          worst.add(error, half_ulp + 0x1p-58 * largest,
                    [&] { return fmt::format("{} ({}, {}) {}: {}", c.name, i, j, d, error); });
        }
      }
    }
    double weight = 0.0;
    for (const dvec4& p : net->points) weight = std::max(weight, std::abs(p.w));
    for (const json& sample : expected["samples"]) {
      const double u = number(sample["u"]), v = number(sample["v"]);
      const double w = net_first(*net, u, v).value.w;
      // As for the other families: the parameters' rounding and that of the homogeneous sum.
      points.add(glm::length(net_point(*net, u, v) - vector(sample["point"])),
                 (5.0 + 4.0 * weight / w) * 0x1p-52,
                 [&] { return fmt::format("{} ({}, {})", c.name, u, v); });
      normals.add(glm::length(unit_normal(*net, u, v) - vector(sample["normal"])), 1e-14 * (1.0 + weight / w),
                  [&] { return fmt::format("{} ({}, {})", c.name, u, v); });
    }
    for (const json& s : expected["singular"]) {
      normals.add(glm::length(unit_normal(*net, number(s["u"]), number(s["v"])) - vector(s["normal"])), 1e-14,
                  [&] { return fmt::format("singular corner of {}", c.name); });
    }
  }
  INFO(worst.text());
  INFO(points.text());
  INFO(normals.text());
  CHECK(worst.count() == 11 * 100 + 3 * 36);
  CHECK(worst.failures() == 0);
  CHECK(points.failures() == 0);
  CHECK(normals.failures() == 0);
}

}  // namespace rondure
