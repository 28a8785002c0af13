// The render loop: pixels in tiles over threads, each pixel's samples in order.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "renderer/film/film.h"
#include "renderer/scene/scene.h"

namespace rondure {

// The scene's light and materials about its surfaces; `tracer` must outlive the world. Throws SceneError
// where the scene names an image that is of no use.
World make_world(const Scene& scene, const Tracer& tracer);

struct RenderOptions {
  int threads = 0;             // 0: as many as there are processors
  std::optional<Window> crop;  // the whole picture by default
  // Called from any thread with the number of pixels whose samples are done, counting each pass anew.
  std::function<void(std::size_t pixels)> progress;
  // Asked now and then from every thread; true ends the render by an Interrupted exception.
  std::function<bool()> stop;
};

struct Interrupted : std::exception {
  const char* what() const noexcept override { return "interrupted; nothing was written"; }
};

// An empty film for the scene. Throws std::invalid_argument for a crop that is empty or leaves the picture.
Film make_film(const Scene& scene, const RenderOptions& options);

// Adds samples until the film holds `samples` of them (in all). The result depends on the scene and the count
// alone: not on threads, tiles, crop, or how often the film was stopped and taken up again. The film is of no
// use after an exception.
void add_samples(Film& film, std::uint32_t samples, const Scene& scene, const World& world,
                 const RenderOptions& options);

}  // namespace rondure
