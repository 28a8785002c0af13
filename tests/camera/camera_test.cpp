#include "renderer/camera/camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

Camera skew(Projection projection) {
  Camera camera = look_at(projection, {1, -4, 2}, {0.3, 0.2, -0.1}, {0.1, 0, 1});
  camera.extent = 0.8;
  return camera;
}

TEST_CASE("the picture's centre, edges and directions are where they should be", "[camera]") {
  const Camera camera = look_at(Projection::perspective, {0, -4, 0}, {0, 0, 0}, {0, 0, 1});
  const Ray centre = camera_ray(camera, 1.5, {0.5, 0.5}, {0.1, 0.9});
  CHECK(glm::length(centre.direction - dvec3(0, 1, 0)) < 1e-15);
  CHECK(centre.origin == dvec3(0, -4, 0));  // no aperture: the lens number is of no effect
  // 35 degrees between top and bottom; left is -x, up is z.
  const Ray top = camera_ray(camera, 1.5, {0.5, 0.0}, {0.5, 0.5});
  CHECK(std::atan2(top.direction.z, top.direction.y) * 180.0 / std::numbers::pi ==
        Approx(17.5).epsilon(1e-14));
  const Ray left = camera_ray(camera, 1.5, {0.0, 0.5}, {0.5, 0.5});
  CHECK(left.direction.x / left.direction.y ==
        Approx(-1.5 * std::tan(17.5 * std::numbers::pi / 180)).epsilon(1e-14));
  CHECK(std::abs(glm::length(top.direction) - 1.0) < 1e-15);
}

TEST_CASE("orthographic rays are parallel and span the window", "[camera]") {
  Camera camera = look_at(Projection::orthographic, {0, -4, 0}, {0, 0, 0}, {0, 0, 1});
  camera.extent = 2.0;
  const Ray corner = camera_ray(camera, 2.0, {1.0, 0.0}, {0.5, 0.5});
  CHECK(glm::length(corner.origin - dvec3(2, -4, 1)) < 1e-15);
  CHECK(corner.direction == dvec3(0, 1, 0));
}

TEST_CASE("rays through one film point meet in the plane of focus, and start on the lens", "[camera]") {
  Camera camera = skew(Projection::perspective);
  camera.aperture = 0.3;
  camera.focus_distance = 2.7;
  Camera pinhole = camera;
  pinhole.aperture = 0.0;
  const dvec2 film(0.2, 0.7);
  const Ray chief = camera_ray(pinhole, 1.3, film, {0.5, 0.5});
  const dvec3 focus = chief.origin + chief.direction * (2.7 / glm::dot(chief.direction, camera.forward));
  WorstCase worst;
  double widest = 0.0;
  for (int i = 0; i < 64; ++i) {
    const dvec2 lens((i % 8 + 0.5) / 8, (i / 8 + 0.5) / 8);
    const Ray ray = camera_ray(camera, 1.3, film, lens);
    const auto describe = [&] { return std::to_string(i); };
    // Coordinates of a few units: some ten roundings of 4 eps.
    worst.add(glm::length(glm::cross(focus - ray.origin, ray.direction)), 1e-14, describe);
    worst.add(std::abs(glm::dot(ray.origin - camera.origin, camera.forward)), 1e-14, describe);
    widest = std::max(widest, glm::length(ray.origin - camera.origin));
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK((widest > 0.25 && widest <= 0.3));
}

TEST_CASE("camera matrices take points on a ray back to its film point", "[camera]") {
  WorstCase worst;
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    const Camera camera = skew(projection);
    const dvec2 film(0.15, 0.6);
    const Ray ray = camera_ray(camera, 1.7, film, {0.5, 0.5});
    for (const double t : {0.5, 3.0, 40.0}) {
      const dvec3 p = ray.origin + t * ray.direction;
      const dvec4 ndc = world_to_ndc(camera, 1.7) * dvec4(p, 1.0);
      const auto describe = [&] { return std::to_string(t); };
      // Points within 50 units: absolute errors of some 50 eps, divided by a depth of at least 0.5.
      worst.add(std::abs(ndc.x / ndc.w - (2 * film.x - 1)), 1e-12, describe);
      worst.add(std::abs(ndc.y / ndc.w - (1 - 2 * film.y)), 1e-12, describe);
      const double depth = glm::dot(p - camera.origin, camera.forward);
      worst.add(std::abs(ndc.z / ndc.w - (projection == Projection::perspective ? 1 - 1 / depth : depth)),
                1e-12, describe);
      const dvec4 in_camera = world_to_camera(camera) * dvec4(p, 1.0);
      worst.add(std::abs(in_camera.z + depth), 1e-12, describe);
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("camera matrices are finite however narrow the view", "[camera]") {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Camera camera = look_at(projection, {0, -4, 1}, {0, 0, 0}, {0, 0, 1});
    for (const double extent : {0.0, 5e-324, 1e-310, 1e-60, 1e300}) {
      camera.extent = extent;
      const dmat4 matrix = world_to_ndc(camera, 1.0 / 3.0);
      long infinite = 0;
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) infinite += !std::isfinite(matrix[i][j]);
      CHECK(infinite == 0);
    }
  }
}

TEST_CASE("vectors of any length give the same camera", "[camera]") {
  const Camera plain = look_at(Projection::perspective, {0, -4, 1}, {0, 0, 0}, {0, 0, 1});
  for (const double length : {1e-300, 1e-160, 1e160, 1e300}) {
    const Camera scaled = look_at(Projection::perspective, {0, -4, 1}, {0, 0, 0}, {0, 0, length});
    CHECK(glm::distance(scaled.right, plain.right) < 1e-15);
  }
  const Camera close = look_at(Projection::perspective, {0, -4e-200, 1e-200}, {0, 0, 0}, {0, 0, 1});
  CHECK(glm::distance(close.forward, plain.forward) < 1e-15);
}

TEST_CASE("a camera that looks nowhere is refused", "[camera]") {
  CHECK_THROWS_WITH(look_at(Projection::perspective, {1, 2, 3}, {1, 2, 3}, {0, 0, 1}),
                    "the camera's origin and target coincide");
  CHECK_THROWS_WITH(look_at(Projection::perspective, {1, 2, 3}, {1, 2, 5}, {0, 0, 1}),
                    "the camera's up is zero or parallel to its view");
}

}  // namespace
}  // namespace rondure
