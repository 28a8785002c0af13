// Parts of patches as patches: the tabulated one, points and membership for every pair of kinds, and what is
// refused, with its place.
#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "renderer/bezier/mass_properties.h"
#include "renderer/bezier/planar_domain.h"
#include "renderer/bezier/rational.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/reference_data.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using json = nlohmann::json;

const char* const unit_square = R"({"degree": [1, 1], "net": [[[0, 0], [0, 1]], [[1, 0], [1, 1]]]})";

std::string composed(const std::string& of, const std::string& domain, int patch = 0) {
  return fmt::format(R"({{"type": "composed_patch", "of": {}, "patch": {}, "domain": {}}})", of, patch,
                     domain);
}

// The planar point of a net [x, y, w] read as in a scene, by de Casteljau's algorithm in another arrangement.
dvec2 planar_value(const json& domain, double u, double v) {
  dvec3 sum(0.0);
  const auto point = [](const json& p) {
    return dvec3(p[0].get<double>(), p[1].get<double>(), p.size() == 3 ? p[2].get<double>() : 1.0);
  };
  if (domain.value("kind", "tensor") == "triangle") {
    const int n = domain["degree"];
    for (const auto& [key, p] : domain["net"].items()) {
      const int i = key[0] - '0', j = key[1] - '0', k = key[2] - '0';
      const double c = std::tgamma(n + 1) / (std::tgamma(i + 1) * std::tgamma(j + 1) * std::tgamma(k + 1));
      sum += c * std::pow(u, i) * std::pow(v, j) * std::pow(1 - u - v, k) * point(p);
    }
  } else {
    const int m = domain["degree"][0], n = domain["degree"][1];
    const auto b = [](int d, int k, double t) {
      return std::tgamma(d + 1) / (std::tgamma(k + 1) * std::tgamma(d - k + 1)) * std::pow(t, k) *
             std::pow(1 - t, d - k);
    };
    for (int i = 0; i <= m; ++i) {
      for (int j = 0; j <= n; ++j) sum += b(m, i, u) * b(n, j, v) * point(domain["net"][i][j]);
    }
  }
  return dvec2(sum) / sum.z;
}

}  // namespace

