#include "renderer/api/registry.h"

#include "tests/catch.h"

namespace rondure {
namespace {

SurfaceFamily family_named(const std::string& name) {
  return {name, "a test", {}, [](Params&) { return Surface(); }};
}
IntegratorFactory integrator_named(const std::string& name) {
  return {name, "a test", {}, [](Params&) { return std::unique_ptr<Integrator>(); }};
}

}  // namespace

TEST_CASE("a registry finds what was added, and lists names in order", "[plugin]") {
  Registry registry;
  for (const char* name : {"torus", "cone", "sphere"}) registry.add(family_named(name));
  registry.add(integrator_named("sphere"));  // families and integrators have names of their own
  CHECK(registry.family_names() == std::vector<std::string>{"cone", "sphere", "torus"});
  CHECK(registry.integrator_names() == std::vector<std::string>{"sphere"});
  REQUIRE(registry.family("cone"));
  CHECK(registry.family("cone")->name == "cone");
  CHECK(registry.family("con") == nullptr);
  CHECK(registry.integrator("cone") == nullptr);
}

TEST_CASE("a registry refuses a taken name, an empty name and a missing factory", "[plugin]") {
  Registry registry;
  registry.add(family_named("torus"));
  registry.add(integrator_named("path"));
  CHECK_THROWS_WITH(registry.add(family_named("torus")),
                    "the name \"torus\" is taken by another surface family");
  CHECK_THROWS_WITH(registry.add(integrator_named("path")),
                    "the name \"path\" is taken by another integrator");
  CHECK_THROWS_WITH(registry.add(family_named("")), "a surface family without a name");
  CHECK_THROWS_WITH(registry.add(SurfaceFamily{"cone", "", {}, nullptr}),
                    "the surface family \"cone\" has no factory");
  CHECK(registry.family_names() == std::vector<std::string>{"torus"});
}

}  // namespace rondure
