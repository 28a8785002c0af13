// Images of nets under delta against nets computed exactly, and what scenes get wrong.
#include <fmt/format.h>

#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "renderer/bezier/rational.h"
#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using nlohmann::json;

// "3/8" or decimals.
double number_in(const json& value) {
  if (value.is_number()) return value.get<double>();
  const std::string text = value.get<std::string>();
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return std::stod(text);
  return std::stod(text.substr(0, slash)) / std::stod(text.substr(slash + 1));
}

json numbers(const json& value) {
  if (value.is_string()) return number_in(value);
  json out = value;
  for (json& item : out) item = numbers(item);
  return out;
}

dvec4 point_in(const json& p) { return {number_in(p[0]), number_in(p[1]), number_in(p[2]), number_in(p[3])}; }

// An object with this one net.
std::string object_with(const json& preimage, int m, int n) {
  json patch{{"net", numbers(preimage)}};
  if (preimage.is_array()) {
    patch["degree"] = {m, n};
  } else {
    patch["kind"] = "triangle";
    patch["degree"] = m;
  }
  return json{{"type", "projected_net"}, {"patches", json::array({patch})}}.dump();
}

std::string with_net(const std::string& net) {
  return R"({"type": "projected_net", "patches": [{"degree": [1, 1], "net": )" + net + "}]}";
}

}  // namespace

TEST_CASE("projected nets are those of the reference", "[surfaces]") {
  std::ifstream file(source_folder() + "/tests/data/dhj_nets.json");
  WorstCase worst;
  int nets = 0;
  for (const json& entry : json::parse(file)) {
    if (!entry.contains("preimage")) continue;
    ++nets;
    const Surface surface = build_family(object_with(entry["preimage"], 1, 1));
    REQUIRE(surface.patches.size() == 1);
    const Net& net = surface.patches[0];
    double largest = 0.0;
    for (const dvec4& p : points_of(net)) largest = std::max(largest, glm::length(p));
    const auto check = [&](const dvec4& found, const json& expected, const std::string& where) {
      // The preimage's coordinates and the image's are rounded once each: |p|^2 (2 + 1) half ulps, and as
      // much for the reference.
      worst.add(glm::length(found - point_in(expected)), 8.0 * 0x1p-53 * largest,
                [&] { return entry["name"].get<std::string>() + " " + where; });
    };
    const json& expected = entry["net"];
    if (const auto* t = std::get_if<TensorNet>(&net)) {
      REQUIRE((t->m == 2 && t->n == 2));
      for (int i = 0; i <= 2; ++i) {
        for (int j = 0; j <= 2; ++j) check(t->at(i, j), expected[i][j], fmt::format("({}, {})", i, j));
      }
    } else {
      const auto& triangle = std::get<TriangleNet>(net);
      REQUIRE(triangle.n == 2);
      for (int i = 0; i <= 2; ++i) {
        for (int j = 0; j <= 2 - i; ++j) {
          const std::string key = fmt::format("{}{}{}", i, j, 2 - i - j);
          check(triangle.at(i, j), expected[key], key);
        }
      }
    }
    for (const json& s : entry["samples"]) {
      const dvec3 at(number_in(s["point"][0]), number_in(s["point"][1]), number_in(s["point"][2]));
      worst.add(glm::distance(net_point(net, number_in(s["u"]), number_in(s["v"])), at), 16.0 * 0x1p-52,
                [&] { return entry["name"].get<std::string>() + " sample"; });
    }
  }
  INFO(worst.text());
  CHECK(nets == 6);
  CHECK(worst.failures() == 0);
}

TEST_CASE("nets without an image are refused", "[surfaces]") {
  const auto refused = [](const std::string& text, const std::string& part) {
    const std::string message = family_error(text);
    INFO(text << "\n" << message);
    CHECK(message.find(part) != std::string::npos);
  };
  refused(with_net("[[[0,0,0,0],[1,0,1,0]],[[1,1,0,0],[1,1,1,0]]]"), "base point");
  refused(with_net("[[[1,0,0,0],[1,0,1,0]],[[-1,0,0,0],[1,1,1,0]]]"), "(u, v) = (0.5, ");
  refused(with_net("[[[0,0,0,0],[0,0,0,0]],[[0,0,0,0],[0,0,0,0]]]"), "every control point is zero");
  refused(with_net("[[[0,0,0],[1,0,1,0]],[[1,1,0,0],[1,1,1,0]]]"), "[p0, p1, p2, p3]");
  refused(with_net("[[[-1,0,0,0],[1,0,0,0]],[[-1,0,0,0],[1,0,0,0]]]"), "and perhaps others");
  refused(R"({"type": "projected_net", "patches": []})", "there is no patch");
  refused(R"({"type": "projected_net", "patches": [{"degree": [13, 1], "net": []}]})", "from 1 to 12");
  // A zero control point alone does no harm.
  CHECK(family_error(with_net("[[[1,0,0,0],[1,0,1,0]],[[1,1,0,0],[0,0,0,0]]]")) != "no error");
  CHECK(family_error(R"({"type": "projected_net", "patches": [{"degree": [2, 1], "net":
      [[[1,0,0,0],[1,0,1,0]],[[0,0,0,0],[0,0,0,0]],[[1,1,0,0],[1,1,1,0]]]}]})") == "no error");
}

}  // namespace rondure
