#include "renderer/intersect/newton.h"

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "renderer/bezier/dispatch.h"
#include "renderer/bezier/quotient.h"

namespace rondure {
namespace {

constexpr int step_limit = 16;  // of the patch; 2 or 3 are usual
// Of what must be below 1 for there to be one root at most: somewhat below, Newton's method finds it.
constexpr double uniqueness_limit = 0.9;
constexpr double straight_limit = 0.5;
// Below 1/3 the distance from a root of the leaf cannot grow in a step.
constexpr double contraction_limit = 0.3;

namespace baseline {
#define FOR_THIS_SET
#define POINT_IN_ONE_REGISTER 0
#include "renderer/intersect/newton_kernel.h"
#undef FOR_THIS_SET
#undef POINT_IN_ONE_REGISTER
}  // namespace baseline

#ifdef __x86_64__
#pragma GCC push_options
#pragma GCC target("avx2")
namespace avx2 {
#define POINT_IN_ONE_REGISTER 1
#define FOR_THIS_SET __attribute__((target("avx2")))
#include "renderer/intersect/newton_kernel.h"
#undef FOR_THIS_SET
#undef POINT_IN_ONE_REGISTER
}  // namespace avx2
#pragma GCC pop_options
#endif

using Kernel = NewtonVerdict (*)(const Leaf&, const Net&, const LocalRay&, double, NewtonRoot&,
                                 NewtonCounts&) noexcept;

Kernel kernel_for(Instructions set) {
#ifdef __x86_64__
  if (set == Instructions::avx2) return avx2::on_leaf;
#endif
  return baseline::on_leaf;
}

Instructions best() { return has(Instructions::avx2) ? Instructions::avx2 : Instructions::baseline; }

const Kernel kernel = kernel_for(best());

}  // namespace

bool has([[maybe_unused]] Instructions set) {
#ifdef __x86_64__
  if (set == Instructions::avx2) return __builtin_cpu_supports("avx2") != 0;
#endif
  return set == Instructions::baseline;
}

NewtonVerdict newton_on_leaf(const Leaf& leaf, const Net& net, const LocalRay& ray, double error,
                             NewtonRoot& out, NewtonCounts& counts) noexcept {
  ++counts.leaves;
  const NewtonVerdict verdict = kernel(leaf, net, ray, error, out, counts);
  if (verdict == NewtonVerdict::undecided) ++counts.undecided;
  return verdict;
}

NewtonVerdict newton_on_leaf(Instructions set, const Leaf& leaf, const Net& net, const LocalRay& ray,
                             double error, NewtonRoot& out, NewtonCounts& counts) noexcept {
  return kernel_for(set)(leaf, net, ray, error, out, counts);
}

}  // namespace rondure
