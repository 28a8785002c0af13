// What objects draw: surfaces, control surfaces, and wires that are round where they stand.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/plugin/builtin.h"
#include "renderer/scene/scene_reader.h"
#include "renderer/scene/wires.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/scene/messages.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

Scene scene_of(const std::string& objects, const std::string& materials = "{}") {
  Registry registry;
  register_builtins(registry);
  return read_scene_text("s.json", R"({"materials": )" + materials + R"(, "objects": [)" + objects + "]}",
                         registry);
}

const Surface& surface_of(const Scene& scene, std::size_t index) {
  return scene.objects.at(index).traced.surface;
}

std::size_t patches_of(const std::string& object) {
  const Scene scene = scene_of(object);
  REQUIRE(scene.objects.size() == 1);
  return surface_of(scene, 0).patches.size();
}

const std::string square_object =
    R"({"type": "bezier", "patches": [{"kind": "tensor", "degree": [1, 1],
        "net": [[[0,0,0,1],[0,1,0,1]],[[1,0,0,1],[1,1,0,1]]]}], )";

}  // namespace

TEST_CASE("wires stand in their own object after the scene's objects", "[scene]") {
  const std::string materials = R"({"red": {"type": "diffuse", "albedo": [0.8, 0, 0]},
                                    "black": {"type": "diffuse", "albedo": 0.05}})";
  const Scene scene = scene_of(R"({"type": "sphere_tiling", "show": ["surface", "net"], "material": "red"},
                                  {"type": "sphere", "name": "plain"},
                                  {"type": "sphere_octant", "show": ["boundary"], "material": "red"},
                                  {"type": "sphere_cap", "show": ["isolines", "surface"], "material": "black"},
                                  {"type": "sphere_cap", "show": ["surface", "net"], "wire_material": "red"},
                                  {"type": "sphere_cap", "show": ["net"], "wire_material": "black"})",
                               materials);
  REQUIRE(scene.objects.size() == 6 + 3);
  const char* names[] = {"objects[0]",       "plain",      "objects[2]",        "objects[3]",
                         "objects[4]",       "objects[5]", "objects[0], wires", "objects[3], wires",
                         "objects[4], wires"};
  for (std::size_t k = 0; k < 9; ++k) CHECK(scene.objects[k].name == names[k]);
  const auto tone = [&](std::size_t k) {
    return std::get<Diffuse>(
               scene.materials.at(static_cast<std::size_t>(scene.objects[k].material)).scattering)
        .albedo;
  };
  CHECK(tone(0) == dvec3(0.8, 0, 0));
  CHECK(tone(2) == dvec3(0.8, 0, 0));  // wires alone
  CHECK(tone(4) == dvec3(0.5));
  CHECK(tone(5) == dvec3(0.05));
  CHECK(tone(6) == dvec3(0.03));  // on red
  CHECK(tone(7) == dvec3(0.85));  // on black
  CHECK(tone(8) == dvec3(0.8, 0, 0));
  CHECK(surface_of(scene, 0).closed);
  CHECK_FALSE(surface_of(scene, 6).closed);
}

