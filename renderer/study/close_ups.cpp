#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>

#include "renderer/normals/estimator.h"
#include "renderer/sampling/warps.h"
#include "renderer/shading/color_map.h"
#include "renderer/study/corner_normals.h"
#include "renderer/study/picture.h"
#include "renderer/study/walk.h"

namespace rondure {
namespace {

std::string vector_text(const dvec3& v) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x, v.y, v.z); }

dvec3 vector_at(const Table& sites, std::size_t row, const char* x, const char* y, const char* z) {
  return {sites.number(row, x), sites.number(row, y), sites.number(row, z)};
}

// Straight down on the site, in light at 89 degrees to the normal: what turns the normal by an angle changes
// the light by 57 times that.
std::string scene_of(const Subject& subject, const dvec3& point, const dvec3& normal, double pixel,
                     int side) {
  const Frame frame = frame_about(normal);
  const double angle = 89.0 * std::numbers::pi / 180.0;
  const dvec3 light = std::cos(angle) * normal + std::sin(angle) * frame.x;
  const double irradiance = 0.5 * std::numbers::pi / (0.8 * std::cos(angle));  // makes the true radiance 0.5
  std::string object = subject.object;
  object.replace(object.find('{'), 1, "{ \"material\": \"white\",");
  return fmt::format(R"({{
  "camera": {{ "type": "orthographic", "origin": {}, "target": {}, "up": {}, "height": {:.17g} }},
  "film": {{ "resolution": [{}, {}], "filter": "box" }},
  "sampling": {{ "spp": 4, "seed": 1 }},
  "integrator": "direct",
  "materials": {{ "white": {{ "albedo": 0.8 }} }},
  "lights": [ {{ "type": "directional", "direction": {}, "irradiance": {:.17g} }} ],
  "objects": [ {} ]
}}
)",
                     vector_text(point + 2.0 * subject.size * normal), vector_text(point),
                     vector_text(frame.y), pixel * subject.size * side, side, side, vector_text(-light),
                     irradiance, object);
}

// What makes a picture of the normals' errors of the scene.
std::vector<std::string> error_settings(const std::string& reference) {
  return {
      fmt::format(
          R"(/integrator={{"type":"study","layer":"normal_error","channel":"{}","scale":"log","range":[1e-12,10]}})",
          reference),
      "/sampling/spp=1"};
}

// Of the colours of those pictures, below a white line.
std::string error_legend(const StudyFolder& folder) {
  Legend legend{"angle to the true normal (degrees)", 1e-12, 10.0, true, {}};
  for (int k = 0; k < 256; ++k) legend.colors.push_back(mapped_color("viridis", k / 255.0));
  constexpr int width = 384;
  return png_bytes(folder, std::vector<unsigned char>(3 * width, 255), width, 1, 1, &legend);
}

double largest_difference(const Film& a, const Film& b) {
  double worst = 0.0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const dvec3 d = a.mean(x, y).color - b.mean(x, y).color;
      worst = std::max({worst, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    }
  }
  return worst;
}

std::vector<double> pixels_of(const StudyOptions& options) {
  return options.quick ? std::vector{1e-4, 1e-8} : std::vector{1e-2, 1e-4, 1e-6, 1e-8};
}

// Pixels whose ray hits in one of the films only.
long hit_alone(const Film& a, const Film& b) {
  long alone = 0;
  for (std::size_t k = 0; k < a.geometry.size(); ++k)
    alone += (a.geometry[k].surface < 0) != (b.geometry[k].surface < 0);
  return alone;
}

// The surface as another solver meets it, made when first asked for.
class OtherTracer {
 public:
  explicit OtherTracer(const Tracer& tracer) : given_(tracer) {}

  const Tracer& get() {
    if (!made_)
      made_.emplace(std::vector{TracedSurface{given_.surfaces().front().surface, Solver::clipping}});
    return *made_;
  }

 private:
  const Tracer& given_;
  std::optional<Tracer> made_;
};

// Pictures of one scene by every estimator, taken when first asked for.
class Taker {
 public:
  Taker(const std::string& scene, std::string file, const Registry& registry, const Tracer& tracer,
        OtherTracer& other)
      : scene_(scene), file_(std::move(file)), registry_(registry), tracer_(tracer), other_(other) {}

