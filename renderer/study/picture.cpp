#include "renderer/study/picture.h"

#include <unistd.h>

#include <utility>

#include "renderer/film/image.h"
#include "renderer/film/legend_strip.h"
#include "renderer/film/preview.h"
#include "renderer/render/render.h"

namespace rondure {

Film take_picture(const std::string& scene_text, const std::string& name, const Registry& registry,
                  const Tracer& tracer, const SceneOverrides& overrides) {
  const Scene scene = read_scene_text(name, scene_text, registry, overrides);
  const World world = make_world(scene, tracer);
  Film film = make_film(scene, {});
  add_samples(film, static_cast<std::uint32_t>(scene.sampling.spp), scene, world, {});
  return film;
}

Tracer tracer_for(const std::string& scene_text, const std::string& name, const Registry& registry) {
  Scene scene = read_scene_text(name, scene_text, registry);
  std::vector<TracedSurface> surfaces;
  for (SceneObject& object : scene.objects) surfaces.push_back(std::move(object.traced));
  return Tracer(std::move(surfaces));
}

std::string png_bytes(const StudyFolder& folder, const std::vector<unsigned char>& rgb, int width, int height,
                      int zoom, const Legend* legend) {
  const auto w = static_cast<std::size_t>(width), z = static_cast<std::size_t>(zoom);
  const auto h = static_cast<std::size_t>(height);
  std::vector<unsigned char> large;
  large.reserve(rgb.size() * z * z);
  for (std::size_t y = 0; y < h * z; ++y)
    for (std::size_t x = 0; x < w * z; ++x)
      for (std::size_t c = 0; c < 3; ++c) large.push_back(rgb[3 * (y / z * w + x / z) + c]);
  int tall = height * zoom;
  if (legend) tall = append_legend(large, width * zoom, tall, *legend);
  const std::string name = "picture.png";
  write_png(folder.path(name), width * zoom, tall, large);
  std::string bytes = folder.read(name);
  unlink(folder.path(name).c_str());
  return bytes;
}

std::string png_bytes(const StudyFolder& folder, const Film& film, int zoom, const Legend* legend) {
  return png_bytes(folder, preview(film, 0.0), film.window().width(), film.window().height(), zoom, legend);
}

}  // namespace rondure