TEST_CASE("each line and each ball is drawn once", "[scene]") {
  // Twelve edges of a cube on circles of 70.5 degrees, exact, and eight balls of six patches.
  CHECK(patches_of(R"({"type": "sphere_tiling", "topology": "cube_2_4", "show": ["boundary"]})") ==
        12 * 3 + 8 * 6);
  CHECK(patches_of(R"({"type": "sphere_tiling", "topology": "cube", "show": ["boundary"]})") ==
        12 * 3 + 8 * 6);
  // The pole is a point, not a curve: four meridians, the equator in four.
  CHECK(patches_of(R"({"type": "sphere_octant", "show": ["boundary"]})") >= 3 * 3 + 3 * 6);
  CHECK(patches_of(square_object + R"("show": ["net"]})") == 4 * 3 + 4 * 6);
  CHECK(patches_of(square_object + R"("show": ["boundary"]})") == 4 * 3 + 4 * 6);
  CHECK(patches_of(square_object + R"("show": ["net", "boundary"]})") == 4 * 3 + 4 * 6);
  CHECK(patches_of(square_object + R"("show": ["isolines"], "isolines": 3})") == 4 * 3 + 8 * 6);
  CHECK(patches_of(square_object + R"("show": ["isolines", "boundary"], "isolines": 3})") == 8 * 3 + 4 * 6);
  CHECK(patches_of(square_object + R"("show": ["control_surface"]})") == 1);
  CHECK(scene_of(square_object + R"("show": ["surface", "isolines"], "isolines": 1})").objects.size() == 1);
  // A cubic triangle: 18 legs, 10 points, 9 flat triangles; three sides, straight or on great circles.
  CHECK(patches_of(R"({"type": "iss", "show": ["net"]})") == 18 * 3 + 10 * 6);
  CHECK(patches_of(R"({"type": "iss", "show": ["control_surface"]})") == 9);
  CHECK(patches_of(R"({"type": "iss", "show": ["control_surface", "surface"]})") == 10);
  CHECK(patches_of(R"({"type": "iss", "show": ["domain"]})") == 3 * 3 + 3 * 6);
  CHECK(patches_of(R"({"type": "iss", "show": ["spherical_triangle"]})") == 3 * 3 + 3 * 6);
  const std::string bent =
      R"({"type": "curve", "net": [[0,0,0,1],[1,0,0,1],[1,1,0,0],[0,1,0,1],[0,2,1,1]], )";
  CHECK(patches_of(bent + R"("show": ["net"]})") == 2 * 3 + 4 * 6);  // no leg to the point at infinity
  CHECK(scene_of(bent + R"("show": ["net", "surface"]})").objects.size() == 2);
}

TEST_CASE("wires are round and of their radius wherever the object stands", "[scene]") {
  NetMaker make(331);
  WorstCase worst;
  // The nearest of the points that lie at the radius from one of the lines or their ends.
  const auto check = [&](const std::string& object,
                         const std::function<std::vector<double>(const dvec3&)>& distances) {
    const Scene scene = scene_of(object);
    const Surface& wires = surface_of(scene, 0);
    for (std::size_t k = 0; k < wires.patches.size(); ++k) {
      const dvec3 p =
          wires.origin + net_point(wires.patches[k], make.uniform(0.0, 1.0), make.uniform(0.0, 1.0));
      double off = INFINITY;
      for (const double distance : distances(p)) off = std::min(off, std::abs(distance - 0.02));
      worst.add(off, 1e-13, [&] { return fmt::format("{} patch {}", object, k); });
    }
  };
  // The square's sides, scaled unevenly and moved: cylinders between the images of their ends.
  check(square_object + R"("show": ["boundary"], "wire": 0.02, "radius": 3, "center": [5, 6, 7],
                    "transform": [{"scale": [1, 2, 4]}]})",
        [](const dvec3& p) {
          const dvec3 c[4] = {{5, 12, 28}, {8, 12, 28}, {8, 18, 28}, {5, 18, 28}};
          std::vector<double> distances;
          for (int k = 0; k < 4; ++k) {
            const dvec3 along = glm::normalize(c[(k + 1) % 4] - c[k]);
            distances.push_back(glm::distance(p, c[k]));
            distances.push_back(glm::length(glm::cross(p - c[k], along)));
          }
          return distances;
        });
  // The sides of an octant of radius 3: quarters of great circles.
  check(R"({"type": "sphere_octant", "octants": [0], "show": ["boundary"], "wire": 0.02, "radius": 3,
            "center": [1, 2, 3]})",
        [](const dvec3& p) {
          const dvec3 q = p - dvec3(1, 2, 3);
          std::vector<double> distances;
          for (int axis = 0; axis < 3; ++axis) {
            dvec3 flat = q, corner(0.0);
            flat[axis] = 0.0, corner[axis] = 3.0;
            distances.push_back(glm::distance(q, corner));
            distances.push_back(glm::distance(q, 3.0 * glm::normalize(flat)));
          }
          return distances;
        });
  INFO(worst.text());
  CHECK(worst.count() > 60);
  CHECK(worst.failures() == 0);
}

