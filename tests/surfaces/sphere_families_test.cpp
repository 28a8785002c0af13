// What makes the families exact spheres: the quadric's identity, orientation, area, seams.
#include <fmt/format.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "renderer/bezier/bounds.h"
#include "renderer/bezier/rational.h"
#include "tests/bezier/oracle.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

const char* const closed_families[] = {
    R"({"type": "sphere_tiling", "topology": "hemispheres"})",
    R"({"type": "sphere_tiling", "topology": "cube"})",
    R"({"type": "sphere_tiling", "topology": "cube", "middle_weight": 3.5})",
    R"({"type": "sphere_tiling", "topology": "hemispheres", "middle_weight": 0.9})",
    R"({"type": "sphere_octant"})",
    R"({"type": "sphere_tiling", "topology": "octahedron_pairs"})",
    R"({"type": "sphere_tiling", "topology": "tetrahedron_quads"})",
    R"({"type": "sphere_tiling", "topology": "octahedron_quads", "corner_weights": "unit"})",
    R"({"type": "sphere_tiling", "topology": "icosahedron_quads"})"};

// Whose neighbours share edges, but not all their weights.
const char* const other_closed_families[] = {
    R"({"type": "sphere_tiling", "topology": "cube_2_4"})",
    R"({"type": "sphere_tiling", "topology": "icosahedron_pairs"})",
    R"({"type": "sphere_tiling", "topology": "icosahedron_pairs", "corner_weights": "unit"})",
    R"({"type": "sphere_tiling", "topology": "icosahedron_pairs", "middle_weight": 0.5})",
    R"({"type": "sphere_tiling", "topology": "rhombicuboctahedron"})",
    R"({"type": "sphere_tiling", "topology": "rhombicuboctahedron", "reading": 42})"};

std::vector<std::string> all_closed_families() {
  std::vector<std::string> all(std::begin(closed_families), std::end(closed_families));
  all.insert(all.end(), std::begin(other_closed_families), std::end(other_closed_families));
  return all;
}

std::string cap(double z) { return fmt::format(R"({{"type": "sphere_cap", "z_max": {}}})", z); }

constexpr double heights[] = {-0.999, -0.9, -0.6, -0.2, 0.0, 0.1,  0.16,
                              0.17,   0.3,  0.5,  0.75, 0.9, 0.99, 0.9999};

// x^2 + y^2 + z^2 - w^2 of the net as it is, relative to w^2, without rounding.
double off_sphere(const Net& net, double u, double v) {
  const oracle::BigPoint p = oracle::derivative(net, 0, 0, u, v);
  const oracle::Big w2 = p.c[3] * p.c[3];
  const oracle::Big r2 = p.c[0] * p.c[0] + p.c[1] * p.c[1] + p.c[2] * p.c[2];
  // Half of it: the radius is off by this much.
  return static_cast<double>(abs(r2 / w2 - 1) / 2);
}

void check_sphere(const std::string& text, WorstCase& exact, WorstCase& computed, WorstCase& outward) {
  NetMaker make(61);
  const Surface surface = build_family(text);
  for (std::size_t patch = 0; patch < surface.patches.size(); ++patch) {
    const Net& net = surface.patches[patch];
    double weight = 0.0;
    for (const dvec4& p : points_of(net)) weight = std::max(weight, std::abs(p.w));
    const int samples = surface.patches.size() > 8 ? 10 : 40;
    for (int k = 0; k < samples; ++k) {
      const double u = k < 4 ? k % 2 : make.uniform(0.0, 1.0);
      const double v = k < 4 ? k / 2 : make.uniform(0.0, 1.0);
      const double w = net_first(net, u, v).value.w;
      const auto describe = [&] { return fmt::format("{} patch {} at ({}, {})", text, patch, u, v); };
      // Control points are rounded to half an eps each, and the sum weighs up to weight / w of them.
      exact.add(off_sphere(net, u, v), 0x1p-52 * weight / w, describe);
      const dvec3 p = net_point(net, u, v);
      // Evaluation adds the rounding of 4 + 4 basis functions and as many sums.
      computed.add(std::abs(glm::length(p) - 1.0), 4.0 * 0x1p-52 * weight / w, describe);
      outward.add(glm::length(unit_normal(net, u, v) - p), 1e-12, describe);
    }
  }
}

