// A scene from JSON text, ready to render.
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "renderer/commands/tracer_of.h"
#include "renderer/plugin/builtin.h"
#include "renderer/render/render.h"
#include "renderer/scene/scene_reader.h"

namespace rondure {

struct StagedScene {
  Scene scene;
  Tracer tracer;
  World world;

  explicit StagedScene(const std::string& text, const SceneOverrides& overrides = {})
      : StagedScene(read_scene_text("test.json", text, builtins(), overrides)) {}
  explicit StagedScene(Scene read)
      : scene(std::move(read)), tracer(tracer_of(scene)), world(make_world(scene, tracer)) {}

  // The whole picture, `samples` a pixel; the scene's own count by default.
  Film render(int samples = 0, RenderOptions options = {}) const {
    Film film = make_film(scene, options);
    add_samples(film, static_cast<std::uint32_t>(samples > 0 ? samples : scene.sampling.spp), scene, world,
                options);
    return film;
  }

  static const Registry& builtins() {
    static const Registry registry = [] {
      Registry r;
      register_builtins(r);
      return r;
    }();
    return registry;
  }
};

// Mean over all pixels of one channel, and its standard error as measured from the samples.
struct Estimate {
  double mean = 0.0, error = 0.0;
};

inline Estimate picture_mean(const Film& film, int channel = 0) {
  Estimate e;
  const double count = static_cast<double>(film.whole.size());
  for (int y = film.window().y0; y < film.window().y1; ++y) {
    for (int x = film.window().x0; x < film.window().x1; ++x) {
      e.mean += film.mean(x, y).color[channel] / count;
      e.error += film.variance(x, y)[channel] / (count * count);
    }
  }
  e.error = std::sqrt(e.error);
  return e;
}

// Root mean square of a - b over that of a, all channels.
inline double relative_rmse(const Film& a, const Film& b) {
  double difference = 0.0, size = 0.0;
  for (int y = a.window().y0; y < a.window().y1; ++y) {
    for (int x = a.window().x0; x < a.window().x1; ++x) {
      const dvec3 p = a.mean(x, y).color, q = b.mean(x, y).color;
      for (int c = 0; c < 3; ++c) {
        difference += (p[c] - q[c]) * (p[c] - q[c]);
        size += p[c] * p[c];
      }
    }
  }
  return std::sqrt(difference / size);
}

}  // namespace rondure
