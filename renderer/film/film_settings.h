// The image that a scene asks for: its size and its filter.
#pragma once

#include <vector>

#include "renderer/api/params.h"
#include "renderer/api/type_doc.h"
#include "renderer/film/filter.h"

namespace rondure {

struct FilmSettings {
  int width = 640;
  int height = 480;
  Filter filter{};
};

// Reads the object at hand and finishes it.
FilmSettings read_film(Params& params);
const std::vector<TypeDoc>& film_docs();

}  // namespace rondure
