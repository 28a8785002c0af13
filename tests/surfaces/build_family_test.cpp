// The helper that builds families for the tests beside it, and the families' own descriptions.
#include "tests/surfaces/build_family.h"

#include "renderer/api/registry.h"
#include "renderer/scene/json_reader.h"
#include "surfaces/families.h"
#include "tests/catch.h"
#include "tests/paths.h"

namespace rondure {
namespace {

Registry all_families() {
  Registry registry;
  register_bezier(registry);
  register_sphere(registry);
  register_sphere_cap(registry);
  register_sphere_octant(registry);
  register_sphere_tiling(registry);
  register_spherical_quad(registry);
  register_stereographic_patch(registry);
  return registry;
}

}  // namespace

Surface build_family(const std::string& text) {
  const Registry registry = all_families();
  // Named as a file of the data folder, so that relative paths start there.
  const Document document = read_json_text(source_folder() + "/tests/data/object.json", text);
  Params params(document.root, document.source.get(), "the object");
  const SurfaceFamily* family = registry.family(params.text("type"));
  REQUIRE(family != nullptr);
  Surface surface = family->build(params);
  params.finish();
  return surface;
}

std::string family_error(const std::string& text) {
  try {
    build_family(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST_CASE("every family describes itself", "[surfaces]") {
  const Registry registry = all_families();
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
  CHECK(registry.family_names().size() == 7);
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
  refused(R"({"type": "sphere_tiling", "topology": "cubes"})", "cube");
  refused(R"({"type": "sphere_tiling", "middle_weight": -1})", "middle_weight");
  refused(R"({"type": "sphere_octant", "octants": []})", "octants is empty: name at least one of 0 to 7");
  refused(R"({"type": "sphere_octant", "octants": [1, 8]})", "8");
  refused(R"({"type": "sphere_octant", "octants": [1, 2, 1]})", "an octant is listed twice");
  refused(R"({"type": "sphere", "tint": 1})", "tint");
  CHECK(family_error(R"({"type": "sphere_cap", "z_max": -0.999, "middle_weight": 1e3})") == "no error");
}

}  // namespace rondure
