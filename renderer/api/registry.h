// The families, integrators and film layers that a scene can name. The host owns one Registry and hands it to
// every plugin; nothing registers itself.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/api/integrator.h"
#include "renderer/api/layer.h"
#include "renderer/api/surface.h"

namespace rondure {

class Registry {
 public:
  // Throws std::runtime_error when the name is empty, improper or taken, the factory is null, or a layer's
  // channels are none, or have improper names, units or scales.
  void add(SurfaceFamily family);
  void add(IntegratorFactory factory);
  void add(LayerFactory factory);

  // A file that some of it came from.
  void add_plugin(std::string path) { plugins_.push_back(std::move(path)); }
  const std::vector<std::string>& plugins() const { return plugins_; }

  const SurfaceFamily* family(std::string_view name) const;  // null when unknown
  const IntegratorFactory* integrator(std::string_view name) const;
  const LayerFactory* layer(std::string_view name) const;
  std::vector<std::string> family_names() const;  // sorted
  std::vector<std::string> integrator_names() const;
  std::vector<std::string> layer_names() const;

 private:
  std::map<std::string, SurfaceFamily, std::less<>> families_;
  std::map<std::string, IntegratorFactory, std::less<>> integrators_;
  std::map<std::string, LayerFactory, std::less<>> layers_;
  std::vector<std::string> plugins_;
};

// The family that "type" names; an unknown name is an error that gives the nearest.
const SurfaceFamily& family_of(Params& params, const Registry& registry);

// For families made from others: builds the surface that the object under `key` describes, {"type": a family,
// and that family's parameters}, in the family's own frame.
Surface nested_surface(Params& params, std::string_view key);

}  // namespace rondure
