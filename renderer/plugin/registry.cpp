#include "renderer/api/registry.h"

#include <stdexcept>
#include <utility>

#include "renderer/scene/unknown_name.h"

namespace rondure {
namespace {

template <class Map, class Item>
void add_to(Map& map, Item item, bool callable, const char* kind) {
  if (item.name.empty()) throw std::runtime_error(std::string("a ") + kind + " without a name");
  if (!callable)
    throw std::runtime_error(std::string("the ") + kind + " \"" + item.name + "\" has no factory");
  const std::string name = item.name;
  if (!map.try_emplace(name, std::move(item)).second)
    throw std::runtime_error(std::string("the name \"") + name + "\" is taken by another " + kind);
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
  Surface surface = family_of(inside, *params.registry()).build(inside);
  inside.finish();
  return surface;
}

}  // namespace rondure
