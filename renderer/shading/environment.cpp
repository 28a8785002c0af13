#include "renderer/shading/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace rondure {
namespace {

using std::numbers::pi;

dvec2 image_of(const dvec3& d) {
  return {0.5 - std::atan2(d.y, d.x) / (2.0 * pi), std::acos(std::clamp(d.z, -1.0, 1.0)) / pi};
}

dvec3 texel(const Image& image, int x, int y) {
  const int wrapped = (x % image.width + image.width) % image.width;
  return image.at(wrapped, std::clamp(y, 0, image.height - 1));
}

// Luminance of each texel's solid angle. Linear interpolation spreads a texel over its neighbours: weights of
// its mean over a cell (1/8, 3/4, 1/8 a side), so that no direction with radiance has density 0.
std::vector<double> weights_of(const Image& image) {
  constexpr double spread[3] = {0.125, 0.75, 0.125};
  std::vector<double> weights;
  weights.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) {
    const double solid = std::cos(pi * y / image.height) - std::cos(pi * (y + 1) / image.height);
    for (int x = 0; x < image.width; ++x) {
      double sum = 0.0;
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i)
          sum += spread[i] * spread[j] * luminance(texel(image, x + i - 1, y + j - 1));
      }
      weights.push_back(sum * solid);
    }
  }
  return weights;
}

}  // namespace

double luminance(const dvec3& rgb) { return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z; }

Environment::Environment(Image image)
    : image_(std::move(image)), distribution_(image_.width, image_.height, weights_of(image_)) {
  double sum = 0.0;
  for (const double w : weights_of(image_)) sum += w;
  mean_luminance_ = sum / (2.0 * image_.width);
}

dvec3 Environment::radiance(const dvec3& direction) const {
  const dvec2 p = image_of(direction);
  const double x = p.x * image_.width - 0.5, y = p.y * image_.height - 0.5;
  const double fx = std::floor(x), fy = std::floor(y);
  const int i = static_cast<int>(fx), j = static_cast<int>(fy);
  const double a = x - fx, b = y - fy;
  const dvec3 top = (1.0 - a) * texel(image_, i, j) + a * texel(image_, i + 1, j);
  const dvec3 bottom = (1.0 - a) * texel(image_, i, j + 1) + a * texel(image_, i + 1, j + 1);
  return (1.0 - b) * top + b * bottom;
}

double Environment::pdf(const dvec3& direction) const {
  const double sine = std::hypot(direction.x, direction.y);
  if (!(sine > 0.0)) return 0.0;
  return distribution_.density(image_of(direction)) / (2.0 * pi * pi * sine);
}

Environment::Sample Environment::sample(dvec2 uv) const {
  const PiecewiseConstant2d::Sample s = distribution_.sample(uv);
  const double phi = 2.0 * pi * (0.5 - s.position.x), theta = pi * s.position.y;
  const double sine = std::sin(theta);
  if (!(sine > 0.0)) return {};
  return {{sine * std::cos(phi), sine * std::sin(phi), std::cos(theta)}, s.density / (2.0 * pi * pi * sine)};
}

}  // namespace rondure
