#include "renderer/shading/world.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <mutex>
#include <numbers>
#include <optional>
#include <utility>

#include "renderer/intersect/certificate.h"
#include "renderer/shading/environment.h"
#include "renderer/shading/surface_light.h"

namespace rondure {
namespace {

using std::numbers::pi;

struct ImageLight {
  Environment image;
  dvec3 scale;
  dmat3 to_world;

  dvec3 local(const dvec3& direction) const { return glm::transpose(to_world) * direction; }
};

Environment read_environment(const std::string& file, std::size_t light) {
  try {
    return Environment(read_image(file));
  } catch (const std::runtime_error& error) {
    throw LightError(light, error.what());
  } catch (const std::bad_alloc&) {
    throw LightError(light, file + ": there is not enough memory for the image");
  }
}

struct AreaLight {
  SurfaceLight points;
  int surface;
  dvec3 radiance;
};

}  // namespace

// What sample_light chooses from, in this order: images, areas, points, directionals. Constant lights are not
// sampled: scattering samples find them at least as well.
struct World::Lights {
  std::vector<ImageLight> images;
  std::vector<AreaLight> areas;
  std::vector<PointLight> points;
  std::vector<DirectionalLight> directionals;
  dvec3 constant{0.0};
  std::vector<int> area_of_surface;  // index into areas, or -1
  std::vector<double> probability, cumulative;

  std::size_t first_area() const { return images.size(); }
  std::size_t first_point() const { return first_area() + areas.size(); }
  std::size_t first_directional() const { return first_point() + points.size(); }

  double background_pdf(const dvec3& direction) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < images.size(); ++i) {
      sum += probability[i] * images[i].image.pdf(images[i].local(direction));
    }
    return sum;
  }

  void weigh(double radius) {
    // Powers in watts (to a common factor) over the scene's own extent; half of all choices are uniform, so
    // that no light starves where the powers mislead.
    std::vector<double> power;
    const double disk = pi * radius * radius;
    for (const ImageLight& l : images)
      power.push_back(disk * 4.0 * pi * l.image.mean_luminance() * luminance(l.scale));
    for (const AreaLight& l : areas) power.push_back(pi * l.points.area() * luminance(l.radiance));
    for (const PointLight& l : points) power.push_back(4.0 * pi * luminance(l.intensity));
    for (const DirectionalLight& l : directionals) power.push_back(disk * luminance(l.irradiance));
    double total = 0.0;
    for (const double p : power) total += p;
    const auto count = static_cast<double>(power.size());
    cumulative.assign(1, 0.0);
    for (const double p : power) {
      probability.push_back(total > 0.0 ? 0.5 / count + 0.5 * p / total : 1.0 / count);
      cumulative.push_back(cumulative.back() + probability.back());
    }
  }
};

struct World::Proofs {
  std::once_flag once;
  std::optional<Certifier> certifier;
};

World::World(const Tracer& tracer, std::vector<Material> materials, std::vector<Light> lights,
             std::vector<int> material_of_surface, std::vector<NormalEstimator> normals_of_surface)
    : tracer_(&tracer),
      materials_(std::move(materials)),
      material_of_surface_(std::move(material_of_surface)),
      estimators_(std::move(normals_of_surface)),
      lights_(std::make_unique<Lights>()),
      proofs_(std::make_unique<Proofs>()) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const Light& light = lights[i];
    if (const auto* constant = std::get_if<ConstantLight>(&light)) lights_->constant += constant->radiance;
    if (const auto* point = std::get_if<PointLight>(&light)) lights_->points.push_back(*point);
    if (const auto* far = std::get_if<DirectionalLight>(&light)) lights_->directionals.push_back(*far);
    if (const auto* image = std::get_if<EnvironmentLight>(&light)) {
      lights_->images.push_back({read_environment(image->file, i), image->scale, image->to_world});
    }
  }
  const std::vector<TracedSurface>& surfaces = tracer.surfaces();
  for (const TracedSurface& traced : surfaces) fields_.emplace_back(traced.surface);
  lights_->area_of_surface.assign(surfaces.size(), -1);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Material& m = materials_[static_cast<std::size_t>(material_of_surface_[i])];
    if (!emits(m)) continue;
    lights_->area_of_surface[i] = static_cast<int>(lights_->areas.size());
    lights_->areas.push_back({SurfaceLight(surfaces[i].surface), static_cast<int>(i), m.emission});
  }
  lights_->weigh(tracer.bounding_radius());
  for (const Material& m : materials_) {
    inks_.push_back({Diffuse{m.isolines ? m.isolines->albedo : dvec3(0.0)}, m.emission, {}});
  }
}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

