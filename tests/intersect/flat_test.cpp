// Rays in the plane of a flat patch, up to rounding: one hit or none, and its t known no better than it is.

#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "renderer/bezier/quotient.h"
#include "renderer/bezier/rational.h"
#include "renderer/intersect/certificate.h"
#include "tests/catch.h"
#include "tests/intersect/random_direction.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

// A plane of small integers: all control points are in it without rounding, up to weights that are powers
// of 2.
constexpr dvec3 corner(-3.0, 2.0, -1.0), along_u(7.0, 1.0, 2.0), along_v(-2.0, 5.0, 4.0);

dvec4 control_point(double a, double b, double weight) {
  return dvec4(weight * (corner + a * along_u + b * along_v), weight);
}

TriangleNet flat_triangle(int degree) {
  TriangleNet net(degree);
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; j <= degree - i; ++j) {
      // Moved in the plane, so that the parametrisation is no affine map.
      const double bulge = degree > 1 && i == 1 ? 0.125 : 0.0, n = degree == 3 ? 4.0 : degree;
      net.at(i, j) = control_point(i / n + bulge, j / n, degree > 1 && j == 1 ? 2.0 : 1.0);
    }
  return net;
}

TensorNet flat_quad(int m, int n) {
  TensorNet net(m, n);
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j <= n; ++j)
      net.at(i, j) =
          control_point(i / double(m) + 0.25 * j, j / double(n) + 0.125 * i * j, i == j ? 1.0 : 0.5);
  return net;
}

// Where the ray passes the plane, in quadruple precision.
double exact_t(const Ray& ray) {
  using Quad = __float128;
  const dvec3 n = glm::cross(along_u, along_v);
  Quad above = 0, rate = 0;
  for (int k = 0; k < 3; ++k) {
    above += static_cast<Quad>(n[k]) * (static_cast<Quad>(corner[k]) - static_cast<Quad>(ray.origin[k]));
    rate += static_cast<Quad>(n[k]) * static_cast<Quad>(ray.direction[k]);
  }
  return static_cast<double>(quotient(above, rate));
}

}  // namespace

TEST_CASE("A ray in the plane of a flat patch meets it once or not", "[hits][certificate]") {
  std::mt19937_64 random(43);
  const auto draw = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
  const dvec3 normal = glm::normalize(glm::cross(along_u, along_v));
  long rays = 0, hits = 0, several = 0, missed = 0, certified = 0;
  std::string worst = "none";
  WorstCase t, proven;
  for (const Net& net : {Net(flat_triangle(1)), Net(flat_triangle(2)), Net(flat_triangle(3)),
                         Net(flat_quad(1, 1)), Net(flat_quad(2, 1)), Net(flat_quad(2, 2))})
    for (const Solver solver : {Solver::newton, Solver::clipping}) {
      Surface surface;
      surface.patches = {net};
      const Tracer tracer({{surface, solver}});
      const Certifier certifier(tracer);
      for (int k = 0; k < 1500; ++k) {
        const double u = 0.15 + 0.35 * draw(), v = 0.15 + 0.35 * draw();
        const dvec3 middle = net_point(net, u, v);
        // Across the plane at angles from 10^-18 to 10^-2.
        const dvec3 way = glm::normalize(glm::cross(normal, random_direction(random)));
        const double tilt = std::pow(10.0, -2.0 - 16.0 * draw()) * (draw() < 0.5 ? -1.0 : 1.0);
        const dvec3 d = way + tilt * normal;
        const Ray ray{middle - (20.0 + 20.0 * draw()) * d, d};
        const std::vector<Hit> all = tracer.all(ray);
        const double exact = exact_t(ray);
        const auto describe = [&] {
          return fmt::format(
              "tilt {:.3g}, {} hits, o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g})", tilt,
              all.size(), ray.origin.x, ray.origin.y, ray.origin.z, d.x, d.y, d.z);
        };
        ++rays, hits += static_cast<long>(all.size());
        if (all.size() > 1) ++several, worst = describe();
        // A roundoff of the origin, some 40 off, moves the crossing by less than the patch from here on.
        if (std::fabs(tilt) > 1e-12 && all.empty()) ++missed, worst = describe();
        const Hit first = tracer.closest(ray);
        if (!first) continue;
        t.add(std::fabs(first.t - exact), first.t_error + 0x1p-52 * std::fabs(exact), describe);
        if (const Certificate c = certifier.certify(ray, first)) {
          ++certified;
          proven.add(std::fabs(first.t - exact), c.t_error + 0x1p-52 * std::fabs(exact), describe);
        }
      }
    }
  INFO(rays << " rays, " << hits << " hits; " << several << " with several, " << missed
            << " missed; the last: " << worst);
  INFO("t: " << t.text());
  INFO("certified: " << proven.text());
  CHECK(several == 0);
  CHECK(missed == 0);
  CHECK(t.failures() == 0);
  CHECK(proven.failures() == 0);
  CHECK(hits > rays / 2);
  CHECK(hits < rays);
  CHECK(certified > hits / 2);
}

}  // namespace rondure
