#include "renderer/intersect/patched_spheres.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "renderer/intersect/ellipsoid_fit.h"
#include "renderer/parallel/parallel_for.h"

namespace rondure {
namespace {

// As many cells of all grids together, of 96 bytes and some microseconds a cell, from a side of `most_cells`
// down. Of fewer cells' starts more take a second step, which packets take if one ray of theirs does; more
// leave the nearer caches.
constexpr double cell_budget = 0x1p17;
constexpr int most_cells = 26, fewest_cells = 4;

struct Draft {
  const std::vector<Net>* nets;  // of the whole surface
  std::size_t surface;
  std::vector<std::size_t> which;  // of the nets
  PatchedSphere sphere;
  double rounding;  // of the nets' images, in roundoffs
  std::uint64_t key;
  std::size_t model = 0;  // the first draft of the same key
};

// What the first draft of a key is found to be.
struct Model {
  std::size_t followers = 0;  // later drafts of the key
  std::shared_ptr<const SpherePatches> patches;
  std::vector<Net> known;
};

std::vector<Net> images_of(const Draft& draft) {
  std::vector<Net> out;
  for (const std::size_t k : draft.which) out.push_back(image_of(draft.sphere, (*draft.nets)[k]));
  return out;
}

// Of numbers that no rotation of the unit sphere changes, but for rounding: that moves them across a step by
// chance only, and then nothing is shared.
class Key {
 public:
  void add(std::uint64_t x) { sum_ = ((sum_ ^ x) * 0x9e3779b97f4a7c15) ^ (sum_ >> 29); }
  void add_rounded(double x) {
    constexpr double aside = 0.3819660112501051;  // from numbers that are common
    add(static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(0x1p20 * x + aside))));
  }
  std::uint64_t value() const { return sum_; }

 private:
  std::uint64_t sum_ = 0;
};

std::uint64_t key_of(const Draft& draft) {
  Key key;
  dvec3 origin(0.0);
  for (const std::size_t k : draft.which) {
    const Net& net = (*draft.nets)[k];
    const std::vector<dvec4>& points = points_of(net);
    const auto* tensor = std::get_if<TensorNet>(&net);
    key.add(tensor ? static_cast<std::uint64_t>(64 * tensor->m + tensor->n) : points.size() << 32);
    const auto corner = [&](const dvec4& p) {
      return draft.sphere.ellipsoid.inverse * (dvec3(p) / p.w - draft.sphere.center);
    };
    const dvec3 first = corner(points.front()), last = corner(points.back());
    if (k == draft.which.front()) origin = first;
    key.add_rounded(glm::dot(first, last)), key.add_rounded(glm::dot(first, origin));
    key.add_rounded(points[1].w / std::sqrt(points.front().w * points.back().w));
  }
  return key.value();
}

std::vector<Draft> drafts_of(const std::vector<Net>& nets, std::size_t surface) {
  std::vector<Draft> out;
  for (EllipsoidFit& fit : fit_ellipsoids(nets)) {
    Draft draft{&nets, surface, std::move(fit.patches), {}, 1.0, 0};
    PatchedSphere& sphere = draft.sphere;
    sphere.center = fit.center, sphere.ellipsoid = Ellipsoid(fit.linear);
    sphere.error = ellipsoid_error(sphere.ellipsoid) + fit.off * sphere.ellipsoid.extent;
    // The square of its radius must be a number, too.
    if (const double r = sphere.ellipsoid.uniform_radius; r > smallest_radius && r < largest_radius)
      sphere.radius = r, sphere.inverse_radius = 1.0 / r;
    sphere.first = static_cast<std::int32_t>(draft.which.front());
    if (draft.which.back() - draft.which.front() + 1 != draft.which.size())
      sphere.named = true, sphere.names.assign(draft.which.begin(), draft.which.end());
    draft.rounding = 1.0 + glm::length(sphere.ellipsoid.inverse * sphere.center);
    draft.key = key_of(draft);
    out.push_back(std::move(draft));
  }
  return out;
}

void set_patches(std::shared_ptr<const SpherePatches> patches, PatchedSphere& sphere) {
  sphere.patches = std::move(patches);
  sphere.outward = sphere.patches->patches[0].outward;
  for (const SpherePatch& patch : sphere.patches->patches)
    if (patch.outward != sphere.outward) sphere.outward = 0.0;
}

// Nothing when there is no way back from its points to parameters.
Model model_of(const Draft& draft, int cells_a_side) {
  Model model;
  SpherePatches patches;
  if (build_sphere_patches(images_of(draft), draft.rounding, cells_a_side, patches, model.known))
    model.patches = std::make_shared<const SpherePatches>(std::move(patches));
  return model;
}

// Whether the draft is the model, turned.
bool follow(const Model& model, Draft& draft) {
  if (!model.patches) return false;
  const auto turn = turn_onto(*model.patches, model.known, images_of(draft), draft.rounding);
  if (!turn) return false;
  draft.sphere.turn = *turn, draft.sphere.turned = *turn != dmat3(1.0);
  set_patches(model.patches, draft.sphere);
  return true;
}

}  // namespace

SceneSpheres patched_spheres(const std::vector<const std::vector<Net>*>& surfaces) {
  std::vector<std::vector<Draft>> found(surfaces.size());
  parallel_for(surfaces.size(), [&](std::size_t k) {
    if (surfaces[k]) found[k] = drafts_of(*surfaces[k], k);
  });
  std::vector<Draft*> drafts;
  for (std::vector<Draft>& some : found)
    for (Draft& draft : some) drafts.push_back(&draft);

  // The first of each key, in the scene's order, is the others' model.
  std::unordered_map<std::uint64_t, std::size_t> firsts;
  std::vector<Model> models(drafts.size());
  for (std::size_t k = 0; k < drafts.size(); ++k) {
    drafts[k]->model = firsts.emplace(drafts[k]->key, k).first->second;
    if (drafts[k]->model != k) ++models[drafts[k]->model].followers;
  }
  const int cells =
      std::clamp(static_cast<int>(std::sqrt(cell_budget / static_cast<double>(6 * firsts.size() + 1))),
                 fewest_cells, most_cells);
  parallel_for(drafts.size(), [&](std::size_t k) {
    if (drafts[k]->model != k) return;
    const std::size_t followers = models[k].followers;
    models[k] = model_of(*drafts[k], cells);
    if (followers == 0) models[k].known = {};
    if (models[k].patches) set_patches(models[k].patches, drafts[k]->sphere);
  });
  parallel_for(drafts.size(), [&](std::size_t k) {
    Draft& draft = *drafts[k];
    if (draft.model == k || follow(models[draft.model], draft)) return;
    if (const Model own = model_of(draft, cells); own.patches) set_patches(own.patches, draft.sphere);
  });

  SceneSpheres out;
  out.spheres.reserve(drafts.size());
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const std::size_t first = out.spheres.size();
    SurfaceSpheres& surface = out.surfaces.emplace_back();
    if (!surfaces[k]) continue;
    surface.rest.assign(surfaces[k]->size(), true);
    for (Draft& draft : found[k]) {
      if (!draft.sphere.patches) continue;
      for (const std::size_t patch : draft.which) surface.rest[patch] = false;
      out.spheres.push_back(std::move(draft.sphere));
    }
    surface.spheres = {out.spheres.data() + first, out.spheres.size() - first};
  }
  return out;
}

}  // namespace rondure
