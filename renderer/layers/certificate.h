// The film layer of certificates, and what it says of a picture as a whole.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "renderer/api/layer.h"
#include "renderer/film/film.h"

namespace rondure {

// How many of the film's pixels have no proof, by its first layer of certificates; nothing where it has none.
std::optional<std::size_t> unresolved_pixels(const Film& film, const std::vector<FilmLayer>& layers);

}  // namespace rondure
