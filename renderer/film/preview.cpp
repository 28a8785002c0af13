#include "renderer/film/preview.h"

#include <algorithm>
#include <cmath>

namespace rondure {
namespace {

double srgb_of_linear(double x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

}  // namespace

unsigned char srgb_byte(double linear) {
  return static_cast<unsigned char>(srgb_of_linear(std::clamp(linear, 0.0, 1.0)) * 255.0 + 0.5);
}

std::vector<unsigned char> preview(const Film& film, double exposure) {
  const double scale = std::exp2(exposure);
  const Window& w = film.window();
  std::vector<unsigned char> bytes;
  bytes.reserve(3 * film.whole.size());
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      const dvec3 color = film.mean(x, y).color * scale;
      for (int c = 0; c < 3; ++c) bytes.push_back(srgb_byte(color[c]));
    }
  }
  return bytes;
}

}  // namespace rondure
