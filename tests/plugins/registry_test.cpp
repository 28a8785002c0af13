#include "renderer/api/registry.h"

#include <cmath>
#include <limits>
#include <stdexcept>

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

TEST_CASE("a registry refuses layers whose channels have no proper names, units or scales", "[plugin]") {
  Registry registry;
  const auto refused = [&](std::vector<std::string> channels, std::vector<std::string> units = {},
                           std::vector<LayerScale> scales = {}) {
    LayerFactory layer{"l", "", "L", std::move(channels), {}, [](Params&) { return LayerFunction(); }};
    layer.units = std::move(units), layer.scales = std::move(scales);
    try {
      registry.add(std::move(layer));
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refused({}) == "the layer \"l\" has no factory");
  const std::string proper = " without a proper name";
  CHECK(refused({""}) == "the layer \"l\" has a channel \"\"" + proper);
  CHECK(refused({"x", "\x1b[2J"}) == "the layer \"l\" has a channel \"?[2J\"" + proper);
  CHECK(refused({"\xff"}) == "the layer \"l\" has a channel \"?\"" + proper);
  CHECK(refused({std::string("a\0b", 3)}) == "the layer \"l\" has a channel \"a?b\"" + proper);
  CHECK(refused({std::string(10'000, 'x')}).ends_with(proper));
  const std::string unit = "the layer \"l\" has a unit that is no short line of text";
  CHECK(refused({"x"}, {"a\nb"}) == unit);
  CHECK(refused({"x"}, {std::string(10'000, 'x')}) == unit);
  const std::string scale =
      "the layer \"l\" has a scale that is no range of numbers from low to high, positive where logarithmic";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const LayerScale& bad :
       {LayerScale{1.0, 0.0}, LayerScale{0.0, 0.0}, LayerScale{0.0, 1.0, true}, LayerScale{-1.0, 1.0, true},
        LayerScale{nan, 1.0}, LayerScale{0.0, nan}, LayerScale{0.0, INFINITY}, LayerScale{-1e308, 1e308}})
    CHECK(refused({"x"}, {}, {bad}) == scale);
  CHECK(registry.layer_names().empty());
  CHECK(refused({"x"}, {"radians"}, {LayerScale{1e-9, 1.0, true}}).empty());
}

}  // namespace rondure
