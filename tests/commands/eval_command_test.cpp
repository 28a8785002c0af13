// rondure eval against the unit sphere, where every value is known.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "tests/catch.h"
#include "tests/commands/command_files.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

ProcessResult eval_at(const std::string& folder, const std::string& table) {
  ProcessOptions options;
  options.folder = folder;
  options.input = table;
  return run_rondure({"eval", "scene.json", "--at", "-"}, options);
}

}  // namespace

TEST_CASE("eval gives points, derivatives, normals and curvatures of the sphere", "[command]") {
  const glm::dvec3 center(10.0, -20.0, 30.0);
  constexpr double radius = 2.0;
  const std::string folder = folder_with("eval", R"({ "objects": [
    { "type": "sphere_tiling", "topology": "cube", "center": [10, -20, 30], "radius": 2 },
    { "type": "sphere_tiling", "topology": "hemispheres", "center": [10, -20, 30], "radius": 2 } ] })");
  std::string table;
  int rows = 0;
  for (int surface = 0; surface < 2; ++surface)
    for (int patch = 0; patch < (surface == 0 ? 6 : 2); ++patch)
      for (int i = 0; i <= 8; ++i)
        for (int j = 0; j <= 8; ++j, ++rows)
          table += fmt::format("{},{},{},{}\n", surface, patch, i / 8.0, j / 8.0);
  const ProcessResult result = eval_at(folder, table);
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  const std::vector<std::string> lines = lines_of(result.out);
  REQUIRE(lines.size() == static_cast<std::size_t>(rows) + 1);
  CHECK(
      lines[0] ==
      "surface,patch,u,v,x,y,z,xu,yu,zu,xv,yv,zv,xuu,yuu,zuu,xuv,yuv,zuv,xvv,yvv,zvv,nx,ny,nz,gaussian,mean");

  WorstCase worst;
  int singular = 0;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const std::vector<std::string> fields = fields_of(lines[k]);
    REQUIRE(fields.size() == 27);
    const auto vector_at = [&](std::size_t at) {
      return glm::dvec3(number_of(fields[at]), number_of(fields[at + 1]), number_of(fields[at + 2]));
    };
    const auto add = [&](const char* what, double error, double tolerance) {
      worst.add(error, tolerance, [&] { return fmt::format("{} {:g} in {}", what, error, lines[k]); });
    };
    const glm::dvec3 out = (vector_at(4) - center) / radius, u = vector_at(7), v = vector_at(10),
                     normal = vector_at(22);
    // The centre has coordinates up to 30, half an ulp of which is 1.8e-15, and is taken off again.
    add("radius", std::fabs(glm::length(out) - 1.0), 8e-15);
    add("normal", glm::distance(normal, out), 1e-6);  // what the limit at a singular corner is asked to reach
    // Differentiating p.p = R^2 once and twice; derivatives are of the size of 10 here.
    add("tangent u", std::fabs(glm::dot(out, u)), 1e-12);
    add("tangent v", std::fabs(glm::dot(out, v)), 1e-12);
    add("second uu", std::fabs(glm::dot(out * radius, vector_at(13)) + glm::dot(u, u)), 1e-11);
    add("second uv", std::fabs(glm::dot(out * radius, vector_at(16)) + glm::dot(u, v)), 1e-11);
    add("second vv", std::fabs(glm::dot(out * radius, vector_at(19)) + glm::dot(v, v)), 1e-11);
    const bool corner =
        fields[0] == "1" && (fields[2] == "0" || fields[2] == "1") && (fields[3] == "0" || fields[3] == "1");
    if (corner) {
      ++singular;  // the tangents are parallel and curvature from them means nothing
      continue;
    }
    add("gaussian", std::fabs(number_of(fields[25]) * radius * radius - 1.0), 1e-10);
    add("mean", std::fabs(number_of(fields[26]) * radius + 1.0),
        1e-10);  // negative: the normal points outward
  }
  CHECK(singular == 8);
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

// Weights that are next to nothing are so alike on the whole patch: they are taken to size.
TEST_CASE("eval tells of no number only where there is none", "[command]") {
  const std::string folder = folder_with("eval_nan", R"({ "objects": [
    { "type": "bezier", "patches": [ { "kind": "tensor", "degree": [1, 1],
      "net": [ [ [0, 0, 0, 5e-324], [0, 5e-324, 0, 5e-324] ],
        [ [5e-324, 0, 0, 5e-324], [5e-324, 5e-324, 0, 5e-324] ] ] } ] },
    { "type": "bezier", "patches": [ { "kind": "tensor", "degree": [2, 1],
      "net": [ [ [1, 0, 0, 1], [1, 1, 0, 1] ], [ [-1, 0, 0, 1], [-1, 1, 0, 1] ], [ [1, 0, 0, 1], [1, 1, 0, 1] ] ] } ] } ] })");
  const ProcessResult result = eval_at(folder, "0,0,0.5,0.25\n1,0,0.5,0.25\n");
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  const std::vector<std::string> lines = lines_of(result.out);
  REQUIRE(lines.size() == 3);
  CHECK(lines[1] == "0,0,0.5,0.25,0.5,0.25,0,1,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0,1,0,0");
  CHECK(lines[2].ends_with(",nan,nan"));  // the edge of a fold
  CHECK(lines[2].find("-nan") == std::string::npos);
}

TEST_CASE("eval points at what is wrong with a table", "[command]") {
  const std::string folder = folder_with("eval_errors", R"({ "objects": [
    { "type": "sphere_tiling", "topology": "cube" }, { "type": "sphere" },
    { "type": "bezier", "patches": [ { "kind": "triangle", "degree": 1,
      "net": { "100": [1, 0, 0, 1], "010": [0, 1, 0, 1], "001": [0, 0, 0, 1] } } ] } ] })");
  struct Case {
    std::string row, message;
  };
  const Case cases[] = {
      {"3,0,0.5,0.5", "1:1: there is no surface 3: expected an index from 0 to 2"},
      {"0,6,0.5,0.5", "1:3: there is no patch 6: expected an index from 0 to 5"},
      {"0,0.5,0.5,0.5", "1:3: there is no patch 0.5: expected an index from 0 to 5"},
      {"0,0,-0.1,0.5", "1:5: parameters lie in [0, 1]"},
      {"0,0,0.5,1.5", "1:9: parameters lie in [0, 1]"},
      {"1,0,0.5,0.5", "1:1: surface 1 (sphere) is analytic: it has no patches to evaluate"},
      {"2,0,0.5,0.75", "1:5: on a triangle u + v must not be above 1"},
      {"0,0,0.5", "1:8: expected 4 columns (surface,patch,u,v), found 3"},
      {"0,0,0.5,0.5,1", "1:13: expected 4 columns at most (surface,patch,u,v)"},
  };
  for (const Case& wrong : cases) {
    const ProcessResult result = eval_at(folder, wrong.row + "\n");
    CHECK(lines_of(result.err).at(0) == "rondure: error: standard input:" + wrong.message);
    CHECK(result.exit_code == 1);
  }
  // The triangle's own values: x = u, y = v.
  const ProcessResult flat = eval_at(folder, "2,0,0.25,0.5\n");
  CHECK(lines_of(flat.out).at(1).starts_with("2,0,0.25,0.5,0.25,0.5,0,1,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0,1,"));
}

}  // namespace rondure