const Certifier& World::certifier() const {
  std::call_once(proofs_->once, [&] { proofs_->certifier.emplace(*tracer_); });
  return *proofs_->certifier;
}

Material World::material(const Hit& hit) const {
  const auto surface = static_cast<std::size_t>(hit.surface);
  const auto index = static_cast<std::size_t>(material_of_surface_[surface]);
  const Material& own = materials_[index];
  if (!own.isolines && !own.curvature) return own;
  const Surface& shape = tracer_->surfaces()[surface].surface;
  if (shape.patches.empty()) return own;
  const Net& net = shape.patches[static_cast<std::size_t>(hit.patch)];
  if (own.isolines && on_isoline(*own.isolines, net, hit.point - shape.origin, hit.u, hit.v))
    return inks_[index];
  Material here = own;
  if (own.curvature) {
    dvec3& shown = std::get<Diffuse>(here.scattering).albedo;
    shown = curvature_color(*own.curvature, net, hit.u, hit.v, shown);
  }
  return here;
}

dvec3 World::shading_normal(const Hit& hit) const {
  const NormalEstimator chosen = estimator(hit.surface);
  if (chosen == NormalEstimator::limit) return hit.normal;
  return normals(hit.surface).at(chosen, hit).value_or(dvec3(0.0));
}

dvec3 World::emitted(const Hit& hit, const dvec3& out) const {
  const auto surface = static_cast<std::size_t>(hit.surface);
  const Material& m = materials_[static_cast<std::size_t>(material_of_surface_[surface])];
  return emits(m) && glm::dot(hit.normal, out) > 0.0 ? m.emission : dvec3(0.0);
}

dvec3 World::background(const dvec3& direction) const {
  dvec3 sum = lights_->constant;
  for (const ImageLight& l : lights_->images) sum += l.scale * l.image.radiance(l.local(direction));
  return sum;
}

double World::background_pdf(const dvec3& direction) const { return lights_->background_pdf(direction); }

double World::light_pdf(const dvec3& point, const Hit& hit) const {
  const int area = lights_->area_of_surface[static_cast<std::size_t>(hit.surface)];
  if (area < 0) return 0.0;
  const auto index = static_cast<std::size_t>(area);
  return lights_->probability[lights_->first_area() + index] *
         lights_->areas[index].points.pdf_toward(point, hit);
}

LightSample World::sample_light(const dvec3& point, double choice, dvec2 uv) const {
  const Lights& all = *lights_;
  if (all.probability.empty()) return {};
  const auto above = std::upper_bound(all.cumulative.begin() + 1, all.cumulative.end() - 1, choice);
  const auto index = static_cast<std::size_t>(above - all.cumulative.begin()) - 1;
  LightSample result;
  if (index < all.first_area()) {
    const ImageLight& light = all.images[index];
    result.direction = glm::normalize(light.to_world * light.image.sample(uv).direction);
    // Any image may have sent this direction: take the light of all and the density of all.
    result.radiance = background(result.direction);
    result.pdf = background_pdf(result.direction);
    return std::isfinite(result.pdf) ? result : LightSample{};
  }
  result.pdf = all.probability[index];
  if (index >= all.first_directional()) {
    const DirectionalLight& light = all.directionals[index - all.first_directional()];
    result.delta = true;
    result.direction = -light.direction;
    result.radiance = light.irradiance;
    return result;
  }
  if (index >= all.first_point()) {
    const PointLight& light = all.points[index - all.first_point()];
    const dvec3 way = light.position - point;
    const double distance2 = glm::dot(way, way);
    if (!(distance2 > 0.0)) return {};
    result.delta = true;
    result.distance = std::sqrt(distance2);
    result.direction = way / result.distance;
    result.radiance = light.intensity / distance2;
    return result;
  }
  const AreaLight& light = all.areas[index - all.first_area()];
  const SurfaceLight::Direction target = light.points.sample_toward(point, uv);
  if (!(target.pdf > 0.0)) return {};
  result.direction = target.direction;
  result.distance = target.distance;
  result.surface = light.surface;
  result.radiance = light.radiance;
  result.pdf *= target.pdf;
  return std::isfinite(result.pdf) ? result : LightSample{};
}

bool World::visible(const Hit& from, const LightSample& sample, const PassedWalls& passed) const {
  // A sampled point lies on its surface to some ulps of its coordinates. 2^-30 of the distance clears those
  // for coordinates up to 10^6 distances, and hides nothing that a picture could show.
  const double reach = sample.surface >= 0 ? sample.distance * (1.0 - 0x1p-30) : sample.distance;
  return !tracer_->occluded(spawn(from, sample.direction, passed, reach));
}

}  // namespace rondure
