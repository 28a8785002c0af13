#include "renderer/shading/surface_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "renderer/bezier/rational.h"
#include "renderer/sampling/warps.h"
#include "renderer/shading/sphere_cone.h"

namespace rondure {
namespace {

using std::numbers::pi;

constexpr int side = 16;                  // cells along each parameter
constexpr int patch_cells = side * side;  // in a square, and also in a triangle: side^2 small triangles

bool is_triangle(const Net& net) { return std::holds_alternative<TriangleNet>(net); }

// A triangle's cells: the grid's square (i, j) holds an upright small triangle and, off the long edge, an
// inverted one. Column i has 2 (side - i) - 1 of them, numbered in turn.
struct TriangleCell {
  int i, j;
  bool inverted;
};

TriangleCell triangle_cell(int number) {
  int i = 0;
  for (int row = 2 * side - 1; number >= row; row -= 2) {
    number -= row;
    ++i;
  }
  return {i, number / 2, number % 2 == 1};
}

int triangle_cell_number(const TriangleCell& cell) {
  return cell.i * (2 * side - cell.i) + 2 * cell.j + (cell.inverted ? 1 : 0);
}

// The parameter at `uv` of the unit square in a cell, the map's Jacobian constant.
dvec2 place(bool triangle, int cell, dvec2 uv) {
  if (!triangle) return (dvec2(cell / side, cell % side) + uv) / double(side);
  if (uv.x + uv.y > 1.0) uv = dvec2(1.0) - uv;
  const TriangleCell c = triangle_cell(cell);
  const dvec2 local = c.inverted ? dvec2(1.0) - uv : uv;
  return (dvec2(c.i, c.j) + local) / double(side);
}

int cell_at(bool triangle, dvec2 parameter) {
  const dvec2 p = parameter * double(side);
  int i = std::clamp(static_cast<int>(p.x), 0, side - 1);
  if (!triangle) return i * side + std::clamp(static_cast<int>(p.y), 0, side - 1);
  const int j = std::clamp(static_cast<int>(p.y), 0, side - 1 - i);
  const bool inverted = i + j < side - 1 && (p.x - i) + (p.y - j) > 1.0;
  return triangle_cell_number({i, j, inverted});
}

double cell_domain(bool triangle) { return (triangle ? 0.5 : 1.0) / patch_cells; }

struct Element {
  dvec3 point;
  dvec3 area_vector;  // du x dv
};

Element element(const Net& net, dvec2 uv) {
  const FirstOrder<dvec4> h = net_first(net, uv.x, uv.y);
  const dvec3 p = dvec3(h.value) / h.value.w;
  const dvec3 du = (dvec3(h.du) - p * h.du.w) / h.value.w;
  const dvec3 dv = (dvec3(h.dv) - p * h.dv.w) / h.value.w;
  return {p, glm::cross(du, dv)};
}

dmat3 cofactor_matrix(const dmat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

// The radius of the sphere that the matrix makes of the unit sphere; 0 when that is none. What it may differ
// by is far below what a float of the picture could show.
double sphere_radius(const dmat3& m) {
  const double radius = glm::length(m[0]);
  if (!(radius > 0.0)) return 0.0;
  const dmat3 turn = m / radius, product = glm::transpose(turn) * turn;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!(std::abs(product[i][j] - (i == j ? 1.0 : 0.0)) <= 1e-12)) return 0.0;
    }
  }
  return radius;
}

// What a density per area is per solid angle: 0 for a surface that faces away.
double per_solid_angle(double density, const dvec3& way, const dvec3& normal) {
  const double distance2 = glm::dot(way, way);
  const double cosine = -glm::dot(way, normal) / std::sqrt(distance2);
  return cosine > 0.0 ? density * distance2 / cosine : 0.0;
}

}  // namespace

