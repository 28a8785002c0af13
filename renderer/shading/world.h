// What an integrator may ask: the surfaces, their materials, and all light, with its sampling.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "renderer/intersect/passed_walls.h"
#include "renderer/intersect/tracer.h"
#include "renderer/normals/normal_field.h"
#include "renderer/shading/light.h"
#include "renderer/shading/material.h"

namespace rondure {

// One direction toward light, as seen from a point.
struct LightSample {
  dvec3 direction{0.0};  // unit, from the point to the light
  double distance = std::numeric_limits<double>::infinity();
  dvec3 radiance{0.0};  // arriving if unoccluded; of a delta light: radiance integrated over its directions
  double pdf = 0.0;  // per solid angle, choice of light included; of a delta light: the choice's probability
  bool delta = false;  // point or directional: no scattering sample can meet it
  int surface = -1;    // the emissive surface, or -1
};

// A light whose image is of no use.
struct LightError : std::runtime_error {
  LightError(std::size_t index, const std::string& why) : std::runtime_error(why), light(index) {}

  std::size_t light;
};

class Certifier;

class World {
 public:
  // `material_of_surface[i]` is the index of the material of the tracer's surface i. The tracer must outlive
  // the world. Reads environment images; throws LightError that names the file. Without estimators every
  // surface is shaded by the limit normal.
  World(const Tracer& tracer, std::vector<Material> materials, std::vector<Light> lights,
        std::vector<int> material_of_surface, std::vector<NormalEstimator> normals_of_surface = {});
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  const Tracer& tracer() const { return *tracer_; }
  // What proves its hits; made when it is first asked for, by any thread.
  const Certifier& certifier() const;
  // The material at the hit: that of its surface, coloured by curvature if it asks for that, or of a
  // parameter line drawn there. Ask once a hit.
  Material material(const Hit& hit) const;

  // The normal that light is scattered by at a hit: that of the surface's estimator, or zero where it comes
  // to nothing; there no light is scattered. By default it is the hit's own, which is the limit, or where
  // none exists that along one way in. All that is geometry (which side a ray leaves, what it leaves out)
  // goes by the hit's.
  dvec3 shading_normal(const Hit& hit) const;
  NormalEstimator estimator(int surface) const {
    return estimators_.empty() ? NormalEstimator::limit : estimators_[static_cast<std::size_t>(surface)];
  }
  const NormalField& normals(int surface) const { return fields_[static_cast<std::size_t>(surface)]; }

  // Radiance that leaves the hit toward `out` (unit) by emission.
  dvec3 emitted(const Hit& hit, const dvec3& out) const;
  // Radiance arriving from infinity against `direction` (unit, the way that the ray goes).
  dvec3 background(const dvec3& direction) const;

  // A light sample for a surface point; pdf 0 when there is no light or the sample came to nothing.
  LightSample sample_light(const dvec3& point, double choice, dvec2 uv) const;
  // Density, per solid angle at `point`, with which sample_light draws the direction of `hit` or of the
  // background.
  double light_pdf(const dvec3& point, const Hit& hit) const;
  double background_pdf(const dvec3& direction) const;
  // Whether nothing stands between a hit and the light of a sample that was drawn for it.
  bool visible(const Hit& from, const LightSample& sample, const PassedWalls& passed = {}) const;

 private:
  struct Lights;
  struct Proofs;

  const Tracer* tracer_;
  std::vector<Material> materials_;
  std::vector<Material> inks_;  // of the parameter lines of each material
  std::vector<int> material_of_surface_;
  std::vector<NormalEstimator> estimators_;
  std::vector<NormalField> fields_;
  std::unique_ptr<Lights> lights_;
  std::unique_ptr<Proofs> proofs_;
};

// The ray that leaves a hit, with its own root at t = 0 left out, and the walls that its path has come
// through there; these must outlive it.
inline Ray spawn(const Hit& from, const dvec3& direction, const PassedWalls& passed,
                 double t_max = std::numeric_limits<double>::infinity()) {
  return Ray{from.point, direction, 0.0, t_max,
             RayStart{from.surface, from.normal, passed.empty() ? nullptr : &passed}};
}

}  // namespace rondure
