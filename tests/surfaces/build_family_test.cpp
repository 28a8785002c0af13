// The families' own descriptions, and the numbers they take.
#include "tests/surfaces/build_family.h"

#include "renderer/plugin/builtin.h"
#include "tests/catch.h"

namespace rondure {

TEST_CASE("every family describes itself", "[surfaces]") {
  Registry registry;
  register_builtins(registry);
  for (const std::string& name : registry.family_names()) {
    const SurfaceFamily& family = *registry.family(name);
    INFO(name);
    CHECK_FALSE(family.summary.empty());
    CHECK(family.build != nullptr);
    for (const ParameterDoc& parameter : family.parameters) {
      CHECK_FALSE(parameter.name.empty());
      CHECK_FALSE(parameter.type.empty());
      CHECK_FALSE(parameter.meaning.empty());
    }
  }
  CHECK_FALSE(registry.family_names().empty());
}

TEST_CASE("the sphere is analytic, of radius 1, and closed", "[surfaces]") {
  const Surface sphere = build_family(R"({"type": "sphere"})");
  CHECK(sphere.patches.empty());
  REQUIRE(sphere.ellipsoid.has_value());
  CHECK(*sphere.ellipsoid == dmat3(1.0));
  CHECK(sphere.closed);
}

TEST_CASE("families take their numbers from the stated ranges only", "[surfaces]") {
  const auto refused = [](const std::string& text, const std::string& part) {
    const std::string message = family_error(text);
    INFO(text << "\n" << message);
    CHECK(message.find(part) != std::string::npos);
  };
  refused(R"({"type": "sphere_cap", "z_max": 1})", "z_max");
  refused(R"({"type": "sphere_cap", "z_max": -1})", "z_max");
  refused(R"({"type": "sphere_cap", "z_max": "low"})", "z_max");
  refused(R"({"type": "sphere_cap", "middle_weight": 0})", "middle_weight");
  refused(R"({"type": "sphere_cap", "middle_weight": 1.1e6})", "middle_weight");
  refused(R"({"type": "sphere_cap", "z_max": 0.99, "middle_weight": 10.1})", "middle_weight");
  CHECK(family_error(R"({"type": "sphere_cap", "z_max": 0.99, "middle_weight": 10.2})") == "no error");
  refused(R"({"type": "sphere_tiling", "topology": "cubes"})", "cube");
  refused(R"({"type": "sphere_tiling", "middle_weight": -1})", "middle_weight");
  refused(R"({"type": "sphere_octant", "octants": []})", "octants is empty: name at least one of 0 to 7");
  refused(R"({"type": "sphere_octant", "octants": [1, 8]})", "8");
  refused(R"({"type": "sphere_octant", "octants": [1, 2, 1]})", "an octant is listed twice");
  refused(R"({"type": "sphere", "tint": 1})", "tint");
  CHECK(family_error(R"({"type": "sphere_cap", "z_max": -0.999, "middle_weight": 1e3})") == "no error");
}

}  // namespace rondure