SurfaceLight::SurfaceLight(const Surface& surface) : surface_(&surface) {
  if (surface.ellipsoid) {
    radius_ = sphere_radius(*surface.ellipsoid);
    inverse_ = glm::inverse(*surface.ellipsoid);
    // A matrix that mirrors would turn the area vectors inward.
    cofactor_ =
        cofactor_matrix(*surface.ellipsoid) * (glm::determinant(*surface.ellipsoid) < 0.0 ? -1.0 : 1.0);
    constexpr int n = 64;
    for (int i = 0; i < n * n; ++i) {
      const dvec2 uv((i / n + 0.5) / n, (i % n + 0.5) / n);
      area_ += 4.0 * pi * glm::length(cofactor_ * sample_sphere(uv)) / (n * n);
    }
    return;
  }
  // Two-point Gauss abscissae a side: inside the cell, away from singular edges.
  constexpr double gauss[2] = {0.21132486540518713, 0.78867513459481287};
  cumulative_.assign(1, 0.0);
  for (const Net& net : surface.patches) {
    const bool triangle = is_triangle(net);
    for (int cell = 0; cell < patch_cells; ++cell) {
      double sum = 0.0;
      for (const double x : gauss) {
        for (const double y : gauss)
          sum += glm::length(element(net, place(triangle, cell, {x, y})).area_vector);
      }
      area_ += 0.25 * sum * cell_domain(triangle);
      cumulative_.push_back(area_);
    }
  }
  for (double& c : cumulative_) c /= area_;
}

double SurfaceLight::cell_density(std::size_t cell, const dvec3& area_vector) const {
  const double stretch = glm::length(area_vector);
  if (!(stretch > 0.0)) return 0.0;
  const bool triangle = is_triangle(surface_->patches[cell / patch_cells]);
  return (cumulative_[cell + 1] - cumulative_[cell]) / (cell_domain(triangle) * stretch);
}

SurfaceLight::Sample SurfaceLight::sample(dvec2 uv) const {
  if (surface_->ellipsoid) {
    const dvec3 s = sample_sphere(uv);
    const dvec3 area_vector = cofactor_ * s;
    const double stretch = glm::length(area_vector);
    return {surface_->origin + *surface_->ellipsoid * s, area_vector / stretch, 1.0 / (4.0 * pi * stretch)};
  }
  const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, uv.x);
  const auto cell = static_cast<std::size_t>(above - cumulative_.begin()) - 1;
  const double width = cumulative_[cell + 1] - cumulative_[cell];
  if (!(width > 0.0)) return {};
  const dvec2 inside(std::clamp((uv.x - cumulative_[cell]) / width, 0.0, 1.0), uv.y);
  const Net& net = surface_->patches[cell / patch_cells];
  const dvec2 parameter = place(is_triangle(net), static_cast<int>(cell % patch_cells), inside);
  const Element e = element(net, parameter);
  const double density = cell_density(cell, e.area_vector);
  if (density == 0.0) return {};
  return {surface_->origin + e.point, glm::normalize(e.area_vector), density};
}

double SurfaceLight::density(const Hit& hit) const {
  if (surface_->ellipsoid) {
    const dvec3 s = glm::normalize(inverse_ * (hit.point - surface_->origin));
    return 1.0 / (4.0 * pi * glm::length(cofactor_ * s));
  }
  const auto patch = static_cast<std::size_t>(hit.patch);
  const Net& net = surface_->patches[patch];
  const dvec2 uv(hit.u, hit.v);
  const auto cell = patch * patch_cells + static_cast<std::size_t>(cell_at(is_triangle(net), uv));
  return cell_density(cell, element(net, uv).area_vector);
}

SurfaceLight::Direction SurfaceLight::sample_toward(const dvec3& from, dvec2 uv) const {
  if (const auto cone = sphere_cone(from, surface_->origin, radius_)) {
    const SphereCone::Sample s = cone->sample(uv);
    return {s.direction, s.distance, cone->pdf()};
  }
  const Sample target = sample(uv);
  const dvec3 way = target.point - from;
  const double distance = glm::length(way);
  if (!(distance > 0.0)) return {};
  return {way / distance, distance, per_solid_angle(target.density, way, target.normal)};
}

double SurfaceLight::pdf_toward(const dvec3& from, const Hit& hit) const {
  const dvec3 way = hit.point - from;
  if (const auto cone = sphere_cone(from, surface_->origin, radius_)) {
    return glm::dot(way, hit.normal) < 0.0 ? cone->pdf() : 0.0;
  }
  return per_solid_angle(density(hit), way, hit.normal);
}

}  // namespace rondure
