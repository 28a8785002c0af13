#include "renderer/render/resume_key.h"

#include <fmt/format.h>

#include <bit>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "renderer/api/version.h"
#include "renderer/sampling/hash.h"

namespace rondure {
namespace {

std::uint64_t hash_numbers(std::uint64_t hash, const double* values, int count) {
  for (int i = 0; i < count; ++i) hash = hash_with(hash, std::bit_cast<std::uint64_t>(values[i]));
  return hash;
}

std::uint64_t hash_surface(std::uint64_t hash, const Surface& surface) {
  hash = hash_numbers(hash, &surface.origin.x, 3);
  for (const Net& net : surface.patches) {
    hash = hash_with(hash, net.index());
    if (const auto* tensor = std::get_if<TensorNet>(&net))
      hash = hash_with(hash, static_cast<std::uint64_t>(tensor->m));
    for (const dvec4& point : points_of(net)) hash = hash_numbers(hash, &point.x, 4);
  }
  if (surface.ellipsoid) {
    for (int c = 0; c < 3; ++c) hash = hash_numbers(hash, &(*surface.ellipsoid)[c].x, 3);
  }
  return hash;
}

std::uint64_t hash_bytes(std::uint64_t hash, std::ifstream& file) {
  for (std::istreambuf_iterator<char> c(file), end; c != end; ++c)
    hash = hash_with(hash, static_cast<unsigned char>(*c));
  return hash;
}

std::uint64_t hash_image(std::uint64_t hash, const Scene& scene, const EnvironmentLight& light) {
  std::ifstream file(light.file, std::ios::binary);
  if (!file) scene.fail(light.file_where, fmt::format("{}: cannot read the image", light.file));
  return hash_bytes(hash, file);
}

}  // namespace

std::string resume_key(const Scene& scene, const Film& film, const std::vector<std::string>& plugins) {
  std::uint64_t content = 0;
  for (const SceneObject& object : scene.objects) content = hash_surface(content, object.traced.surface);
  for (const Light& light : scene.lights) {
    if (const auto* image = std::get_if<EnvironmentLight>(&light))
      content = hash_image(content, scene, *image);
  }
  for (const std::string& path : plugins) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("plugin " + path + ": it cannot be read");
    content = hash_bytes(content, file);
  }
  const Window& w = film.window();
  return fmt::format("rondure {}, scene {:016x}, content {:016x}, seed {}, {} x {}, window {},{},{},{}",
                     version, scene.hash, content, scene.sampling.seed, film.width(), film.height(), w.x0,
                     w.y0, w.x1, w.y1);
}

}  // namespace rondure
