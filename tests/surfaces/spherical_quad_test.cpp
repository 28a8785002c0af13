// spherical_quad and stereographic_patch: what they build, and what each mistake says.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

const std::string face = "[[1, -1, -1], [1, 1, -1], [1, 1, 1], [1, -1, 1]]";

std::string quad_text(const std::string& corners, const std::string& rest = "") {
  return R"({"type": "spherical_quad", "corners": )" + corners + (rest.empty() ? "" : ", " + rest) + "}";
}

Net net_of(const std::string& text) { return build_family(text).patches.front(); }

}  // namespace

TEST_CASE("a face of the cube is a spherical quad", "[surfaces]") {
  const Net cube = build_family(R"({"type": "sphere_tiling"})").patches[2];  // about +x
  for (const char* weights : {R"("corner_weights": "unit")", R"("corner_weights": "matched")"}) {
    const Net net = net_of(quad_text(face, weights));
    WorstCase worst;
    for (int i = 0; i <= 4; ++i) {
      for (int j = 0; j <= 4; ++j) {
        // The cube's face starts at another corner; by symmetry its parameters are turned or not alike.
        const dvec3 p = net_point(net, i / 4.0, j / 4.0);
        double nearest = 2.0;
        for (const dvec2 at : {dvec2(i, j), dvec2(j, 4 - i), dvec2(4 - i, 4 - j), dvec2(4 - j, i)})
          nearest = std::min(nearest, glm::length(p - net_point(cube, at.x / 4.0, at.y / 4.0)));
        worst.add(nearest, 8 * 0x1p-52, [&] { return fmt::format("({}, {})", i, j); });
      }
    }
    INFO(worst.text());
    CHECK(worst.failures() == 0);
  }
  CHECK_FALSE(build_family(quad_text(face)).closed);
}