// Nodes and weights of Gauss-Legendre quadrature on [0, 1], six points.
constexpr double nodes[6] = {0.033765242898423986, 0.16939530676686775, 0.38069040695840155,
                             0.61930959304159845,  0.83060469323313225, 0.96623475710157601};
constexpr double weights[6] = {0.085662246189585173, 0.18038078652406930, 0.23395696728634552,
                               0.23395696728634552,  0.18038078652406930, 0.085662246189585173};

double area(const Net& net) {
  constexpr int cells = 12;
  double sum = 0.0;
  for (int i = 0; i < cells * 6; ++i) {
    for (int j = 0; j < cells * 6; ++j) {
      const double u = (i / 6 + nodes[i % 6]) / cells, v = (j / 6 + nodes[j % 6]) / cells;
      const SurfaceJet s = surface_jet(net, u, v);
      sum += weights[i % 6] * weights[j % 6] * glm::length(glm::cross(s.du, s.dv));
    }
  }
  return sum / (cells * cells);
}

using EdgePoints = std::vector<dvec4>;

// The four boundary rows, in the order of counter-clockwise travel in (u, v).
std::vector<EdgePoints> edges(const TensorNet& net) {
  std::vector<EdgePoints> all(4);
  for (int i = 0; i <= net.m; ++i) all[0].push_back(net.at(i, 0));
  for (int j = 0; j <= net.n; ++j) all[1].push_back(net.at(net.m, j));
  for (int i = net.m; i >= 0; --i) all[2].push_back(net.at(i, net.n));
  for (int j = net.n; j >= 0; --j) all[3].push_back(net.at(0, j));
  return all;
}

std::string bytes(const EdgePoints& edge) {
  std::string text(edge.size() * sizeof(dvec4), '\0');
  std::memcpy(text.data(), edge.data(), text.size());
  return text;
}

bool collapsed(const EdgePoints& edge) {
  return glm::length(dvec3(edge.front()) / edge.front().w - dvec3(edge.back()) / edge.back().w) < 1e-6;
}

}  // namespace

TEST_CASE("every family lies on the unit sphere and faces outward", "[surfaces]") {
  WorstCase exact, computed, outward;
  for (const std::string& text : all_closed_families()) check_sphere(text, exact, computed, outward);
  for (const double z : heights) check_sphere(cap(z), exact, computed, outward);
  INFO("net: " << exact.text());
  INFO("evaluation: " << computed.text());
  INFO("normal: " << outward.text());
  CHECK(exact.count() > 1000);
  CHECK(exact.failures() == 0);
  CHECK(computed.failures() == 0);
  CHECK(outward.failures() == 0);
}

TEST_CASE("closed families cover the sphere once", "[surfaces]") {
  for (const std::string& text : all_closed_families()) {
    const Surface surface = build_family(text);
    INFO(text);
    CHECK(surface.closed);
    double total = 0.0;
    for (const Net& net : surface.patches) total += area(net);
    // Six points on a twelfth of the side: the error falls with the 13th power of the size, below 1e-10 here.
    CHECK(std::abs(total - 4.0 * std::numbers::pi) < 1e-9);
  }
}

TEST_CASE("caps have the area and the boundary of their height", "[surfaces]") {
  for (const double z : {-0.9, -0.2, 0.0, 0.3, 0.6}) {
    const Surface surface = build_family(cap(z));
    INFO(z);
    CHECK_FALSE(surface.closed);
    REQUIRE(surface.patches.size() == 1);
    const Net& net = surface.patches.front();
    CHECK(std::abs(area(net) - 2.0 * std::numbers::pi * (1.0 + z)) < 1e-9);
    for (const double t : {0.0, 0.1, 0.5, 0.77, 1.0}) {
      for (const dvec2 at : {dvec2(t, 0.0), dvec2(t, 1.0), dvec2(0.0, t), dvec2(1.0, t)}) {
        // Some eps of evaluation.
        CHECK(std::abs(net_point(net, at.x, at.y).z - z) < 2e-15);
      }
    }
    // Below z_max, not above.
    CHECK(net_point(net, 0.5, 0.5).z == Approx(-1.0));
  }
}