TEST_CASE("a part of the cube's face is the tabulated one", "[surfaces][composed]") {
  const json table = reference_data("cobb_derived.json");
  json domain = {{"degree", {1, 1}}, {"net", json::array()}};
  for (const json& row : table["planar"]) {
    json points = json::array();
    for (const json& p : row) points.push_back({number(p[0]), number(p[1]), number(p[2])});
    domain["net"].push_back(points);
  }
  const Surface surface =
      build_family(composed(R"({"type": "sphere_tiling", "corner_weights": "unit"})", domain.dump()));
  REQUIRE(surface.patches.size() == 1);
  CHECK(!surface.closed);
  const TensorNet& net = std::get<TensorNet>(surface.patches[0]);
  REQUIRE(net.m == 8);
  REQUIRE(net.n == 8);
  const json& expected = table["composed"];
  // A net may have any common factor.
  const double scale = net.at(0, 0).w / expected[0][0][3].get<double>();
  WorstCase worst;
  for (int i = 0; i <= 8; ++i) {
    for (int j = 0; j <= 8; ++j) {
      for (int c = 0; c < 4; ++c) {
        const double error = net.at(i, j)[c] / scale - expected[i][j][c].get<double>();
        // The face's control points, the largest near 5, are rounded: an eps of that, and one more at the
        // end.
        worst.add(std::abs(error), 10 * 0x1p-52,
                  [&] { return fmt::format("({}, {}) {}: {}", i, j, c, error); });
      }
    }
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("composed patches are the whole's points over the domain", "[surfaces][composed]") {
  const std::string tensor = R"({"type": "sphere_cap", "z_max": 0.3})";
  const std::string triangle = R"({"type": "bezier", "patches": [{"kind": "triangle", "degree": 2, "net":
      {"200": [0, 0, 0, 1], "020": [2, 0, 0, 2], "002": [0, 1, 0, 1], "110": [0.6, 0.1, 0.4, 1.2],
       "101": [0, 0.4, 0.3, 0.8], "011": [0.5, 0.6, 0.2, 1]}}]})";
  const std::string square = R"({"degree": [1, 2], "net": [[[0, 0], [0.05, 0.2, 1], [0, 0.5]],
      [[0.5, 0.1], [0.8, 0.5, 2], [0.5, 0.5]]]})";
  const std::string three = R"({"kind": "triangle", "degree": 2, "net": {"200": [0.1, 0.1], "020": [0.6, 0.1],
      "002": [0.2, 0.7], "110": [0.4, 0, 1], "101": [0.1, 0.3, 0.8], "011": [0.45, 0.4]}})";
  WorstCase worst;
  NetMaker make(91);
  for (const auto& [of, degree] : {std::pair(tensor, 8), std::pair(triangle, 2)}) {
    const Net whole = build_family(of).patches[0];
    for (const std::string& domain : {square, three}) {
      const Net part = build_family(composed(of, domain)).patches[0];
      if (const auto* t = std::get_if<TensorNet>(&part)) {
        CHECK(t->m == degree);
        CHECK(t->n == 2 * degree);
      } else {
        CHECK(std::get<TriangleNet>(part).n == 2 * degree);
      }
      for (int k = 0; k < 20; ++k) {
        const dvec2 at = make.in_triangle();
        const dvec2 inner = planar_value(json::parse(domain), at.x, at.y);
        const double error = glm::length(net_point(part, at.x, at.y) - net_point(whole, inner.x, inner.y));
        // Sixteen products deep, over weights that vary tenfold.
        worst.add(error, 2e-14, [&] { return fmt::format("{} of {}: {}", domain, of, error); });
      }
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("parts that tile the domain have the whole's area", "[surfaces][composed]") {
  // A face cut along a diagonal into two triangles, one of them cut again; nested, so that f o g o h is too.
  const std::string face = R"({"type": "sphere_tiling", "topology": "cube"})";
  const std::string lower =
      R"({"kind": "triangle", "degree": 1, "net": {"100": [0, 0], "010": [1, 0], "001": [0, 1]}})";
  const std::string upper =
      R"({"kind": "triangle", "degree": 1, "net": {"100": [1, 1], "010": [0, 1], "001": [1, 0]}})";
  const std::string half =
      R"({"kind": "triangle", "degree": 1, "net": {"100": [1, 0], "010": [0, 0.5], "001": [0, 0]}})";
  const std::string rest =
      R"({"kind": "triangle", "degree": 1, "net": {"100": [1, 0], "010": [0, 1], "001": [0, 0.5]}})";
  double total = 0.0, bound = 0.0;
  for (const std::string& text : {composed(face, lower, 3), composed(composed(face, upper, 3), half),
                                  composed(composed(face, upper, 3), rest)}) {
    const MassProperties mass = mass_properties(build_family(text));
    total += mass.shell.measure;
    bound += mass.shell.measure_error;
  }
  const double sixth = 4 * 3.14159265358979323846 / 6;
  // Nets of degree 8 are off the sphere by some eps.
  CHECK(std::abs(total - sixth) <= bound + 1e-14);
  CHECK(bound < 1e-12);
}

TEST_CASE("what cannot be composed is refused where it stands", "[surfaces][composed]") {
  const std::string cap = R"({"type": "sphere_cap"})";
  const auto refused = [](const std::string& text, const std::string& part) {
    const std::string message = family_error(text);
    INFO(text << "\n" << message);
    CHECK(message.find(part) != std::string::npos);
    CHECK(message.find("object.json:") != std::string::npos);
  };
  CHECK(family_error(composed(cap, unit_square)) == "no error");
  refused(composed(R"({"type": "sphere"})", unit_square), "has no patches to cut from");
  refused(composed(R"({"type": "sphere_cup"})", unit_square), "did you mean \"sphere_cap\"?");
  refused(composed(R"({"type": "sphere_cap", "z_maxx": 0})", unit_square), "did you mean \"z_max\"?");
  refused(composed(R"({"type": "sphere_cap", "z_max": 1})", unit_square),
          "\"z_max\" must be a number in (-1, 0.999999999]");
  refused(composed(cap, unit_square, 1), "\"patch\" must be an integer in [0, 0], found 1");
  refused(composed(cap, R"({"degree": [1, 1], "net": [[[0, 0], [0, 1]], [[1, 0], [1.25, 1]]]})"),
          "\"domain\" reaches (1.25, 1), outside the patch's parameters, [0, 1] x [0, 1]");
  // The corners are inside; the edge is not.
  refused(
      composed(cap,
               R"({"degree": [2, 1], "net": [[[0, 0], [0, 1]], [[0.5, -0.1], [0.5, 1]], [[1, 0], [1, 1]]]})"),
      "outside the patch's parameters");
  refused(composed(R"({"type": "bezier", "patches": [{"kind": "triangle", "degree": 1, "net":
      {"100": [0, 0, 0, 1], "010": [1, 0, 0, 1], "001": [0, 1, 0, 1]}}]})",
                   unit_square),
          "outside the patch's parameters, x, y >= 0, x + y <= 1");
  refused(composed(cap, R"({"degree": [1, 1], "net": [[[0, 0], [0, 1]], [[1, 0], [1, 1, -1]]]})"),
          "the weight of \"domain\" must be positive all over it");
  refused(composed(cap, R"({"degree": [4, 1], "net": [[[0,0],[0,1]],[[0.2,0],[0.2,1]],[[0.5,0],[0.5,1]],
      [[0.7,0],[0.7,1]],[[1,0],[1,1]]]})"),
          "the composed patch has degree (32, 8), and 24 is the most");
  refused(composed(cap, R"({"degree": [1, 1], "net": [[[0, 0, 0, 1], [0, 1]], [[1, 0], [1, 1]]]})"),
          "a control point is an array of two or three numbers, [u, v] or [w u, w v, w]");
  // A control point outside alone is no fault: here the curve only touches the edge of the square.
  CHECK(family_error(composed(cap, R"({"degree": [2, 1], "net": [[[0, 0.1], [0, 1]], [[0.5, -0.1], [0.5, 1]],
      [[1, 0.1], [1, 1]]]})")) == "no error");
  // All weights negative: the same points.
  CHECK(family_error(composed(cap, R"({"degree": [1, 1], "net": [[[0, 0, -1], [0, -1, -1]], [[-1, 0, -1],
      [-1, -1, -1]]]})")) == "no error");
}

}  // namespace rondure
