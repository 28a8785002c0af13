#include "renderer/intersect/newton.h"

#include <cmath>
#include <cstring>
#include <glm/common.hpp>

#include "renderer/bezier/dispatch.h"
#include "renderer/bezier/quotient.h"
#include "renderer/bezier/regular_normal.h"

namespace rondure {
namespace {

constexpr int step_limit = 16;  // of the patch; 2 or 3 are usual
#define COMPILED_FOR_EACH_SET "renderer/intersect/newton_kernel.h"
#include "renderer/intersect/each_set-inl.h"

}  // namespace

NewtonPatch newton_patch(const Net& net, [[maybe_unused]] Instructions set) {
  NewtonPatch patch;
  patch.points = points_of(net).data();
  if (const auto* t = std::get_if<TensorNet>(&net))
    patch.m = t->m, patch.n = t->n;
  else
    patch.m = std::get<TriangleNet>(net).n, patch.n = -1;
  dvec4 most(0.0);
  for (const dvec4& p : points_of(net)) most = glm::max(most, glm::abs(p));
  patch.noise = std::sqrt(3.0) * normal_noise(std::max(patch.m, patch.n), most.x + most.y + most.z);
  patch.on_leaf = baseline::kernel_for(patch);
#ifdef __x86_64__
  if (set == Instructions::avx2) patch.on_leaf = avx2::kernel_for(patch);
#endif
  return patch;
}

NewtonPatch newton_patch(const Net& net) { return newton_patch(net, best_instructions()); }

}  // namespace rondure
