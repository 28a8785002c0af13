#include "renderer/shading/color_map.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace rondure {
namespace {

struct Rgb {
  unsigned char r, g, b;
};

constexpr Rgb viridis[] = {{68, 1, 84},    {72, 40, 120},  {62, 74, 137},  {49, 104, 142}, {38, 130, 142},
                           {31, 158, 137}, {53, 183, 121}, {109, 205, 89}, {180, 222, 44}, {253, 231, 37}};
constexpr Rgb diverging[] = {{33, 60, 150}, {120, 160, 215}, {245, 245, 245}, {225, 140, 110}, {165, 20, 38}};
constexpr Rgb grey[] = {{0, 0, 0}, {255, 255, 255}};

std::span<const Rgb> knots(std::string_view map) {
  if (map == "viridis") return viridis;
  if (map == "diverging") return diverging;
  return grey;
}

double linear_of_srgb(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }

}  // namespace

dvec3 mapped_color(std::string_view map, double t) {
  const std::span<const Rgb> k = knots(map);
  const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(k.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(place), k.size() - 2);
  const double part = place - static_cast<double>(low);
  const auto mix = [&](unsigned char a, unsigned char b) {
    return linear_of_srgb(((1.0 - part) * a + part * b) / 255.0);
  };
  return {mix(k[low].r, k[low + 1].r), mix(k[low].g, k[low + 1].g), mix(k[low].b, k[low + 1].b)};
}

}  // namespace rondure
