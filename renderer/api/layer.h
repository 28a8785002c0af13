// What a film layer is: numbers for each pixel, from the ray through its centre and what that meets.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/api/params.h"
#include "renderer/api/surface.h"
#include "renderer/intersect/ray.h"

namespace rondure {

class World;

// Writes one value a channel; they are zero before. Called from any thread, once a pixel, for misses (the hit
// converts to false) too. Must depend on its arguments alone and never write NaN; infinities are stored as
// the largest float.
using LayerFunction = std::function<void(const World&, const Ray&, const Hit&, double* values)>;

// What a picture of one channel spreads its colours over, where the scene does not say.
struct LayerScale {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;
};

struct LayerFactory {
  std::string name;  // the scene's "type"
  std::string summary;
  std::string group;                  // of its channels, unless the scene says "as": "NormalError"
  std::vector<std::string> channels;  // after the group and a dot: "deg"
  std::vector<ParameterDoc> parameters;
  std::function<LayerFunction(Params&)> create;
  std::vector<std::string> units{};  // of the channels; fewer where the rest have none
  std::vector<LayerScale> scales{};  // likewise
  bool misses = false;               // it has something to show of rays that meet nothing
};

// A layer as a scene asks for it.
struct FilmLayer {
  std::string type;
  std::vector<std::string> channels;  // whole names: "NormalError.deg"
  LayerFunction function;
  std::vector<std::string> units{};  // of the channels, "" for none
  std::vector<LayerScale> scales{};  // of the channels
  bool misses = false;
};

}  // namespace rondure
