// What a picture's colours stand for, drawn below it.
#pragma once

#include <string>
#include <vector>

#include "renderer/api/legend.h"

namespace rondure {

// Throws std::runtime_error, beginning with `who`, where the legend is none that can be drawn: without colours
// or a scale, or with a title that is no short line of text.
void check_legend(const Legend& legend, const std::string& who);

// Adds rows below a picture (8-bit sRGB, top row first): the legend's colours, numbers and title. Returns the
// new height. Throws std::runtime_error where there is no font for the text (image.h).
int append_legend(std::vector<unsigned char>& rgb, int width, int height, const Legend& legend);

// The numbers at the ticks: about as many as fit, powers of ten on a logarithmic scale.
std::vector<double> legend_ticks(const Legend& legend, int most);

}  // namespace rondure