TEST_CASE("the default middle weight keeps every weight of a cap positive", "[surfaces]") {
  int negative = 0;
  for (int k = 1; k < 2000; ++k) {
    const Surface surface = build_family(cap(-1.0 + k / 1000.0));
    for (const dvec4& p : points_of(surface.patches.front())) {
      if (!(p.w > 0.0)) ++negative;
    }
  }
  CHECK(negative == 0);
  // With the paper's weight it would not be so.
  const Surface paper = build_family(R"({"type": "sphere_cap", "z_max": 0.6, "middle_weight": 1})");
  const auto& points = points_of(paper.patches.front());
  CHECK(std::any_of(points.begin(), points.end(), [](const dvec4& p) { return p.w < 0.0; }));
  CHECK(bounds_of(paper.patches.front()).has_value());
}

TEST_CASE("the least middle weight of a cap is what the paper's net falls short of", "[surfaces]") {
  // max(z / (1 - z), sqrt((1 + 4z) / (2 (1 - z)))): 1 at z = 1/6, from where on Table 3 has a weight below 0.
  const auto negative = [](double z, double middle) {
    const Surface surface = build_family(
        fmt::format(R"({{"type": "sphere_cap", "z_max": {:.17g}, "middle_weight": {:.17g}}})", z, middle));
    const auto& points = points_of(surface.patches.front());
    return std::any_of(points.begin(), points.end(), [](const dvec4& p) { return p.w < 0.0; });
  };
  CHECK_FALSE(negative(1.0 / 6 - 1e-6, 1.0));
  CHECK(negative(1.0 / 6 + 1e-6, 1.0));
  for (const double z : {0.2, 0.5, 0.6, 0.85, 0.95, 0.99}) {
    const double least = std::max(z / (1 - z), std::sqrt((1 + 4 * z) / (2 * (1 - z))));
    INFO(z);
    CHECK(negative(z, 0.9999 * least));
    CHECK_FALSE(negative(z, 1.0001 * least));
  }
}

TEST_CASE("neighbours share their edges bit for bit", "[surfaces]") {
  for (const char* text : closed_families) {
    const Surface surface = build_family(text);
    std::map<std::string, int> seen;
    int count = 0;
    for (const Net& net : surface.patches) {
      for (EdgePoints edge : edges(std::get<TensorNet>(net))) {
        if (collapsed(edge)) continue;
        ++count;
        ++seen[bytes(edge)];
        std::reverse(edge.begin(), edge.end());
        --seen[bytes(edge)];
      }
    }
    // Neighbours run through a shared edge in opposite directions, so that every entry cancels.
    int open = 0;
    for (const auto& [edge, balance] : seen) {
      if (balance != 0) ++open;
    }
    INFO(text);
    CHECK(count >= 8);
    CHECK(open == 0);
  }
}

TEST_CASE("octants are chosen by sign bits", "[surfaces]") {
  for (int index = 0; index < 8; ++index) {
    const Surface surface =
        build_family(fmt::format(R"({{"type": "sphere_octant", "octants": [{}]}})", index));
    REQUIRE(surface.patches.size() == 1);
    CHECK_FALSE(surface.closed);
    const dvec3 p = net_point(surface.patches.front(), 0.5, 0.5);
    INFO(index);
    CHECK((p.x < 0.0) == ((index & 1) != 0));
    CHECK((p.y < 0.0) == ((index & 2) != 0));
    CHECK((p.z < 0.0) == ((index & 4) != 0));
  }
  CHECK(build_family(R"({"type": "sphere_octant", "octants": [7, 0, 3]})").patches.size() == 3);
}

}  // namespace rondure
