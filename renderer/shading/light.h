// Lights that are not surfaces. Surfaces become lights by a material with emission.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "renderer/api/params.h"
#include "renderer/api/type_doc.h"

namespace rondure {

// The same radiance from every direction.
struct ConstantLight {
  dvec3 radiance{1.0};
};

// An equirectangular image at infinity, seen from inside with z up: direction (x, y, z) looks up the image at
// (1/2 - atan2(y, x) / 2 pi, acos(z) / pi) from its top left, after `to_world` is undone.
struct EnvironmentLight {
  std::string file;  // resolved; read when the world is built
  SourcePosition file_where;
  dvec3 scale{1.0};     // factor on the image's radiance
  dmat3 to_world{1.0};  // rotation
};

struct PointLight {
  dvec3 position{0.0};
  dvec3 intensity{1.0};  // radiant intensity, alike in all directions
};

struct DirectionalLight {
  dvec3 direction{0.0, 0.0, -1.0};  // unit, the way that light travels
  dvec3 irradiance{1.0};            // on a surface that faces it
};

using Light = std::variant<ConstantLight, EnvironmentLight, PointLight, DirectionalLight>;

// Reads the object at hand, "type" included, and finishes it. A missing image file is an error here.
Light read_light(Params& params);
const std::vector<TypeDoc>& light_docs();

}  // namespace rondure
