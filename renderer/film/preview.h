// The film's colour as an 8-bit picture for screens.
#pragma once

#include <vector>

#include "renderer/film/film.h"

namespace rondure {

// Linear colour times 2^exposure, clipped to [0, 1], in the sRGB encoding (IEC 61966-2-1), rounded; RGB, top
// row first, the film's window alone.
std::vector<unsigned char> preview(const Film& film, double exposure);

// One value of a linear colour in that encoding.
unsigned char srgb_byte(double linear);

}  // namespace rondure
