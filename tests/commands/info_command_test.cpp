// rondure info as a user meets it: what a scene holds, and how much.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/catch.h"
#include "tests/commands/command_files.h"

namespace rondure {
namespace {

using json = nlohmann::json;
constexpr double pi = std::numbers::pi;

ProcessResult info(const std::string& folder, std::vector<std::string> arguments = {}) {
  arguments.insert(arguments.begin(), {"info", "scene.json"});
  ProcessOptions options;
  options.folder = folder;
  return run_rondure(arguments, options);
}

}  // namespace

TEST_CASE("info tells area, volume, centroid and inertia with their errors", "[command][mass]") {
  const std::string folder = folder_with("info", R"({ "objects": [
    { "type": "sphere_tiling", "topology": "cube", "radius": 2, "center": [1, 2, 3] },
    { "type": "sphere", "radius": 2 },
    { "type": "sphere_cap", "z_max": 0 },
    { "type": "bezier", "closed": true, "patches": [
      { "kind": "tensor", "degree": [1, 1], "net": [[[0,0,0,1],[0,1,0,1]],[[1,0,0,1],[1,1,0,1]]] } ] } ] })");
  const ProcessResult result = info(folder, {"--json"});
  CHECK(result.err.empty());
  REQUIRE(result.exit_code == 0);
  const json objects = json::parse(result.out)["objects"];
  for (int k = 0; k < 2; ++k) {
    const json& ball = objects[static_cast<std::size_t>(k)];
    INFO(ball.dump());
    CHECK(std::abs(ball["area"].get<double>() - 16 * pi) <= ball["area_error"].get<double>());
    CHECK(std::abs(ball["volume"].get<double>() - 32 * pi / 3) <= ball["volume_error"].get<double>());
    CHECK(ball["area_error"].get<double>() < 1e-12 * 16 * pi);
    CHECK(ball["volume_error"].get<double>() < 1e-12 * 32 * pi / 3);
    CHECK(ball["body"]["of"] == "solid");
    for (std::size_t c = 0; c < 3; ++c) {
      // The centroid is in world coordinates.
      CHECK(std::abs(ball["body"]["centroid"][c].get<double>() -
                     (k == 0 ? 1.0 + static_cast<double>(c) : 0.0)) < 1e-14);
      CHECK(std::abs(ball["body"]["inertia"][c][c].get<double>() - 0.4 * 32 * pi / 3 * 4) < 1e-12);
    }
  }
  CHECK(objects[2]["volume"].is_null());
  CHECK(objects[2]["why_no_volume"] == "volume needs a closed surface");
  CHECK(std::abs(objects[2]["area"].get<double>() - 2 * pi) <= objects[2]["area_error"].get<double>());
  CHECK(objects[2]["body"]["of"] == "shell");
  CHECK(std::abs(objects[2]["body"]["centroid"][2].get<double>() + 0.5) < 1e-12);
  CHECK(objects[3]["volume"].is_null());
  CHECK(objects[3]["area"] == 1.0);
  CHECK(objects[3]["why_no_volume"] == "the normals of its patches do not add up to zero: it is not closed");
}

TEST_CASE("info --certify proves regularity and singular points in exact arithmetic", "[command]") {
  const std::string folder = folder_with("certify", R"({ "objects": [
    { "type": "gc_octahedron", "basis": "rational" },
    { "type": "gc_octahedron", "control_points": { "h6": [-2, 1, 0], "h5": [0, 0, 0], "h7": [1, -2, -1] } },
    { "type": "sphere_cap", "z_max": 0 } ] })");
  const ProcessResult result = info(folder, {"--json", "--no-mass", "--certify"});
  CHECK(result.err.empty());
  REQUIRE(result.exit_code == 0);
  const json objects = json::parse(result.out)["objects"];
  const json &regular = objects[0]["certificate"], &singular = objects[1]["certificate"];
  CHECK(objects[0]["notes"]["rounded"]["value"] == 0.0);
  CHECK(regular["verdict"] == "regular");
  CHECK(regular["least"].get<double>() >= 0.499 * objects[0]["regularity"]["least_found"].get<double>());
  CHECK(regular["pieces"] > 50);
  CHECK(singular["verdict"] == "singular");
  REQUIRE(singular["singular"].size() == 2);
  CHECK(singular["singular"][0]["patch"] == 2);
  CHECK(singular["singular"][1]["within"] < 1e-12);
  // The corners of a hemisphere are singular but for rounding: neither is proved, and the places are told.
  const json& corners = objects[2]["certificate"];
  CHECK(corners["verdict"] != "regular");
  CHECK(corners["singular"].size() + corners["undecided"].size() >= 4);
  const ProcessResult text = info(folder, {"--no-mass", "--certify"});
  CHECK(text.out.find("in exact arithmetic: regular, |Su x Sv| is at least") != std::string::npos);
  CHECK(text.out.find("in exact arithmetic: singular, proved at 2 points") != std::string::npos);
  const ProcessResult both = info(folder, {"--no-continuity", "--certify"});
  CHECK(both.exit_code == 1);
}

