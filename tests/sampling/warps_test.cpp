#include "renderer/sampling/warps.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/sampling/piecewise_constant.h"
#include "renderer/sampling/sampler.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// Mean of f over the unit square, midpoints of an n x n grid: an independent quadrature, with error O(1 /
// n^2) for the piecewise smooth integrands here (their second derivatives stay below 50: error below 50 / 12
// / n^2 an axis, and kinks along grid lines or diagonals add O(1 / n^2) as well).
constexpr int n = 512;
constexpr double tolerance = 100.0 / (n * n);

template <class F>
double mean(F f) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) sum += f(dvec2((i + 0.5) / n, (j + 0.5) / n));
  }
  return sum / (n * n);
}

TEST_CASE("warps have the moments of their distributions", "[sampling]") {
  // Disk: E x = 0, E x^2 = 1/4, E r^4 = 1/3, E xy = 0.
  CHECK(std::abs(mean([](dvec2 u) { return sample_disk(u).x; })) < tolerance);
  CHECK(std::abs(mean([](dvec2 u) { return std::pow(sample_disk(u).x, 2); }) - 0.25) < tolerance);
  CHECK(std::abs(mean([](dvec2 u) { return std::pow(glm::length(sample_disk(u)), 4); }) - 1.0 / 3.0) <
        tolerance);
  CHECK(std::abs(mean([](dvec2 u) { return sample_disk(u).x * sample_disk(u).y; })) < tolerance);
  // Cosine: E z = 2/3, E z^2 = 1/2, E x^2 = 1/4.
  CHECK(std::abs(mean([](dvec2 u) { return sample_cosine_hemisphere(u).z; }) - 2.0 / 3.0) < tolerance);
  CHECK(std::abs(mean([](dvec2 u) { return std::pow(sample_cosine_hemisphere(u).z, 2); }) - 0.5) < tolerance);
  CHECK(std::abs(mean([](dvec2 u) { return std::pow(sample_cosine_hemisphere(u).x, 2); }) - 0.25) <
        tolerance);
  // Sphere: E of each squared coordinate is 1/3, of each fourth power 1/5.
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(std::abs(mean([=](dvec2 u) { return std::pow(sample_sphere(u)[axis], 2); }) - 1.0 / 3.0) <
          tolerance);
    CHECK(std::abs(mean([=](dvec2 u) { return std::pow(sample_sphere(u)[axis], 4); }) - 0.2) < tolerance);
  }
}

TEST_CASE("warps give unit vectors", "[sampling]") {
  WorstCase worst;
  for (int i = 0; i < 10000; ++i) {
    Sampler sampler(1, i, 0, 0);
    const dvec2 uv = sampler.next_2d();
    const auto describe = [&] { return std::to_string(uv.x) + " " + std::to_string(uv.y); };
    // Squares of rounded coordinates and a rounded root: some eps.
    worst.add(std::abs(glm::length(sample_sphere(uv)) - 1.0), 8 * eps, describe);
    worst.add(std::abs(glm::length(sample_cosine_hemisphere(uv)) - 1.0), 8 * eps, describe);
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("frames are orthonormal, right-handed and a function of the normal", "[sampling]") {
  WorstCase worst;
  const auto add = [&](const dvec3& normal) {
    const Frame f = frame_about(normal);
    const auto describe = [&] { return std::to_string(normal.x) + " " + std::to_string(normal.z); };
    // The published error of the construction is a few eps; the normal's own |n| - 1 of 2 eps comes on top.
    for (const double e : {glm::length(f.x) - 1.0, glm::length(f.y) - 1.0, glm::dot(f.x, f.y),
                           glm::dot(f.x, f.z), glm::dot(f.y, f.z), glm::length(glm::cross(f.x, f.y) - f.z)}) {
      worst.add(std::abs(e), 16 * eps, describe);
    }
    const dvec3 v(0.1, -0.7, 0.3);
    worst.add(glm::length(f.to_world(f.to_local(v)) - v), 16 * eps, describe);
  };
  for (int i = 0; i < 20000; ++i) add(sample_sphere(Sampler(2, i, 0, 0).next_2d()));
  for (const double z : {1.0, -1.0}) {
    add({0, 0, z});
    for (const double e : {1e-3, 1e-8, 1e-12, 1e-200}) add(glm::normalize(dvec3(e, -0.5 * e, z)));
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(frame_about({1, 0, 0.0}).x == frame_about({1, 0, -0.0}).x);
}

TEST_CASE("the piecewise-constant distribution draws cells in proportion to their values", "[sampling]") {
  const std::vector<double> values = {0, 1, 2, 0, 5, 0, 0, 0, 0, 0, 3, 9};  // 4 wide, 3 high, an empty corner
  const PiecewiseConstant2d distribution(4, 3, values);
  CHECK(distribution.mean() == Approx(20.0 / 12.0));
  std::vector<double> found(12, 0.0);
  constexpr int side = 400;
  int disagreements = 0;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const auto s = distribution.sample({(i + 0.5) / side, (j + 0.5) / side});
      found[static_cast<std::size_t>(int(s.position.y * 3) * 4 + int(s.position.x * 4))] +=
          1.0 / (side * side);
      disagreements += s.density != distribution.density(s.position) || !(s.density > 0.0);
    }
  }
  CHECK(disagreements == 0);
  // A grid of side^2 points cuts a cell's boundary once a line: each share is good to a line either way on
  // each axis.
  for (std::size_t i = 0; i < values.size(); ++i) CHECK(std::abs(found[i] - values[i] / 20.0) < 4.0 / side);
  CHECK(mean([&](dvec2 u) { return distribution.density(u); }) ==
        Approx(1.0).epsilon(1e-2));  // cell edges off the grid
  const PiecewiseConstant2d black(2, 2, {0, 0, 0, 0});
  CHECK(black.density({0.3, 0.9}) == 1.0);
}

}  // namespace
}  // namespace rondure