TEST_CASE("arcs pass through their points and stay in their planes", "[surfaces]") {
  // Three great circles, and above the plane x - z = 1 / sqrt(6), which bulges upward.
  const std::string corners = "[[2, -1, 0], [2, 1, 0], [2, 1, 1], [2, -1, 1]]";
  const double offset = 1 / std::sqrt(6.0), reach = std::sqrt(11.0 / 24.0);
  const std::string by_plane = quad_text(
      corners, fmt::format(R"("arcs": [null, null, {{"plane": [3, 0, -3, {:.17g}]}}, null])", 3 * offset));
  const std::string by_point =
      quad_text(corners, fmt::format(R"("arcs": [null, null, {{"through": [{:.17g}, 0, {:.17g}]}}, null])",
                                     reach + offset / 2, reach - offset / 2));
  WorstCase worst;
  for (const std::string& text : {by_plane, by_point}) {
    const Net net = net_of(text);
    for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      const auto describe = [&] { return fmt::format("{} at {}", text, t); };
      worst.add(std::abs(net_point(net, t, 1.0).x - net_point(net, t, 1.0).z - offset), 8 * 0x1p-52,
                describe);
      worst.add(std::abs(net_point(net, t, 0.0).z), 4 * 0x1p-52, describe);
      worst.add(std::abs(net_point(net, 1.0, t).x - 2 * net_point(net, 1.0, t).y), 8 * 0x1p-52, describe);
      worst.add(std::abs(glm::length(net_point(net, t, 0.3)) - 1.0), 4 * 0x1p-52, describe);
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("a quad that has no convex image is refused with its angle", "[surfaces]") {
  CHECK(complaint(quad_text("[[1, -1, -1], [1, -1, 1], [1, 1, 1], [1, 1, -1]]")) ==
        "corners[0] has an interior angle of 240 degrees; with more than 180 no image in a plane is convex "
        "(corners are listed counter-clockwise, seen from outside)");
  // Two triangles of a tetrahedron.
  CHECK(complaint(quad_text("[[1, 1, 1], [-1, 1, -1], [1, -1, -1], [-1, -1, 1]]"))
            .find("has an interior angle of 240 degrees") != std::string::npos);
  CHECK(complaint(R"({"type": "sphere_tiling", "topology": "tetrahedron_pairs"})") ==
        "this division has a quadrilateral without a patch: corners[1] has an interior angle of 240 degrees; "
        "with more than 180 no image in a plane is convex (Cobb 1988, section 7)");
  CHECK(complaint(quad_text("[[0, 0, -1], [0, 1, 0], [0, 0, 1], [1, 0, 0]]")) ==
        "corners[1] has an interior angle of 180 degrees, where the patch would be singular; it must be less "
        "than 180");
  CHECK(
      complaint(quad_text(face, R"("projection_center": [0, 0, -1])")) ==
      "arcs[0], from corners[0] to corners[1], bends inward by 30 degrees in the plane, so that the image is "
      "not convex (about this projection_center)");
  // Between two parallels and two meridians: one of the parallels bends inward, about any centre.
  for (const double bottom : {0.0, 0.3}) {
    const double low = std::sqrt(1 - bottom * bottom), top = 0.7, high = std::sqrt(1 - top * top);
    const auto corner = [](double radius, double y, double z) {
      return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", radius * std::sqrt(0.75), radius * y, z);
    };
    const std::string rectangle =
        fmt::format("[{}, {}, {}, {}]", corner(low, -0.5, bottom), corner(low, 0.5, bottom),
                    corner(high, 0.5, top), corner(high, -0.5, top));
    const std::string arcs = fmt::format(
        R"("arcs": [{{"plane": [0, 0, 1, {:.17g}]}}, null, {{"plane": [0, 0, 1, {:.17g}]}}, null])", bottom,
        top);
    for (const char* centre :
         {"", R"(, "projection_center": [1, 0, 0])", R"(, "projection_center": [1, 0, 1])"}) {
      const std::string said = complaint(quad_text(rectangle, arcs + centre));
      INFO(said);
      CHECK(said.find(" bends inward by ") != std::string::npos);
    }
  }
}

TEST_CASE("each mistake in a quad has its message", "[surfaces]") {
  CHECK(complaint(R"({"type": "spherical_quad"})") ==
        "the object: \"corners\" is missing; it must be an array of four directions, [x, y, z] each");
  CHECK(complaint(quad_text("[[1, 0, 0]]")) ==
        "\"corners\" must be an array of four directions, [x, y, z] each");
  CHECK(complaint(quad_text("[[1, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]")) ==
        "corners[0] must be a direction, an array of three numbers");
  CHECK(complaint(quad_text("[[0, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]")) ==
        "corners[0] is a direction and must not be zero");
  CHECK(complaint(quad_text("[[1, 0, 0], [2, 0, 0], [0, 0, 1], [1, 1, 1]]")) ==
        "corners[0] and corners[1] are the same point");
  CHECK(
      complaint(quad_text("[[1, 0, 0], [-1, 0, 0], [0, 0, 1], [0, -1, 1]]")) ==
      "corners[0] and corners[1] are opposite, so that many great circles pass through both: give arcs[0] a "
      "point \"through\" which it passes");
  CHECK(complaint(quad_text(face, R"("arcs": [null])")) == "\"arcs\" must be an array of four arcs");
  CHECK(complaint(quad_text(face, R"("arcs": [null, 3, null, null])")) ==
        "arcs[1] must be null for a great circle, { \"through\": [x, y, z] } or { \"plane\": [a, b, c, d] }");
  CHECK(complaint(quad_text(face, R"("arcs": [null, {}, null, null])")) ==
        "arcs[1]: give either \"through\" or \"plane\"");
  CHECK(complaint(quad_text(face, R"("arcs": [null, {"trough": [1, 0, 0]}, null, null])")).find("through") !=
        std::string::npos);
  CHECK(complaint(quad_text(face, R"("arcs": [null, {"through": [1, 1, 1]}, null, null])")) ==
        "the point through which arcs[1] passes must not be one of its corners");
  CHECK(complaint(quad_text(face, R"("arcs": [null, {"plane": [1, 1, 1]}, null, null])")) ==
        "\"plane\" must be [a, b, c, d] for the plane a x + b y + c z = d");
  CHECK(complaint(quad_text(face, R"("arcs": [null, {"plane": [0, 0, 0, 1]}, null, null])")) ==
        "the plane's normal must not be zero");
  CHECK(complaint(quad_text(face, R"("arcs": [null, {"plane": [1, 0, 0, 0.5]}, null, null])")) ==
        "the plane of arcs[1] must contain both corners; it misses one by 0.0774");
  CHECK(complaint(quad_text(face, R"("projection_center": [0, 0, 0])")) ==
        "\"projection_center\" is a direction and must not be zero");
  CHECK(complaint(quad_text(face, R"("projection_center": [-1, -1, -1])")) ==
        "corners[2] lies where one projects from, opposite the centre");
  CHECK(complaint(quad_text(face, R"("corner_weights": "unity")")).find("did you mean \"unit\"?") !=
        std::string::npos);
}

TEST_CASE("projected rectangles lie on the sphere for every plane", "[surfaces]") {
  NetMaker make(9);
  WorstCase sphere, place;
  for (int k = 0; k < 200; ++k) {
    const double plane = k == 0 ? 2.0 : make.uniform(-3.0, 3.0), d = 1.0 - plane;
    const double x0 = make.uniform(-3.0, 3.0), x1 = x0 + make.uniform(0.1, 3.0), y0 = make.uniform(-3.0, 3.0),
                 y1 = y0 + make.uniform(0.1, 3.0);
    const std::string text = fmt::format(
        R"({{"type": "stereographic_patch", "x": [{:.17g}, {:.17g}], "y": [{:.17g}, {:.17g}], "plane_z": {:.17g}}})",
        x0, x1, y0, y1, plane);
    if (std::abs(d) < 0.2) continue;
    const Net net = net_of(text);
    double weight = 0.0;
    for (const dvec4& p : points_of(net)) weight = std::max(weight, std::abs(p.w));
    for (int j = 0; j < 9; ++j) {
      const double u = j % 3 * 0.5, v = j / 3 * 0.5;
      const double x = x0 + v * (x1 - x0), y = y0 + u * (y1 - y0), s = x * x + y * y + d * d;
      const dvec3 p = net_point(net, u, v);
      const double w = net_first(net, u, v).value.w;
      const double tolerance = (8.0 + 4.0 * weight / w) * 0x1p-52;
      const auto describe = [&] { return fmt::format("{} at ({}, {})", text, u, v); };
      sphere.add(std::abs(glm::length(p) - 1.0), tolerance, describe);
      place.add(glm::length(p - dvec3(2 * d * x, 2 * d * y, x * x + y * y - d * d) / s), 4.0 * tolerance,
                describe);
      if (glm::dot(unit_normal(net, u, v), p) < 0.9) FAIL("inward: " << text);
    }
  }
  INFO(sphere.text());
  INFO(place.text());
  CHECK(sphere.count() > 1000);
  CHECK(sphere.failures() == 0);
  CHECK(place.failures() == 0);
}

TEST_CASE("each mistake in a rectangle has its message", "[surfaces]") {
  const auto rectangle = [](const std::string& rest) {
    return complaint(R"({"type": "stereographic_patch", )" + rest + "}");
  };
  CHECK(rectangle(R"("x": [1, -1])") == "\"x\" must be an interval, [low, high]");
  CHECK(rectangle(R"("y": [1, 1])") == "\"y\" must be an interval, [low, high]");
  CHECK(rectangle(R"("x": [-1, 3000])") ==
        "\"x\" must lie in [-2000, 2000]: 1000 times the distance from the pole to the plane, either way");
  CHECK(rectangle(R"("plane_z": 1)") ==
        "\"plane_z\" must not be 1: one projects from the pole, (0, 0, 1), which lies there");
  CHECK(rectangle(R"("plane_z": 0.999)").find("\"x\" must lie in [-1, 1]") == std::string::npos);
}

}  // namespace rondure
