// Newton against clipping on surfaces that are no spheres, and both against a root search that shares nothing
// with them: a fine grid of starts for plain Newton iteration.

#include <fmt/core.h>

#include <glm/geometric.hpp>
#include <random>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/solve_leaf.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

using namespace rondure;

namespace {

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// A wavy sheet over [-1, 1]^2 (or half of it) with weights from 1/2 to 2: rays meet it up to several times.
Net wavy_net(std::mt19937_64& random, bool tensor, int m, int n) {
  const auto point = [&](double x, double y) {
    const double z = uniform(random, -2.0, 2.0), w = std::exp2(uniform(random, -1.0, 1.0));
    return dvec4(x * w, y * w, z * w, w);
  };
  if (tensor) {
    TensorNet net(m, n);
    for (int i = 0; i <= m; ++i)
      for (int j = 0; j <= n; ++j) net.at(i, j) = point(2.0 * i / m - 1.0, 2.0 * j / n - 1.0);
    return net;
  }
  TriangleNet net(n);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n - i; ++j) net.at(i, j) = point(2.0 * i / n - 1.0, 2.0 * j / n - 1.0);
  return net;
}

Ray random_ray(std::mt19937_64& random) {
  const double ox = uniform(random, -3.0, 3.0), oy = uniform(random, -3.0, 3.0),
               oz = uniform(random, -3.0, 3.0);
  const double tx = uniform(random, -0.9, 0.9), ty = uniform(random, -0.9, 0.9),
               tz = uniform(random, -0.5, 0.5);
  const dvec3 origin(ox, oy, oz);
  return {origin, dvec3(tx, ty, tz) - origin};
}

// Distinct t of all roots that Newton's method reaches from a grid, parameters within the domain by `margin`.
std::vector<double> grid_roots(const Net& net, const Ray& ray) {
  const bool triangle = std::holds_alternative<TriangleNet>(net);
  const dvec3 d = glm::normalize(ray.direction),
              a = glm::normalize(glm::cross(d, std::fabs(d.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0))),
              b = glm::cross(d, a);
  std::vector<double> found;
  constexpr int grid = 24;
  for (int i = 0; i <= grid; ++i)
    for (int j = 0; j <= (triangle ? grid - i : grid); ++j) {
      double u = double(i) / grid, v = double(j) / grid;
      for (int k = 0; k < 12; ++k) {
        const SurfaceJet s = surface_jet(net, u, v);
        const dvec3 r = s.point - ray.origin;
        const double fa = glm::dot(r, a), fb = glm::dot(r, b), au = glm::dot(s.du, a), av = glm::dot(s.dv, a),
                     bu = glm::dot(s.du, b), bv = glm::dot(s.dv, b), det = au * bv - av * bu;
        const double du = (fa * bv - fb * av) / det, dv = (fb * au - fa * bu) / det;
        u -= du, v -= dv;
        if (!(std::fabs(u) < 3.0) || !(std::fabs(v) < 3.0)) break;
        if (std::fmax(std::fabs(du), std::fabs(dv)) > 1e-14) continue;
        if (u < 0.0 || v < 0.0 || u > 1.0 || v > 1.0 || (triangle && u + v > 1.0)) break;
        const double t = glm::dot(net_point(net, u, v) - ray.origin, ray.direction) /
                         glm::dot(ray.direction, ray.direction);
        if (t < 0.0) break;
        bool known = false;
        for (const double other : found) known = known || std::fabs(other - t) < 1e-9;
        if (!known) found.push_back(t);
        break;
      }
    }
  return found;
}

}  // namespace

TEST_CASE("Newton, clipping and a grid of starts find the same roots of wavy patches", "[solvers]") {
  struct Degree {
    bool tensor;
    int m, n;
  };
  std::mt19937_64 random(3);
  const std::size_t given_up = thread_counts().search.exhausted;
  long rays = 0, hits = 0, several = 0, disagreements = 0, lost = 0;
  std::string worst = "none";
  WorstCase t;
  for (const Degree degree : {Degree{true, 1, 1},
                              {true, 2, 2},
                              {true, 2, 4},
                              {true, 3, 3},
                              {true, 4, 4},
                              {true, 5, 3},
                              {false, 0, 1},
                              {false, 0, 2},
                              {false, 0, 3},
                              {false, 0, 4},
                              {false, 0, 6},
                              {false, 0, 7}})
    for (int sheet = 0; sheet < 3; ++sheet) {
      Surface surface;
      surface.patches.push_back(wavy_net(random, degree.tensor, degree.m, degree.n));
      const Tracer newton({{surface, Solver::newton}}), clipping({{surface, Solver::clipping}});
      for (int k = 0; k < 120; ++k) {
        const Ray ray = random_ray(random);
        const std::vector<Hit> a = newton.all(ray), b = clipping.all(ray);
        ++rays;
        hits += static_cast<long>(a.size());
        several += a.size() > 1;
        const auto describe = [&] {
          return fmt::format(
              "degree ({}, {}){}, o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g}): {} and "
              "{}",
              degree.m, degree.n, degree.tensor ? "" : " triangle", ray.origin.x, ray.origin.y, ray.origin.z,
              ray.direction.x, ray.direction.y, ray.direction.z, a.size(), b.size());
        };
        if (a.size() != b.size()) {
          ++disagreements, worst = describe();
          continue;
        }
        for (std::size_t j = 0; j < a.size(); ++j)
          t.add(std::fabs(a[j].t - b[j].t), a[j].t_error + b[j].t_error, describe);
        for (const double root : grid_roots(surface.patches[0], ray)) {
          bool known = false;
          for (const Hit& hit : a) known = known || std::fabs(hit.t - root) < 1e-8;
          if (!known) ++lost, worst = describe();
        }
      }
    }
  INFO(rays << " rays, " << hits << " hits, " << several << " rays with several; " << worst);
  INFO("t: " << t.text());
  CHECK(disagreements == 0);
  CHECK(lost == 0);
  CHECK(t.failures() == 0);
  CHECK(thread_counts().search.exhausted == given_up);
  CHECK(hits > rays / 3);
  CHECK(several > rays / 20);
}
