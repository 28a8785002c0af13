#include "renderer/api/registry.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "renderer/api/legend.h"
#include "renderer/api/utf8.h"
#include "renderer/plugin/build_surface.h"
#include "renderer/scene/unknown_name.h"

namespace rondure {
namespace {

// What stands in scenes, messages and lists alike.
bool is_name(std::string_view name) {
  constexpr std::size_t longest = 64;
  const auto belongs = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  };
  return name.size() <= longest && std::all_of(name.begin(), name.end(), belongs);
}

template <class Map, class Item>
void add_to(Map& map, Item item, bool callable, const char* kind) {
  if (item.name.empty()) throw std::runtime_error(std::string("a ") + kind + " without a name");
  if (!is_name(item.name)) {
    throw std::runtime_error(std::string("the ") + kind + " \"" + printable(item.name) +
                             "\" has no proper name: at most 64 letters, digits, \"_\", \"-\" and \".\"");
  }
  if (!callable)
    throw std::runtime_error(std::string("the ") + kind + " \"" + item.name + "\" has no factory");
  const std::string name = item.name;
  if (!map.try_emplace(name, std::move(item)).second)
    throw std::runtime_error(std::string("the name \"") + name + "\" is taken by another " + kind);
}

// What is wrong with a layer's channels, which become names in a file and words below a picture; "" if
// nothing.
std::string fault_of(const LayerFactory& layer) {
  constexpr std::size_t longest_unit = 100;
  for (const std::string& channel : layer.channels)
    if (channel.empty() || !is_name(channel))
      return "a channel \"" + printable(channel) + "\" without a proper name";
  for (const std::string& unit : layer.units)
    if (unit.size() > longest_unit || printable(unit, longest_unit) != unit)
      return "a unit that is no short line of text";
  for (const LayerScale& scale : layer.scales)
    if (!is_scale(scale.low, scale.high, scale.logarithmic))
      return "a scale that is no range of numbers from low to high, positive where logarithmic";
  return "";
}

template <class Map>
auto find_in(const Map& map, std::string_view name) -> const typename Map::mapped_type* {
  const auto found = map.find(name);
  return found == map.end() ? nullptr : &found->second;
}

template <class Map>
std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> names;
  for (const auto& [name, item] : map) names.push_back(name);
  return names;
}

}  // namespace

void Registry::add(SurfaceFamily family) {
  const bool callable = static_cast<bool>(family.build);
  add_to(families_, std::move(family), callable, "surface family");
}

void Registry::add(IntegratorFactory factory) {
  const bool callable = static_cast<bool>(factory.create);
  add_to(integrators_, std::move(factory), callable, "integrator");
}

void Registry::add(LayerFactory factory) {
  const bool callable = static_cast<bool>(factory.create) && !factory.channels.empty();
  const std::string fault = callable ? fault_of(factory) : "";
  if (!fault.empty()) throw std::runtime_error("the layer \"" + printable(factory.name) + "\" has " + fault);
  add_to(layers_, std::move(factory), callable, "layer");
}

const SurfaceFamily* Registry::family(std::string_view name) const { return find_in(families_, name); }
const IntegratorFactory* Registry::integrator(std::string_view name) const {
  return find_in(integrators_, name);
}
const LayerFactory* Registry::layer(std::string_view name) const { return find_in(layers_, name); }
std::vector<std::string> Registry::family_names() const { return names_of(families_); }
std::vector<std::string> Registry::integrator_names() const { return names_of(integrators_); }
std::vector<std::string> Registry::layer_names() const { return names_of(layers_); }

const SurfaceFamily& family_of(Params& params, const Registry& registry) {
  const std::string type = params.text("type");
  const SurfaceFamily* family = registry.family(type);
  if (!family) params.fail("type", unknown_name("type", type, registry.family_names()));
  return *family;
}

Surface nested_surface(Params& params, std::string_view key) {
  if (!params.registry()) params.fail(key, "no family can be named here");
  Params inside = params.object(key);
  Surface surface = build_surface(family_of(inside, *params.registry()), inside);
  inside.finish();
  return surface;
}

}  // namespace rondure
