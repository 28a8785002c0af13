// rondure eval --direction: surfaces as functions of direction.
#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "renderer/inverse_spherical/evaluate.h"
#include "renderer/inverse_spherical/octant_model.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/commands/command_files.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

ProcessResult eval_towards(const std::string& folder, const std::string& table) {
  ProcessOptions options;
  options.folder = folder;
  options.input = table;
  return run_rondure({"eval", "scene.json", "--direction", "-"}, options);
}

dvec3 random_direction(NetMaker& make) {
  for (;;) {
    const dvec3 d(make.uniform(-1, 1), make.uniform(-1, 1), make.uniform(-1, 1));
    if (const double length = glm::length(d); length > 0.1 && length < 1.0) return d;
  }
}

dvec3 vector_at(const std::vector<std::string>& fields, std::size_t at) {
  return {number_of(fields[at]), number_of(fields[at + 1]), number_of(fields[at + 2])};
}

}  // namespace

TEST_CASE("eval --direction agrees with equations 20 and 21 on a closed model", "[command][iss]") {
  const dvec3 center(3, -2, 1);
  const std::string folder = folder_with("eval_direction", R"({ "objects": [
    { "type": "iss", "center": [3, -2, 1], "radius": 2, "octants": { "degree": 3,
      "interior": [0.25, 1.75, 1.75, 0.25, 1.75, 0.25, 0.25, 1.75] } },
    { "type": "sphere", "center": [3, -2, 1], "radius": 5 },
    { "type": "sphere_tiling", "topology": "hemispheres", "radius": 0.5 } ] })");
  std::array<std::vector<double>, 8> interior;
  const double given[8] = {0.25, 1.75, 1.75, 0.25, 1.75, 0.25, 0.25, 1.75};
  for (std::size_t o = 0; o < 8; ++o) interior[o].assign(10, given[o]);
  const std::array<PlanarIss, 8> model = octant_model(3, interior);

  // Inside the octants, on their sides and at their corners: some patch has an answer, and only one is given.
  std::vector<dvec3> directions = {{1, 0, 0}, {0, -1, 0}, {0, 0, 3}, {1, 1, 0}, {-2, 0, 1}, {0, 1, -7}};
  NetMaker make(71);
  for (int k = 0; k < 200; ++k) {
    dvec3 d = random_direction(make);
    if (k % 5 == 0) d[k / 5 % 3] = 0.0;
    directions.push_back(d * make.uniform(1e-3, 1e3));
  }
  std::string table = "surface,dx,dy,dz\n";
  for (int surface = 0; surface < 3; ++surface)
    for (const dvec3& d : directions)
      table += fmt::format("{},{:.17g},{:.17g},{:.17g}\n", surface, d.x, d.y, d.z);
  const ProcessResult result = eval_towards(folder, table);
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  const std::vector<std::string> lines = lines_of(result.out);
  REQUIRE(lines.size() == 1 + 3 * directions.size());
  CHECK(lines[0] == "surface,dx,dy,dz,hit,radius,x,y,z,nx,ny,nz,patch,u,v");
  WorstCase worst;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const std::vector<std::string> fields = fields_of(lines[k]);
    REQUIRE(fields.size() == 15);
    const std::size_t surface = (k - 1) / directions.size();
    const dvec3 d = directions[(k - 1) % directions.size()];
    const auto add = [&](const char* what, double error, double tolerance) {
      worst.add(error, tolerance, [&] { return fmt::format("{} {:g} in {}", what, error, lines[k]); });
    };
    double expected = surface == 1 ? 5.0 : 0.5;
    if (surface == 0) {
      std::optional<double> r;
      for (std::size_t o = 0; o < 8 && !r; ++o) r = radius_towards(model[o], d);
      REQUIRE(r.has_value());
      expected = 2.0 * *r;
      const auto patch = static_cast<std::size_t>(number_of(fields[12]));
      add("another patch", radius_towards(model[patch], d) ? 0.0 : 1.0, 0.5);
      const double u = number_of(fields[13]), v = number_of(fields[14]);
      // Patches whose corners turn clockwise had their first two corners swapped, on their way to an outward
      // normal, so that u and v may be exchanged; the third coordinate stays.
      const double h = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
      add("third parameter", std::abs(1.0 - u - v - std::abs(d.z) / h), 1e-15);
    }
    // A few roundings of the table, of t and of the weights' sum, each half an ulp.
    add("radius", std::abs(number_of(fields[5]) / expected - 1.0), 2e-15);
    const dvec3 at = surface == 2 ? dvec3(0.0) : center;
    add("point", glm::distance(vector_at(fields, 6) - at, expected * glm::normalize(d)),
        4e-15 * (expected + 4.0));
    add("normal", glm::dot(vector_at(fields, 9), d) > 0.0 ? 0.0 : 1.0, 0.5);
    if (surface == 2) add("sphere's normal", glm::distance(vector_at(fields, 9), glm::normalize(d)), 1e-6);
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("eval --direction says where there is nothing, and where there is no function", "[command]") {
  const std::string folder = folder_with("eval_direction_errors", R"({ "objects": [
    { "type": "iss" },
    { "type": "sphere_tiling", "topology": "cube", "transform": [ { "translate": [0, 0, 2] } ] },
    { "type": "bezier", "patches": [
        { "kind": "tensor", "degree": [1, 1], "net": [ [ [-1, -1, 1, 1], [-1, 1, 1, 1] ], [ [1, -1, 1, 1], [1, 1, 1, 1] ] ] },
        { "kind": "tensor", "degree": [1, 1], "net": [ [ [-1, -1, 3, 1], [-1, 1, 3, 1] ], [ [1, -1, 3, 1], [1, 1, 3, 1] ] ] } ] },
    { "type": "bezier", "patches": [
        { "kind": "tensor", "degree": [1, 1], "net": [ [ [-1, -1, 0, 1], [-1, 1, 0, 1] ], [ [1, -1, 0, 1], [1, 1, 0, 1] ] ] } ] } ] })");
  const ProcessResult nothing = eval_towards(
      folder, "0,-1,1,1\n1,0,0,-1\n2,1,0,0\n2,0.9,0,1\n1,0,0,-1e-308\n1,0,0,-5e-324\n1,0,0,-1e308\n");
  INFO(nothing.err);
  const std::vector<std::string> lines = lines_of(nothing.out);
  REQUIRE(lines.size() == 8);
  CHECK(lines[1] == "0,-1,1,1,0,,,,,,,,,,");
  // From (0, 0, 2), where the object was moved.
  const std::vector<std::string> down = fields_of(lines[2]);
  CHECK(number_of(down.at(5)) == Approx(1.0).epsilon(1e-15));
  CHECK(glm::distance(vector_at(down, 6), dvec3(0, 0, 1)) < 1e-15);
  CHECK(lines[3] == "2,1,0,0,0,,,,,,,,,,");
  for (std::size_t k = 5; k < 8; ++k)
    CHECK(number_of(fields_of(lines[k]).at(5)) == Approx(1.0).epsilon(1e-15));
  const std::pair<const char*, const char*> cases[] = {
      {"5,1,0,0", "1:1: there is no surface 5: expected an index from 0 to 3"},
      {"0,0,0,0", "1:3: the direction is zero"},
      {"0,1,inf,0", "1:5: a direction must be finite"},
      {"2,0.1,0,1",
       "1:1: surface 2 (bezier) is met 2 times in this direction from its centre, at the distances "
       "1.00499 and 3.01496"},
      {"3,0,0,1",
       "1:1: surface 3 (bezier) is no function of the direction from its centre: patch 0 turns back "
       "near (u, v) = (0.3333, 0.3333)"},
  };
  for (const auto& [row, message] : cases) {
    const ProcessResult wrong = eval_towards(folder, std::string(row) + "\n");
    CHECK(lines_of(wrong.err).at(0) == std::string("rondure: error: standard input:") + message);
    CHECK(wrong.exit_code == 1);
  }
}

}  // namespace rondure