TEST_CASE("info without --json is text, and the mass may be left out", "[command][mass]") {
  const std::string folder = folder_with("info_text");
  const std::string text = info(folder).out;
  CHECK(text.find("    area 12.56637061435917 +- ") != std::string::npos);
  CHECK(text.find(", volume 4.18879020478639") != std::string::npos);
  CHECK(text.find("    solid: centroid (0, 0, 0) +- ") != std::string::npos);
  CHECK(text.find("    solid: inertia about its centroid, density 1: (1.67551608191, 0, 0) "
                  "(0, 1.67551608191, 0) (0, 0, 1.67551608191) +- ") != std::string::npos);
  const std::string less = info(folder, {"--no-mass"}).out;
  CHECK(less.find("6 patches") != std::string::npos);
  CHECK(less.find("area") == std::string::npos);
  CHECK(info(folder, {"--no-mass", "--json"}).out.find("inertia") == std::string::npos);
}

TEST_CASE("info tells how patches meet and where they are singular", "[command][continuity]") {
  const std::string folder = folder_with("info_continuity", R"({ "objects": [
    { "type": "gc_octahedron", "control_points": { "h6": [-2, 1, 0], "h5": [0, 0, 0], "h7": [1, -2, -1] } },
    { "type": "gc_octahedron", "basis": "rational" }, { "type": "sphere" } ] })");
  const json objects = json::parse(info(folder, {"--json", "--no-mass"}).out)["objects"];
  CHECK(objects[0]["continuity"]["seams"] == 12);
  CHECK(objects[0]["continuity"]["open_sides"] == 0);
  CHECK(objects[0]["continuity"]["tangent_degrees"]["worst"].get<double>() < 1e-10);
  CHECK(objects[0]["regularity"]["verdict"] == "singular");
  CHECK(objects[0]["regularity"]["singular"].size() == 2);
  CHECK(objects[0]["regularity"]["complete"] == true);
  CHECK(objects[0]["regularity"]["singular"][0]["proof"] == "unique");
  CHECK(objects[0]["regularity"]["singular"][0]["within"].get<double>() < 1e-11);
  CHECK(objects[0]["regularity"]["least_certified"].is_null());
  CHECK(objects[1]["regularity"]["verdict"] == "regular");
  CHECK(objects[1]["regularity"]["least_certified"].get<double>() > 0.0);
  CHECK_FALSE(objects[2].contains("regularity"));
  const std::string text = info(folder, {"--no-mass"}).out;
  CHECK(text.find("    12 seams, 0 open sides; the worst of 33 places on each seam and of peaks between:\n   "
                  "   tangent planes "
                  "differ by ") != std::string::npos);
  CHECK(text.find("    singular: Su x Sv vanishes at 2 points, and nowhere else\n      patch 2 at "
                  "(u, v) = (0.447842876926, "
                  "0.142384548227), (") != std::string::npos);
  CHECK(text.find("    regular: |Su x Sv| is at least ") != std::string::npos);
  const std::string less = info(folder, {"--no-mass", "--no-continuity"}).out;
  CHECK(less.find("seams") == std::string::npos);
  CHECK(less.find("regular") == std::string::npos);
}

TEST_CASE("info tells what a construction has to tell", "[command]") {
  const std::string folder = folder_with("info_notes", R"({ "objects": [
    { "type": "curve", "interpolate": [[0,0,-1], [1,2,-2], [6,2,3], [1,4,8], [-2,1,2]] },
    { "type": "gc_complex", "complex": "cube" }, { "type": "sphere" } ] })");
  const ProcessResult text = info(folder, {"--no-mass", "--no-continuity"});
  CHECK(text.out.find("    condition 0.") != std::string::npos);
  CHECK(text.out.find("    dimension 24: of the space") != std::string::npos);
  const json objects = json::parse(info(folder, {"--no-mass", "--no-continuity", "--json"}).out)["objects"];
  CHECK(objects[0]["notes"]["condition"]["value"].get<double>() > 1e-4);
  CHECK(objects[1]["notes"]["dimension"]["value"].get<double>() == 24);
  CHECK_FALSE(objects[2].contains("notes"));
}

}  // namespace rondure
