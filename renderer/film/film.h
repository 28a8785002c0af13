// The picture while it is rendered: sums of samples, pixel by pixel.
//
// Samples are added in the order of their index, in chunks of a fixed size whose sums are then added up, so
// that the bits depend on nothing but the samples. Colour, alpha, normal and albedo are means over all
// samples. What has no mean (position, depth, parameters, patch) comes from one ray through the pixel's
// centre and the lens's.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/api/patch.h"
#include "renderer/intersect/ray.h"

namespace rondure {

// Half-open window of pixels.
struct Window {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool operator==(const Window&) const = default;
};

struct FilmSample {
  dvec3 color{0.0};
  double alpha = 0.0;  // 1 where the camera ray hit a surface
  dvec3 normal{0.0};
  dvec3 albedo{0.0};
};

// Sums over samples.
struct PixelSums {
  std::array<double, 13> values{};  // colour, squared colour, alpha, normal, albedo

  void add(const FilmSample& sample);
  void add(const PixelSums& other);
};

// What the ray through the pixel's centre meets; surface -1 and zeros when it meets nothing.
struct PixelGeometry {
  dvec3 point{0.0};
  double depth = 0.0;  // along the camera's view
  dvec2 uv{0.0};
  int patch = -1;
  int surface = -1;
};

// One channel of an extra layer.
struct LayerPlane {
  std::string channel;
  std::vector<float> values;
};

class Film {
 public:
  // Samples in a chunk.
  static constexpr std::uint32_t chunk = 16;

  Film(int width, int height, Window window);

  int width() const { return width_; }
  int height() const { return height_; }
  const Window& window() const { return window_; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - window_.y0) * static_cast<std::size_t>(window_.width()) +
           static_cast<std::size_t>(x - window_.x0);
  }

  // Sums over whole chunks, and over the samples of the last, unfinished one; empty when the count of samples
  // is a multiple of `chunk`.
  std::vector<PixelSums> whole;
  std::vector<PixelSums> rest;
  std::vector<PixelGeometry> geometry;
  std::vector<LayerPlane> layers;  // from the same rays as `geometry`
  bool has_geometry = false;       // and layers
  std::uint32_t samples = 0;
  std::uint64_t rejected = 0;        // samples that were no radiance, and counted as black
  std::uint64_t whole_rejected = 0;  // those in `whole`

  // Samples in `whole` alone.
  std::uint32_t whole_samples() const { return samples / chunk * chunk; }

  void add_layer(const std::string& channel);

  // Means at a pixel of the window, and the variance of the colour's mean (zero for a single sample).
  FilmSample mean(int x, int y) const;
  dvec3 variance(int x, int y) const;

 private:
  PixelSums sums(int x, int y) const;

  int width_, height_;
  Window window_;
};

}  // namespace rondure