TEST_CASE("wires keep to the lines of the surface", "[scene]") {
  // Parameter lines of Cobb's cube are no circles: their tubes are within a thousandth of the radius, and the
  // lines lie on the sphere.
  NetMaker make(332);
  WorstCase worst;
  const Scene scene =
      scene_of(R"({"type": "sphere_tiling", "show": ["isolines"], "isolines": 3, "wire": 0.01})");
  for (const Net& net : surface_of(scene, 0).patches) {
    const dvec3 p = net_point(net, make.uniform(0.0, 1.0), make.uniform(0.0, 1.0));
    const double off = std::abs(glm::length(p) - 1.0);
    worst.add(off, 0.01 * 1.001, [&] { return fmt::format("({}, {}, {})", p.x, p.y, p.z); });
  }
  INFO(worst.text());
  CHECK(worst.count() > 500);
  CHECK(worst.failures() == 0);
}

TEST_CASE("a curve that is one point leaves a ball", "[scene]") {
  Wires wires(0.1);
  wires.add({dvec4(1, 2, 3, 1), dvec4(2, 4, 6, 2)}, 1.0);
  wires.add_ball(dvec3(1, 2, 3), 2.0);
  REQUIRE(wires.nets().size() == 6);
  CHECK(glm::distance(net_point(wires.nets()[0], 0.3, 0.3), dvec3(1, 2, 3)) == Approx(0.2).epsilon(1e-14));
}

TEST_CASE("what cannot be shown is said", "[scene]") {
  const auto says = [](const std::string& object) {
    return first_line(message_of([&] { scene_of(object); }));
  };
  CHECK_THAT(says(R"({"type": "sphere_cap", "show": []})"),
             Catch::Contains("\"show\" must be an array of names"));
  CHECK_THAT(says(R"({"type": "sphere_cap", "show": ["nets"]})"),
             Catch::EndsWith(
                 "\"show\" names surface, control_surface, net, boundary, isolines; did you mean \"net\"?"));
  CHECK_THAT(says(R"({"type": "iss", "show": ["spherical triangle"]})"),
             Catch::EndsWith("domain, spherical_triangle; did you mean \"spherical_triangle\"?"));
  CHECK_THAT(says(R"({"type": "sphere_cap", "show": ["net", "net"]})"),
             Catch::EndsWith("\"net\" is listed twice"));
  CHECK_THAT(says(R"({"type": "sphere_cap", "wire": 0})"),
             Catch::Contains("\"wire\" must be a number greater than 0"));
  CHECK_THAT(says(R"({"type": "sphere_cap", "isolines": 101})"), Catch::Contains("\"isolines\" must be"));
  CHECK_THAT(says(R"({"type": "sphere_cap", "wire_material": "rde"})"),
             Catch::Contains("unknown material \"rde\""));
  CHECK_THAT(says(R"({"type": "sphere_tiling", "show": ["isolines"], "wire": 1e-12})"),
             Catch::EndsWith("the tube is too thin for the size of the curve"));
  CHECK_THAT(says(R"({"type": "sphere_tiling", "show": ["net"], "wire": 1e-12})"),
             Catch::EndsWith("the tube is too thin for the size of the curve"));
  CHECK_THAT(says(R"({"type": "sphere_tiling", "topology": "icosahedron_quads", "show": ["isolines"],
                      "isolines": 100, "wire": 1e-4})"),
             Catch::Contains("more than 300000 patches"));
  CHECK_THAT(says(R"({"type": "sphere", "show": ["surface", "net"]})"),
             Catch::Contains("s.json:1:") && Catch::Contains("no patches, and so no lines or nets"));
  CHECK_THAT(says(R"({"type": "iss", "patches": [{"sphere": [0,1,2]}], "show": ["domain"]})"),
             Catch::EndsWith("there is nothing to show of \"domain\" here"));
  CHECK_THAT(says(square_object + R"("show": ["isolines"], "isolines": 1})"),
             Catch::EndsWith("there is nothing to show of \"isolines\" here"));
  CHECK_THAT(says(R"({"type": "bezier", "show": ["boundary"], "patches": [{"kind": "tensor", "degree": [1, 1],
        "net": [[[0,0,0,1],[0,1,0,1]],[[1,0,0,-1],[1,1,0,1]]]}]})"),
             Catch::EndsWith("a line of \"boundary\" reaches infinity"));
}

}  // namespace rondure
