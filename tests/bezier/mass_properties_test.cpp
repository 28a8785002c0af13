// Areas, volumes, centroids and inertia: closed forms, polynomial integration, another quadrature, and
// whether the bounds on their errors are true.
#include "renderer/bezier/mass_properties.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/patch_integrals.h"
#include "renderer/bezier/product.h"
#include "renderer/bezier/rational.h"
#include "renderer/bezier/transform.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

constexpr double pi = std::numbers::pi;

Surface moved(Surface surface, const dmat4& map) {
  for (Net& net : surface.patches) net = transformed(net, map);
  return surface;
}

dmat4 scaled(double factor) { return dmat4(dmat3(factor)); }

Surface box(const dvec3& size) {
  Surface surface;
  surface.closed = true;
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    for (const int side : {0, 1}) {
      TensorNet net(1, 1);
      for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
          dvec4 p(0, 0, 0, 1);
          p[axis] = side;
          p[b] = side == 1 ? i : j;
          p[c] = side == 1 ? j : i;
          net.at(i, j) = p * dvec4(size, 1.0);
        }
      }
      surface.patches.emplace_back(net);
    }
  }
  return surface;
}

double largest_difference(const dmat3& a, const dmat3& b) {
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(a[i][j] - b[i][j]));
  }
  return largest;
}

}  // namespace

TEST_CASE("tilings have the area, volume and inertia of the sphere", "[bezier][mass]") {
  const char* const tilings[] = {
      R"({"type": "sphere_tiling", "topology": "cube"})",
      R"({"type": "sphere_tiling", "topology": "hemispheres"})",
      R"({"type": "sphere_octant"})",
      R"({"type": "sphere_tiling", "topology": "cube_2_4"})",
      R"({"type": "sphere_tiling", "topology": "icosahedron_pairs"})",
      R"({"type": "sphere_tiling", "topology": "octahedron_pairs"})",
      R"({"type": "sphere_tiling", "topology": "tetrahedron_quads"})",
      R"({"type": "sphere_tiling", "topology": "octahedron_quads"})",
      R"({"type": "sphere_tiling", "topology": "icosahedron_quads"})",
      R"({"type": "sphere_tiling", "topology": "rhombicuboctahedron"})",
      R"({"type": "sphere_tiling", "topology": "rhombicuboctahedron", "reading": 42})",
      R"({"type": "sphere_tiling", "topology": "cube", "middle_weight": 5})",
      R"({"type": "sphere_tiling", "topology": "cube", "middle_weight": 0.05})",
  };
  WorstCase worst, bounds;
  for (const char* text : tilings) {
    for (const double radius : {1.0, 1e-4, 1e4}) {
      if (radius != 1.0 && text != tilings[0]) continue;
      const MassProperties mass = mass_properties(moved(build_family(text), scaled(radius)));
      INFO(text);
      REQUIRE(mass.solid);
      const double area = 4 * pi * radius * radius, volume = area * radius / 3;
      const auto add = [&](double error, double bound, double size, const char* what) {
        // The asked-for 1e-12, of the error and of the bound on it.
        worst.add(error / size, 1e-12, [&] { return fmt::format("{} of {}: {}", what, text, error / size); });
        worst.add(bound / size, 1e-12,
                  [&] { return fmt::format("bound, {} of {}: {}", what, text, bound / size); });
        // The bound is true; the net itself is off by an epsilon of the radius, and the expected value
        // rounded.
        bounds.add(error, bound + 4 * epsilon * size,
                   [&] { return fmt::format("{} of {}: {}", what, text, error); });
      };
      add(std::abs(mass.shell.measure - area), mass.shell.measure_error, area, "area");
      add(std::abs(mass.solid->measure - volume), mass.solid->measure_error, volume, "volume");
      add(glm::length(mass.solid->centroid), mass.solid->centroid_error, radius, "centroid");
      const double inertia = 0.4 * volume * radius * radius, shell = 2.0 / 3.0 * area * radius * radius;
      add(largest_difference(mass.solid->inertia, dmat3(inertia)), mass.solid->inertia_error, inertia,
          "inertia");
      add(largest_difference(mass.shell.inertia, dmat3(shell)), mass.shell.inertia_error, shell,
          "shell inertia");
    }
  }
  INFO(worst.text());
  INFO(bounds.text());
  CHECK(worst.failures() == 0);
  CHECK(bounds.failures() == 0);
}

