// rondure render: a scene becomes an OpenEXR file, and a PNG preview if wanted.

#include "renderer/render/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "renderer/commands/commands.h"
#include "renderer/commands/distinct_paths.h"
#include "renderer/commands/scene_warnings.h"
#include "renderer/commands/solver_names.h"
#include "renderer/commands/tracer_of.h"
#include "renderer/film/atomic_file.h"
#include "renderer/film/exr.h"
#include "renderer/film/image.h"
#include "renderer/film/legend_strip.h"
#include "renderer/film/preview.h"
#include "renderer/film/resume_state.h"
#include "renderer/layers/certificate.h"
#include "renderer/plugin/call_plugin.h"
#include "renderer/render/interrupt.h"
#include "renderer/render/progress.h"
#include "renderer/render/resume_key.h"
#include "renderer/scene/scene_reader.h"

namespace rondure {
namespace {

constexpr std::int64_t most_samples = 1 << 30;
constexpr double most_stops = 100.0;
// Samples of a pass with --resume. After each the state may be saved, or the render interrupted.
constexpr std::uint32_t pass_samples = 4 * Film::chunk;
constexpr std::chrono::seconds save_interval{60};

std::optional<Window> read_crop(const std::string& text) {
  if (text.empty()) return {};
  Window w;
  const char *at = text.data(), *const end = at + text.size();
  bool good = true;
  for (int* number : {&w.x0, &w.y0, &w.x1, &w.y1}) {
    if (number != &w.x0) good = good && at != end && *at++ == ',';
    if (!good) break;
    const auto [next, error] = std::from_chars(at, end, *number);
    good = error == std::errc();
    at = next;
  }
  if (!good || at != end) {
    throw std::runtime_error(fmt::format("--crop wants x0,y0,x1,y1, four integers, not \"{}\"", text));
  }
  return w;
}

// Everything is read but the count of samples, which is no part of the scene's hash: a picture taken further
// is of the same scene.
Scene read(const Registry& registry, const RenderCommand& options) {
  SceneOverrides overrides = options.scene.overrides;
  overrides.spp.reset();
  Scene scene = read_scene(options.scene.path, registry, overrides);
  if (const auto spp = options.scene.overrides.spp) {
    if (*spp < 1 || *spp > most_samples) {
      throw std::runtime_error(fmt::format("--spp must be in [1, {}], not {}", most_samples, *spp));
    }
    scene.sampling.spp = static_cast<int>(*spp);
  }
  return scene;
}

// One pass over the picture, or with --resume several and a state file, marked with `key`, beside the output.
void render_film(Film& film, const Scene& scene, const World& world, RenderOptions render,
                 const std::string& key, const RenderCommand& options) {
  const auto target = static_cast<std::uint32_t>(scene.sampling.spp);
  const std::string state = resume_path(options.output);
  if (options.resume && !read_resume_state(state, key, film)) check_writable(state);
  if (film.samples > target) {
    throw std::runtime_error(
        fmt::format("{}: already holds {} samples a pixel, more than the {} asked for; raise --spp", state,
                    film.samples, target));
  }
  const std::uint32_t left = target - film.samples;
  const std::uint32_t step = options.resume ? pass_samples : std::max(left, 1u);
  const std::uint32_t passes = std::max(1u, (left + step - 1) / step);
  Progress progress(fmt::format("{} spp", target), film.whole.size() * passes, progress_style(options.quiet));
  render.progress = [&](std::size_t pixels) { progress.advance(pixels); };
  // With --resume a pass is brought to its end, so that its work can be kept.
  if (!options.resume) render.stop = [] { return interrupted(); };

  const InterruptGuard guard;
  auto saved = std::chrono::steady_clock::now();
  do {
    const std::uint32_t next = target - film.samples > step ? film.samples + step : target;
    add_samples(film, next, scene, world, render);
    if (!options.resume) continue;
    const auto now = std::chrono::steady_clock::now();
    if (interrupted() || film.samples == target || now - saved > save_interval) {
      write_resume_state(state, key, film);
      saved = now;
    }
    if (interrupted() && film.samples < target) {
      progress.clear();
      throw std::runtime_error(
          fmt::format("interrupted; {} samples a pixel are kept in {}", film.whole_samples(), state));
    }
  } while (film.samples < target);
}

// A name that promises another format of pictures than the one that is written is a mistake.
void refuse_other_format(const std::string& path, std::string_view written, const char* advice) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const std::string_view known :
       {".exr", ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".hdr", ".pfm", ".ppm", ".bmp", ".tga"})
    if (ending == known && known != written) throw std::runtime_error(fmt::format("{}: {}", path, advice));
}

