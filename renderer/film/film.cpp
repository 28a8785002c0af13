#include "renderer/film/film.h"

#include <glm/common.hpp>

namespace rondure {
namespace {

void put(std::array<double, 13>& values, std::size_t at, const dvec3& v) {
  for (int c = 0; c < 3; ++c) values[at + static_cast<std::size_t>(c)] += v[c];
}

dvec3 get(const std::array<double, 13>& values, std::size_t at) {
  return {values[at], values[at + 1], values[at + 2]};
}

}  // namespace

void PixelSums::add(const FilmSample& sample) {
  put(values, 0, sample.color);
  put(values, 3, sample.color * sample.color);
  values[6] += sample.alpha;
  put(values, 7, sample.normal);
  put(values, 10, sample.albedo);
}

void PixelSums::add(const PixelSums& other) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += other.values[i];
}

Film::Film(int width, int height, Window window) : width_(width), height_(height), window_(window) {
  const auto count = static_cast<std::size_t>(window.width()) * static_cast<std::size_t>(window.height());
  whole.resize(count);
  geometry.resize(count);
}

void Film::add_layer(const std::string& channel) {
  layers.push_back({channel, std::vector<float>(geometry.size())});
}

PixelSums Film::sums(int x, int y) const {
  PixelSums result = whole[index(x, y)];
  if (!rest.empty()) result.add(rest[index(x, y)]);
  return result;
}

FilmSample Film::mean(int x, int y) const {
  const PixelSums s = sums(x, y);
  const auto n = static_cast<double>(samples);
  return {get(s.values, 0) / n, s.values[6] / n, get(s.values, 7) / n, get(s.values, 10) / n};
}

dvec3 Film::variance(int x, int y) const {
  if (samples < 2) return dvec3(0.0);
  const PixelSums s = sums(x, y);
  const auto n = static_cast<double>(samples);
  const dvec3 mean = get(s.values, 0) / n;
  // Rounding can take the difference of nearly equal squares below zero.
  return glm::max(dvec3(0.0), get(s.values, 3) / n - mean * mean) / (n - 1.0);
}

}  // namespace rondure