TEST_CASE("caps have the area of caps", "[bezier][mass]") {
  WorstCase worst;
  for (const double z : {-0.9, -0.6, 0.0, 0.6, 12.0 / 13.0}) {
    const MassProperties mass =
        mass_properties(build_family(fmt::format(R"({{"type": "sphere_cap", "z_max": {}}})", z)));
    CHECK(!mass.solid);
    const double area = 2 * pi * (1 + z);
    worst.add(std::abs(mass.shell.measure - area) / area, 1e-12,
              [&] { return fmt::format("area at {}", z); });
    worst.add(mass.shell.measure_error / area, 1e-12, [&] { return fmt::format("bound at {}", z); });
    // Archimedes: the zone's centroid is half way up.
    worst.add(glm::length(mass.shell.centroid - dvec3(0, 0, 0.5 * (z - 1))), 1e-12,
              [&] { return fmt::format("centroid at {}", z); });
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("ellipsoids in closed form and in patches agree", "[bezier][mass]") {
  dmat3 skew(1.0);
  skew[0] = {1.1, 0.3, -0.2};
  skew[1] = {-0.4, 0.6, 0.1};
  skew[2] = {0.2, 0.5, 1.7};
  WorstCase worst;
  for (const dmat3& map :
       {dmat3(2.0), dmat3(1, 0, 0, 0, 2, 0, 0, 0, 0.5), dmat3(1, 0, 0, 0, 1, 0, 0, 0, 0.01), skew}) {
    Surface analytic;
    analytic.ellipsoid = map;
    analytic.closed = true;
    const MassProperties exact = mass_properties(analytic);
    const MassProperties tiled =
        mass_properties(moved(build_family(R"({"type": "sphere_tiling", "topology": "cube"})"), dmat4(map)));
    const double extent = std::max({glm::length(map[0]), glm::length(map[1]), glm::length(map[2])});
    const auto add = [&](double error, double bound, const char* what) {
      worst.add(error, bound + 16 * epsilon * extent,
                [&] { return fmt::format("{}: {} of {}", what, error, bound); });
    };
    add(std::abs(exact.shell.measure - tiled.shell.measure),
        exact.shell.measure_error + tiled.shell.measure_error, "area");
    add(std::abs(exact.solid->measure - tiled.solid->measure),
        exact.solid->measure_error + tiled.solid->measure_error, "volume");
    add(largest_difference(exact.solid->inertia, tiled.solid->inertia),
        exact.solid->inertia_error + tiled.solid->inertia_error, "inertia");
    CHECK(tiled.shell.measure_error < 1e-12 * exact.shell.measure * extent);
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("a box has the volume and inertia of a box", "[bezier][mass]") {
  const dvec3 size(1.0, 2.0, 3.0);
  for (const double far : {0.0, 1e6}) {
    Surface surface = box(size);
    for (Net& net : surface.patches) {
      for (dvec4& p : points_of(net)) p += dvec4(far, 0, 0, 0);
    }
    const MassProperties mass = mass_properties(surface);
    REQUIRE(mass.solid);
    CHECK(std::abs(mass.shell.measure - 22.0) <= mass.shell.measure_error);
    CHECK(std::abs(mass.solid->measure - 6.0) <= mass.solid->measure_error);
    CHECK(mass.solid->measure_error < 1e-12);
    CHECK(glm::length(mass.solid->centroid - 0.5 * size - dvec3(far, 0, 0)) <= mass.solid->centroid_error);
    const dmat3 inertia(0.5 * (4 + 9), 0, 0, 0, 0.5 * (1 + 9), 0, 0, 0, 0.5 * (1 + 4));  // 6 / 12 (b^2 + c^2)
    CHECK(largest_difference(mass.solid->inertia, inertia) <= mass.solid->inertia_error);
    CHECK(mass.solid->inertia_error < 1e-12);
  }
  Surface inside_out = box(size);
  for (Net& net : inside_out.patches) net = reversed(net);
  CHECK(std::abs(mass_properties(inside_out).solid->measure + 6.0) < 1e-12);
  CHECK(mass_properties(inside_out).solid->inertia[0][0] > 6.0);
  Surface without_lid = box(size);
  without_lid.patches.pop_back();
  CHECK(mass_properties(without_lid).leaks);
  CHECK(!mass_properties(without_lid).solid);
}

// The integral of a Bernstein polynomial over its domain is the mean of its coefficients, times the area.
TEST_CASE("cones over polynomial patches have their exact volume", "[bezier][mass]") {
  NetMaker make(71);
  WorstCase worst;
  const auto determinant = [](const auto& x, const auto& y, const auto& z) {
    const auto cross = [](const dvec3& a, const dvec3& b) { return glm::cross(a, b); };
    const auto dot = [](const dvec3& a, const dvec3& b) { return glm::dot(a, b); };
    const auto d = multiply(x, multiply(y, z, cross), dot);
    double sum = 0.0;
    for (const double c : d.coefficients) sum += c;
    return sum / static_cast<double>(d.coefficients.size());
  };
  const auto add = [&](const Net& net, double exact) {
    // Whatever is asked: polynomials are integrated exactly.
    const PatchIntegrals integrals = integrate_patch(net, dvec3(0.0), {1.0, 1.0, 8});
    const double error = std::abs(static_cast<double>(integrals.cone.total) - exact);
    // Coordinates below 1, derivatives below 2 * 5: products below 100, some tens of roundings.
    worst.add(error, integrals.cone_error[0] + 2e-14, [&] { return fmt::format("{}", error); });
    CHECK(integrals.cone_error[0] < 1e-13);
  };
  for (int k = 0; k < 20; ++k) {
    const int m = 1 + k % 5, n = 1 + k / 3 % 4;
    TensorPolynomial<dvec3> x(m, n), u(m - 1, n), v(m, n - 1);
    TensorNet net(m, n);
    for (std::size_t c = 0; c < net.points.size(); ++c) {
      net.points[c] = make.point(1.0, 1.0);
      x.coefficients[c] = dvec3(net.points[c]);
    }
    tensor_derivative_u(x.coefficients.data(), m, n, u.coefficients.data());
    tensor_derivative_v(x.coefficients.data(), m, n, v.coefficients.data());
    add(net, determinant(x, u, v) / 3.0);
    TrianglePolynomial<dvec3> t(n), a(n - 1), b(n - 1);
    TriangleNet triangle(n);
    for (std::size_t c = 0; c < triangle.points.size(); ++c) {
      triangle.points[c] = make.point(1.0, 1.0);
      t.coefficients[c] = dvec3(triangle.points[c]);
    }
    for (int i = 0, at = 0; i < n; ++i) {
      for (int j = 0; j < n - i; ++j, ++at) {
        a.coefficients[static_cast<std::size_t>(at)] = static_cast<double>(n) * (t.at(i + 1, j) - t.at(i, j));
        b.coefficients[static_cast<std::size_t>(at)] = static_cast<double>(n) * (t.at(i, j + 1) - t.at(i, j));
      }
    }
    add(triangle, determinant(t, a, b) / 6.0);
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("rational patches agree with another quadrature, and bounds hold when little is asked",
          "[bezier][mass]") {
  NetMaker make(72);
  WorstCase worst, loose;
  using Gauss = boost::math::quadrature::gauss<double, 30>;
  long improved = 0;
  for (int k = 0; k < 8; ++k) {
    const int m = 1 + k % 4, n = 1 + k / 2 % 3;
    TensorNet net(m, n);
    for (int i = 0; i <= m; ++i) {
      for (int j = 0; j <= n; ++j) {
        const double w = (k % 3 == 0 ? -1.0 : 1.0) * make.uniform(0.6, 1.6);
        net.at(i, j) = {w * i / m, w * j / n, w * make.uniform(0.5, 0.9), w};
      }
    }
    const auto area = [&](double u, double v) {
      const SurfaceJet s = surface_jet(net, u, v);
      return glm::length(glm::cross(s.du, s.dv));
    };
    const auto cone = [&](double u, double v) {
      const SurfaceJet s = surface_jet(net, u, v);
      return glm::dot(s.point, glm::cross(s.du, s.dv)) * s.point.x / 4.0;
    };
    const auto integral = [&](auto f) {
      double sum = 0.0;
      for (int a = 0; a < 4; ++a) {
        for (int b = 0; b < 4; ++b) {
          sum += Gauss::integrate(
              [&](double u) {
                return Gauss::integrate([&](double v) { return f(u, v); }, b / 4.0, (b + 1) / 4.0);
              },
              a / 4.0, (a + 1) / 4.0);
        }
      }
      return sum;
    };
    const PatchIntegrals fine = integrate_patch(net, dvec3(0.0), {1e-14, 1.0, 4000});
    const auto add = [&](double error, double bound, const char* what) {
      // The other quadrature is good to about 1e-13: integrands near 1 with some tens of epsilon each.
      worst.add(error, bound + 1e-13, [&] { return fmt::format("{} of net {}: {}", what, k, error); });
    };
    add(std::abs(static_cast<double>(fine.area.total) - integral(area)), fine.area_error[0], "area");
    add(std::abs(static_cast<double>(fine.cone.first.x) - integral(cone)), fine.cone_error[1],
        "first moment");
    CHECK(fine.area_error[0] < 1e-13);
    for (const double goal : {1e-2, 1e-5, 1e-8}) {
      const PatchIntegrals coarse = integrate_patch(net, dvec3(0.0), {goal, 1.0, 4000});
      CHECK(coarse.area_error[0] < 2 * goal);
      if (coarse.cells < fine.cells) ++improved;
      const auto check = [&](long double a, long double b, double bound, const char* what) {
        const double error = static_cast<double>(std::abs(a - b));
        loose.add(error, bound + fine.area_error[2] + fine.cone_error[2],
                  [&] { return fmt::format("{} of net {} at {}: {} of {}", what, k, goal, error, bound); });
      };
      check(coarse.area.total, fine.area.total, coarse.area_error[0], "area");
      check(coarse.cone.total, fine.cone.total, coarse.cone_error[0], "cone");
      check(coarse.area.second[1], fine.area.second[1], coarse.area_error[2], "second moment");
      check(coarse.cone.first.y, fine.cone.first.y, coarse.cone_error[1], "first moment");
    }
  }
  INFO(worst.text());
  INFO(loose.text());
  CHECK(worst.failures() == 0);
  CHECK(loose.failures() == 0);
  CHECK(improved > 12);
}

TEST_CASE("patches that reach infinity have no known area, and say so soon", "[bezier][mass]") {
  NetMaker make(73);
  Surface surface;
  TensorNet net = make.tensor(2, 2);
  net.at(1, 1).w = -6.0;
  surface.patches.emplace_back(net);
  const auto start = std::chrono::steady_clock::now();
  const MassProperties mass = mass_properties(surface);
  CHECK(!std::isfinite(mass.shell.measure_error));
  CHECK(!std::isfinite(mass.shell.inertia_error));
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(60));
  // Negative weights alone do no harm.
  Surface stereographic;
  TensorNet square(2, 2);
  // [-2, 2]^2: w_11 = 4 - 2 * 4 (Cobb 1988, Figure 2).
  const double c[3] = {-2, 0, 2}, s[3] = {4, -4, 4};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      square.at(i, j) = {4 * c[i], 4 * c[j], s[i] + s[j] - 4, s[i] + s[j] + 4};
    }
  }
  stereographic.patches.emplace_back(square);
  const MassProperties known = mass_properties(stereographic);
  // Twice the integral of 16 / (x^2 + y^2 + 4)^2 over the square, in closed form: 8 r arctan(r), r =
  // 1/sqrt 2.
  const double r = 1 / std::sqrt(2.0);
  CHECK(std::abs(known.shell.measure - 16 * r * std::atan(r)) <= known.shell.measure_error + 1e-14);
  CHECK(known.shell.measure_error < 1e-12);
}

}  // namespace rondure
