// What `rondure describe` prints of a built-in type that is no plugin: a material, a light, a camera, the
// film.
#pragma once

#include <string>
#include <vector>

#include "renderer/api/surface.h"

namespace rondure {

struct TypeDoc {
  std::string name;     // the scene's "type"
  std::string summary;  // one line
  std::vector<ParameterDoc> parameters;
};

}  // namespace rondure
