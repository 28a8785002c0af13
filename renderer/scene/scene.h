// A scene, read and checked: everything that a render needs, as values.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/api/integrator.h"
#include "renderer/api/params.h"
#include "renderer/camera/camera.h"
#include "renderer/film/film_settings.h"
#include "renderer/intersect/tracer.h"
#include "renderer/normals/estimator.h"
#include "renderer/shading/light.h"
#include "renderer/shading/material.h"

namespace rondure {

struct SamplingSettings {
  int spp = 64;
  std::uint64_t seed = 1;
};

struct SceneObject {
  std::string name;  // "objects[3]" unless the scene names it
  std::string type;
  TracedSurface traced;
  int material = 0;                        // index into Scene::materials
  std::optional<NormalEstimator> normals;  // that shade it; set once the scene is read
  SourcePosition where;
};

struct Scene {
  std::string path;
  std::shared_ptr<const SourceText> source;  // for messages; null when the scene is made by hand
  std::vector<std::string> files;            // that the scene refers to, by keys "file"
  std::uint64_t hash = 0;                    // of the file's bytes and of every override
  Camera camera;
  FilmSettings film;
  SamplingSettings sampling;
  std::string integrator_name;
  std::unique_ptr<Integrator> integrator;
  std::vector<Material> materials;
  std::vector<Light> lights;
  std::vector<SceneObject> objects;
  SourcePosition objects_where;  // of the list

  // Throws SceneError: what comes to light only when the scene is put to use, at its cause in the file.
  [[noreturn]] void fail(SourcePosition where, const std::string& message) const;
};

}  // namespace rondure
