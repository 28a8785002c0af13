// The image that a scene asks for: its size, its filter and its layers.
#pragma once

#include <vector>

#include "renderer/api/layer.h"
#include "renderer/api/params.h"
#include "renderer/api/type_doc.h"
#include "renderer/film/filter.h"

namespace rondure {

struct FilmSettings {
  int width = 640;
  int height = 480;
  Filter filter{};
  std::vector<FilmLayer> layers;  // beside those that every film has
};

// Reads the object at hand and finishes it. Layers are looked up in its registry.
FilmSettings read_film(Params& params);
const std::vector<TypeDoc>& film_docs();

}  // namespace rondure