// What the preview is to tell of its colours: asked for, and checked, before the work.
std::optional<Legend> legend_of(const Scene& scene) {
  const std::string who = fmt::format("the integrator \"{}\"", scene.integrator_name);
  std::optional<Legend> legend;
  try {
    legend = scene.integrator->legend();
  } catch (...) {
    throw std::runtime_error(who + " " + plugin_failure());
  }
  if (legend) check_legend(*legend, who);
  return legend;
}

void note(const RenderCommand& options, const std::string& text) {
  if (!options.quiet) std::fputs((text + "\n").c_str(), stderr);  // fmt::print throws where nobody listens
}

}  // namespace

void run_render(const Registry& registry, RenderCommand options) {
  const auto start = std::chrono::steady_clock::now();
  RenderOptions settings;
  settings.threads = options.threads;
  settings.crop = read_crop(options.crop);
  if (!(std::abs(options.exposure) <= most_stops)) {
    throw std::runtime_error(
        fmt::format("--exposure must be in [-{0}, {0}], not {1}", most_stops, options.exposure));
  }
  if (options.output.empty()) {
    options.output = std::filesystem::path(options.scene.path).stem().string() + ".exr";
  }
  for (const std::string& path : {options.output, options.png}) {
    if (path == "-")
      throw std::runtime_error("a picture does not go to standard output; name a file, or ./-");
  }
  Scene scene = read(registry, options);
  std::vector<NamedPath> outputs = {{"the output (-o)", options.output}};
  if (!options.png.empty()) outputs.push_back({"the preview (--png)", options.png});
  if (options.resume) outputs.push_back({"the state to resume from (--resume)", resume_path(options.output)});
  refuse_equal_paths(input_paths(scene), outputs);
  refuse_other_format(options.output, ".exr", "-o writes OpenEXR; for a PNG there is --png");
  refuse_other_format(options.png, ".png", "--png writes PNG; for OpenEXR there is -o");
  Film film = make_film(scene, settings);
  check_writable(options.output);
  std::optional<Legend> legend;
  if (!options.png.empty()) {
    check_writable(options.png);
    require_image_module();
    legend = legend_of(scene);
  }
  const std::string key = options.resume ? resume_key(scene, film, registry.plugins()) : "";
  const std::string solvers = solver_names(scene);
  for (const std::string& warning : scene_warnings(scene)) note(options, warning);
  const Tracer tracer = tracer_of(scene);
  const World world = make_world(scene, tracer);
  render_film(film, scene, world, settings, key, options);

  ExrHeader header{scene.hash, scene.sampling.seed, scene.integrator_name, solvers, scene.camera};
  write_exr(options.output, film, header);
  if (!options.png.empty()) {
    std::vector<unsigned char> bytes = preview(film, options.exposure);
    int height = film.window().height();
    if (legend) height = append_legend(bytes, film.window().width(), height, *legend);
    write_png(options.png, film.window().width(), height, bytes);
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  note(options, fmt::format("{}: {} x {}, {} spp, {}", options.output, film.window().width(),
                            film.window().height(), film.samples, duration_text(elapsed.count())));
  if (const auto unresolved = unresolved_pixels(film, scene.film.layers))
    note(options, fmt::format("{}: {} of {} pixels without a certificate", options.output, *unresolved,
                              film.geometry.size()));
  if (film.rejected > 0) {
    throw std::runtime_error(
        fmt::format("{} of the picture's samples were negative, not finite or too large and count as black; "
                    "the picture in {} is not to be trusted",
                    film.rejected, options.output));
  }
}

}  // namespace rondure
