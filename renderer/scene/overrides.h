// What the command line changes in a scene before it is read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/api/params.h"

namespace rondure {

struct SceneOverrides {
  // "/json/pointer=value" (RFC 6901), applied in order. The value is JSON, or else taken as a string. Objects
  // that are missing on the way are created; array elements are not.
  std::vector<std::string> set;
  // Shorthands, applied after `set`.
  std::optional<std::int64_t> spp;
  std::optional<std::int64_t> seed;
  std::optional<std::pair<std::int64_t, std::int64_t>> resolution;  // width, height
  std::optional<std::string> integrator;  // keeps the parameters of one of the same name
  std::optional<std::string> solver;      // of every object
  std::optional<std::string> normals;     // of every object
  // The film's layers by name; those that the scene has keep their parameters.
  std::optional<std::vector<std::string>> layers;
};

// Edits the tree of a scene. Values that come from here have no position; errors of the overrides themselves
// are SceneErrors that name the pointer or the option.
void apply_overrides(Value& root, const SceneOverrides& overrides);

// One line an override, in the order of application: what the scene's hash is told of them.
std::string overrides_text(const SceneOverrides& overrides);

}  // namespace rondure
