#include "renderer/normals/normal_field.h"

#include <glm/geometric.hpp>
#include <mutex>
#include <vector>

#include "renderer/bezier/rational.h"
#include "renderer/normals/direction.h"

namespace rondure {
namespace {

struct Patch {
  std::once_flag quadric_once, hodograph_once;
  std::optional<PatchQuadric> quadric;
  ReducedNormal hodograph;
};

}  // namespace

struct NormalField::Known {
  std::once_flag whole_once;
  std::optional<ImplicitQuadric> whole;  // of all patches
  std::vector<Patch> patches;

  explicit Known(std::size_t count) : patches(count) {}
};

NormalField::NormalField(const Surface& surface)
    : surface_(&surface), known_(std::make_unique<Known>(surface.patches.size())) {}

NormalField::~NormalField() = default;
NormalField::NormalField(NormalField&&) noexcept = default;
NormalField& NormalField::operator=(NormalField&&) noexcept = default;

const PatchQuadric* NormalField::quadric(int patch) const {
  if (surface_->patches.empty()) return nullptr;
  std::call_once(known_->whole_once, [&] { known_->whole = quadric_through(surface_->patches); });
  Patch& known = known_->patches[static_cast<std::size_t>(patch)];
  std::call_once(known.quadric_once, [&] {
    const Net& net = surface_->patches[static_cast<std::size_t>(patch)];
    const std::optional<ImplicitQuadric> q = known_->whole ? known_->whole : quadric_through({net});
    if (!q) return;
    // The sign of a place in general position, where the normal is sure.
    const double u = 0.37, v = 0.41;
    const double along = glm::dot(q->gradient(net_point(net, u, v)), unit_normal(net, u, v));
    known.quadric = PatchQuadric{*q, along < 0.0 ? -1.0 : 1.0};
  });
  return known.quadric ? &*known.quadric : nullptr;
}

NormalEstimate NormalField::at(NormalEstimator estimator, int patch, double u, double v) const {
  const Net& net = surface_->patches[static_cast<std::size_t>(patch)];
  switch (estimator) {
    case NormalEstimator::limit:
      return limit_normal(net, u, v);
    case NormalEstimator::cross:
      return cross_normal(net, u, v);
    case NormalEstimator::cross_float:
      return cross_float_normal(net, u, v);
    case NormalEstimator::taylor:
      return taylor_normal(net, u, v);
    case NormalEstimator::shift:
      return shift_normal(net, u, v);
    case NormalEstimator::hodograph: {
      Patch& known = known_->patches[static_cast<std::size_t>(patch)];
      std::call_once(known.hodograph_once, [&] { known.hodograph = reduced_normal(normal_directions(net)); });
      const NormalEstimate n = hodograph_normal(known.hodograph, u, v);
      // The normal polynomial carries the sign of w^3.
      return n && points_of(net).front().w < 0.0 ? NormalEstimate(-*n) : n;
    }
    case NormalEstimator::analytic: {
      const PatchQuadric* q = quadric(patch);
      if (!q) return {};
      return direction_of(q->sign * q->quadric.gradient(net_point(net, u, v)));
    }
  }
  return {};
}

NormalEstimate NormalField::at(NormalEstimator estimator, const Hit& hit) const {
  if (surface_->patches.empty()) return hit.normal;
  return at(estimator, hit.patch, hit.u, hit.v);
}

}  // namespace rondure