  Film shaded(const std::string& normals) const {
    SceneOverrides overrides;
    overrides.normals = normals;
    return take_picture(scene_, file_, registry_, tracer_, overrides);
  }
  Film error(const std::string& normals, const std::string& reference) const {
    SceneOverrides overrides;
    overrides.normals = normals;
    overrides.set = error_settings(reference);
    return take_picture(scene_, file_, registry_, tracer_, overrides);
  }
  const Film& truth(const std::string& reference) {
    if (!truth_) truth_ = shaded(reference);
    return *truth_;
  }
  // By clipping, the solver that takes nothing for granted.
  const Film& checked() {
    SceneOverrides overrides;
    overrides.set = {"/sampling/spp=1"};
    if (!checked_) checked_ = take_picture(scene_, file_, registry_, other_.get(), overrides);
    return *checked_;
  }

 private:
  const std::string& scene_;
  std::string file_;
  const Registry& registry_;
  const Tracer& tracer_;
  OtherTracer& other_;
  std::optional<Film> truth_, checked_;
};

// "off missed rejected" as text.
std::string counts_of(const Film& shaded, const Film& truth, const Film& checked) {
  return fmt::format("{:.17g} {} {}", largest_difference(shaded, truth), hit_alone(shaded, checked),
                     shaded.rejected);
}

}  // namespace

std::size_t close_ups_a_site(const StudyOptions& options) {
  return estimator_names().size() * pixels_of(options).size();
}

CloseUps take_close_ups(const Subject& subject, const Registry& registry, const Table& sites, std::size_t row,
                        const std::string& group, const StudyFolder& folder, const StudyOptions& options,
                        const std::function<void()>& done) {
  const dvec3 point = vector_at(sites, row, "x", "y", "z"), normal = vector_at(sites, row, "ax", "ay", "az");
  const int side = options.quick ? 16 : 48, zoom = 96 / side;
  const std::vector<double> pixels = pixels_of(options);
  const std::string stem = fmt::format("{}-{}", subject.name, sites.at(row, "site"));
  const Tracer tracer = tracer_for(scene_of(subject, point, normal, pixels.front(), side), stem, registry);
  const NormalField field(tracer.surfaces().front().surface);
  OtherTracer other(tracer);
  SingularSite site;
  site.patch = static_cast<int>(sites.number(row, "patch"));
  site.point = point;  // no subject is moved
  CloseUps result;
  result.family = subject.name, result.group = group;
  result.reference = estimator_names()[static_cast<std::size_t>(reference_at(field, site))];
  for (const double pixel : pixels) {
    const std::string scene = scene_of(subject, point, normal, pixel, side);
    const std::string file = fmt::format("{}-{:.0e}.json", stem, pixel);
    folder.write(file, scene);
    Taker taker(scene, file, registry, tracer, other);
    for (const std::string& name : estimator_names()) {
      if (name == "analytic" && !field.quadric(site.patch)) {
        done();
        continue;
      }
      const std::string part = fmt::format("parts/{}-{:.0e}-{}", stem, pixel, name), key = scene + name;
      std::optional<Film> film;
      const auto shaded = [&]() -> const Film& {
        if (!film) film = taker.shaded(name);
        return *film;
      };
      CloseUp picture;
      picture.estimator = name;
      picture.pixel = pixel;
      picture.shaded = folder.kept(part + ".png", key, [&] { return png_bytes(folder, shaded(), zoom); });
      picture.error = folder.kept(part + "-error.png", key, [&] {
        return png_bytes(folder, taker.error(name, result.reference), zoom);
      });
      std::istringstream(
          folder.kept(part + ".txt", key,
                      [&] { return counts_of(shaded(), taker.truth(result.reference), taker.checked()); })) >>
          picture.off >> picture.missed >> picture.rejected;
      result.pictures.push_back(std::move(picture));
      done();
    }
  }
  result.shaded_command = fmt::format("rondure render {}-{:.0e}.json --normals {} --png close-up.png", stem,
                                      pixels.front(), estimator_names().front());
  result.legend = error_legend(folder);
  const std::vector<std::string> settings = error_settings(result.reference);
  result.error_command =
      fmt::format("{} --set '{}' --set {}", result.shaded_command, settings[0], settings[1]);
  std::stable_sort(result.pictures.begin(), result.pictures.end(), [](const CloseUp& a, const CloseUp& b) {
    return *estimator_named(a.estimator) < *estimator_named(b.estimator);
  });
  return result;
}

}  // namespace rondure
