#include "renderer/render/render.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>

#include "renderer/film/stored.h"
#include "renderer/parallel/parallel_for.h"
#include "renderer/plugin/call_plugin.h"

namespace rondure {
namespace {

constexpr int tile_side = 16;

// All that a pixel needs and no pixel changes.
struct Job {
  const Scene& scene;
  const World& world;
  const RenderOptions& options;
  double aspect;
  std::uint32_t from, to;  // sample indices
};

dvec2 film_point(const Job& job, double x, double y) {
  return {x / job.scene.film.width, y / job.scene.film.height};
}

struct PixelResult {
  PixelSums rest;
  std::uint64_t rejected = 0, whole_rejected = 0;
};

// What the file's floats can hold; no comparison with NaN is true.
bool is_radiance(const dvec3& v) {
  constexpr double most = std::numeric_limits<float>::max();
  return v.x >= 0.0 && v.y >= 0.0 && v.z >= 0.0 && v.x <= most && v.y <= most && v.z <= most;
}

// The samples of one pixel that one chunk of the film holds: their camera rays are met together.
struct Samples {
  std::array<std::optional<Sampler>, Film::chunk> samplers;
  std::array<Ray, Film::chunk> rays;
  std::array<Hit, Film::chunk> first;
};

void take_rays(const Job& job, int x, int y, std::uint32_t from, std::size_t count, Samples& samples) {
  for (std::size_t k = 0; k < count; ++k) {
    samples.samplers[k].emplace(job.scene.sampling.seed, x, y, from + static_cast<std::uint32_t>(k));
    Sampler& sampler = *samples.samplers[k];
    const dvec2 offset = job.scene.film.filter.sample(sampler.next_2d());
    const dvec2 lens = sampler.next_2d();
    const dvec2 point = film_point(job, x + 0.5 + offset.x, y + 0.5 + offset.y);
    samples.rays[k] = camera_ray(job.scene.camera, job.aspect, point, lens);
  }
  job.world.tracer().closest(std::span(samples.rays.data(), count), std::span(samples.first.data(), count));
}

// One sample; false when its colour had to be dropped.
bool take_sample(const Job& job, const Ray& ray, const Hit& first, Sampler& sampler, FilmSample& sample) {
  if (first) {
    sample.alpha = 1.0;
    sample.normal = job.world.shading_normal(first);
    sample.albedo = albedo(job.world.material(first), sample.normal, -ray.direction);
  }
  sample.color = job.scene.integrator->radiance(job.world, ray, first, sampler);
  if (is_radiance(sample.color)) return true;
  sample.color = dvec3(0.0);
  return false;
}

// A layer's own failure, apart from an integrator's.
struct LayerError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

void take_layers(const Job& job, const Ray& ray, const Hit& hit, std::size_t at, Film& film) {
  std::size_t plane = 0;
  std::vector<double> values;
  for (const FilmLayer& layer : job.scene.film.layers) {
    values.assign(layer.channels.size(), 0.0);
    try {
      layer.function(job.world, ray, hit, values.data());
    } catch (...) {
      throw LayerError(fmt::format("the layer \"{}\" {}", layer.type, plugin_failure()));
    }
    for (const double value : values) {
      LayerPlane& channel = film.layers[plane++];
      if (std::isnan(value))
        throw LayerError(fmt::format("the layer \"{}\" gave no number for a pixel", channel.channel));
      channel.values[at] = stored(value);
    }
  }
}

PixelGeometry take_geometry(const Job& job, int x, int y, Film& film) {
  const Camera& camera = job.scene.camera;
  const Ray ray = camera_ray(camera, job.aspect, film_point(job, x + 0.5, y + 0.5), {0.5, 0.5});
  const Hit hit = job.world.tracer().closest(ray);
  if (!film.layers.empty()) take_layers(job, ray, hit, film.index(x, y), film);
  if (!hit) return {};
  const double depth = glm::dot(hit.point - camera.origin, camera.forward);
  return {hit.point, depth, {hit.u, hit.v}, hit.patch, hit.surface};
}

// Adds the job's samples to the pixel's whole chunks and returns what is left over.
PixelResult render_pixel(const Job& job, int x, int y, PixelSums& whole) {
  PixelResult result;
  Samples samples;
  for (std::uint32_t from = job.from; from < job.to; from += Film::chunk) {
    const std::uint32_t count = std::min<std::uint32_t>(Film::chunk, job.to - from);
    take_rays(job, x, y, from, count, samples);
    for (std::uint32_t k = 0; k < count; ++k) {
      FilmSample sample;
      if (!take_sample(job, samples.rays[k], samples.first[k], *samples.samplers[k], sample))
        ++result.rejected;
      result.rest.add(sample);
    }
    if (count < Film::chunk) break;
    whole.add(result.rest);
    result.rest = {};
    result.whole_rejected = result.rejected;
    if (job.options.stop && job.options.stop()) throw Interrupted{};
  }
  return result;
}

}  // namespace

World make_world(const Scene& scene, const Tracer& tracer) {
  std::vector<int> materials;
  std::vector<NormalEstimator> normals;
  bool plain = true;
  for (const SceneObject& object : scene.objects) {
    materials.push_back(object.material);
    normals.push_back(object.normals.value_or(NormalEstimator::limit));
    plain = plain && normals.back() == NormalEstimator::limit;
  }
  if (plain) normals.clear();
  try {
    return World(tracer, scene.materials, scene.lights, std::move(materials), std::move(normals));
  } catch (const LightError& error) {
    const auto* image = std::get_if<EnvironmentLight>(&scene.lights[error.light]);
    scene.fail(image ? image->file_where : SourcePosition{}, error.what());
  }
}

Film make_film(const Scene& scene, const RenderOptions& options) {
  const int width = scene.film.width, height = scene.film.height;
  const Window all{0, 0, width, height};
  const Window w = options.crop.value_or(all);
  if (w.x0 < 0 || w.y0 < 0 || w.x1 > width || w.y1 > height || w.x0 >= w.x1 || w.y0 >= w.y1) {
    throw std::invalid_argument(
        fmt::format("the crop {},{},{},{} must be a window of 0,0,{},{}: x0,y0 within, x1,y1 just beyond",
                    w.x0, w.y0, w.x1, w.y1, width, height));
  }
  // A system that promises more memory than it has ends the process later on, in the middle of the work.
  const double bytes =
      static_cast<double>(w.width()) * w.height() * (2 * sizeof(PixelSums) + sizeof(PixelGeometry));
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (memory > 0.0 && bytes > memory) {
    throw std::runtime_error(fmt::format(
        "a picture of {} x {} pixels takes {:.0f} GB of memory, and there are {:.0f}; --crop renders a "
        "part of it",
        w.width(), w.height(), bytes / 1e9, memory / 1e9));
  }
  Film film(width, height, w);
  for (const FilmLayer& layer : scene.film.layers) {
    for (const std::string& channel : layer.channels) film.add_layer(channel);
  }
  return film;
}

void add_samples(Film& film, std::uint32_t samples, const Scene& scene, const World& world,
                 const RenderOptions& options) {
  // Samples of an unfinished chunk are taken again: the chunk's sum needs its beginning.
  const std::uint32_t from = film.whole_samples();
  const double aspect = static_cast<double>(film.width()) / film.height();
  const Job job{scene, world, options, aspect, from, samples};
  const Window w = film.window();
  const int across = (w.width() + tile_side - 1) / tile_side, down = (w.height() + tile_side - 1) / tile_side;
  film.rest.assign(samples % Film::chunk != 0 ? film.whole.size() : 0, {});
  std::atomic<std::uint64_t> rejected{film.whole_rejected}, whole_rejected{film.whole_rejected};

  const auto render_tile = [&](std::size_t index) {
    const int tile = static_cast<int>(index);
    const int x0 = w.x0 + tile % across * tile_side, y0 = w.y0 + tile / across * tile_side;
    const int x1 = std::min(x0 + tile_side, w.x1), y1 = std::min(y0 + tile_side, w.y1);
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const std::size_t at = film.index(x, y);
        if (!film.has_geometry) film.geometry[at] = take_geometry(job, x, y, film);
        const PixelResult result = render_pixel(job, x, y, film.whole[at]);
        if (!film.rest.empty()) film.rest[at] = result.rest;
        rejected += result.rejected;
        whole_rejected += result.whole_rejected;
      }
      if (options.stop && options.stop()) throw Interrupted{};
      if (options.progress) options.progress(static_cast<std::size_t>(x1 - x0));
    }
  };

  const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  try {
    arena.execute([&] {
      // Qualified: TBB's would be found by the partitioner.
      rondure::parallel_for(static_cast<std::size_t>(across * down), render_tile, tbb::simple_partitioner{});
    });
  } catch (const Interrupted&) {
    throw;
  } catch (const LayerError&) {
    throw;
  } catch (...) {  // nobody else throws here
    throw std::runtime_error(
        fmt::format("the integrator \"{}\" {}", scene.integrator_name, plugin_failure()));
  }
  film.has_geometry = true;
  film.samples = samples;
  film.rejected = rejected;
  film.whole_rejected = whole_rejected;
}

}  // namespace rondure
