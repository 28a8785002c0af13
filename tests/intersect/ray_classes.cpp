#include "tests/intersect/ray_classes.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/local_ray.h"
#include "tests/intersect/random_direction.h"

namespace rondure {
namespace {

struct SurfacePoint {
  dvec3 point, normal;
  int patch = 0;
};

class Aim {
 public:
  Aim(const ClosedModel& model, std::mt19937_64& random) : model_(model), random_(random) {}

  double draw() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  dvec3 direction() { return random_direction(random_); }
  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }
  // 10^low to 10^high
  double decade(double low, double high) { return std::pow(10.0, low + (high - low) * draw()); }
  // One of three parameters.
  double special() { return 0.5 * static_cast<double>(below(3)); }

  SurfacePoint at(std::size_t patch, double u, double v) {
    const Net& net = model_.surface.patches[patch];
    if (std::holds_alternative<TriangleNet>(net) && u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    return {model_.surface.origin + net_point(net, u, v), unit_normal(net, u, v), static_cast<int>(patch)};
  }
  SurfacePoint anywhere() {
    const std::size_t patch = below(model_.surface.patches.size());
    const double u = draw(), v = draw();
    return at(patch, u, v);
  }
  // A side of a patch, by where along it.
  struct Side {
    std::size_t patch;
    double across, turn;
  };
  Side any_side() {
    const std::size_t patch = below(model_.surface.patches.size());
    const double across = draw() < 0.5 ? 0.0 : 1.0;
    return {patch, across, draw()};
  }
  SurfacePoint on_side(const Side& side, double along) {
    const auto [patch, across, turn] = side;
    const bool triangle = std::holds_alternative<TriangleNet>(model_.surface.patches[patch]);
    if (triangle && turn < 0.34) return at(patch, along, 1.0 - along);
    if (triangle) return turn < 0.67 ? at(patch, along, 0.0) : at(patch, 0.0, along);
    return turn < 0.5 ? at(patch, across, along) : at(patch, along, across);
  }
  // On the boundary, or at a corner.
  SurfacePoint on_boundary(bool corner) {
    const double along = draw();
    return on_side(any_side(), corner ? std::floor(2.0 * along) : along);
  }

  dvec3 center() const { return model_.surface.origin; }
  dvec3 outside(double low, double high) {
    const dvec3 way = direction();
    return center() + model_.radius * (low + (high - low) * draw()) * way;
  }
  dvec3 inside() { return model_.inside[below(model_.inside.size())]; }

  // From inside or outside, at a place, with a direction of some length.
  AimedRay towards(const dvec3& target) {
    AimedRay out;
    const bool within = draw() < 0.5;
    out.ray.origin = within ? inside() : outside(1.1, 4.0);
    out.ray.direction = (target - out.ray.origin) * (0.5 + draw());
    out.parity = within;
    return out;
  }

  AimedRay simple(RayClass c) {
    AimedRay out;
    switch (c) {
      case RayClass::random_inside:
        out.ray = {inside(), direction() * std::exp2(std::floor(20.0 * draw()) - 10.0)};
        out.parity = 1;
        return out;
      case RayClass::shared_edge:
        return towards(on_boundary(false).point);
      case RayClass::corner: {
        const dvec3 corner = on_boundary(true).point;
        const dvec3 past = draw() < 0.3 ? dvec3(0.0) : direction() * model_.radius * decade(-17.0, -1.0);
        return towards(corner + past);
      }
      case RayClass::parameter_line: {
        const std::size_t patch = below(model_.surface.patches.size());
        const double a = special(), b = draw();
        const bool swap = draw() < 0.5;
        return towards(at(patch, swap ? b : a, swap ? a : b).point);
      }
      case RayClass::tangential: {
        const SurfacePoint p = draw() < 0.3 ? on_boundary(draw() < 0.3) : anywhere();
        const dvec3 along = glm::normalize(glm::cross(p.normal, direction()));
        // Few of them within rounding of touching: those want the oracle.
        const double off = decade(below(deep_) == 0 ? -16.0 : -14.0, -1.0) * (draw() < 0.5 ? -1.0 : 1.0);
        const double size = std::fabs(glm::dot(p.point - center(), p.normal));
        const double away = model_.radius * (1.5 + 3.0 * draw());
        out.ray = {p.point + off * size * p.normal - away * along, along};
        const double far = glm::distance(out.ray.origin, center());
        out.parity = far > 1.01 * model_.radius ? 0 : -1;
        return out;
      }
      default: {
        // Through a disk about the middle, of 1.2 radii.
        const dvec3 d = direction(), side = glm::normalize(glm::cross(d, direction()));
        const double off = 1.2 * std::sqrt(draw()), back = 1.5 + 9.0 * draw();
        out.ray = {center() + model_.radius * (off * side - back * d), d};
        out.parity = 0;
        return out;
      }
    }
  }

  AimedRay from_surface() {
    const SurfacePoint p = draw() < 0.3 ? on_boundary(draw() < 0.3) : anywhere();
    AimedRay out;
    out.ray = {p.point, direction()};
    out.ray.start = {0, p.normal};
    const double leaving = glm::dot(out.ray.direction, p.normal);
    // The start is an ulp of its coordinates off, which is that over the cosine along the ray; where the ray
    // grazes, or the normal is a singular corner's, whether it starts inside is not told by the normal.
    const double ulps = 0x1p-50 * (largest(p.point) + largest(center()) + model_.radius);
    out.doubt = std::fmin(ulps / std::fabs(leaving), std::sqrt(4.0 * ulps * model_.radius));
    out.parity = std::fabs(leaving) > 1e-3 && p.normal != dvec3(0.0) ? leaving < 0.0 : -1;
    return out;
  }

  AimedRay very_near() {
    AimedRay out;
    const SurfacePoint p = anywhere();
    const bool above = draw() < 0.5;
    out.ray = {p.point + (above ? 1e-8 : -1e-8) * model_.radius * p.normal, direction()};
    // That much above a patch of modest curvature is outside, unless rounding of a far centre hides it.
    const bool sure = 1e-8 * model_.radius > 0x1p-48 * (largest(center()) + model_.radius);
    out.parity = sure && model_.sphere ? !above : -1;
    return out;
  }

  AimedRay edge_plane() {
    const Side side = any_side();
    const SurfacePoint p = on_side(side, draw());
    dvec3 across = glm::cross(on_side(side, 0.5).point - on_side(side, 0.0).point,
                              on_side(side, 1.0).point - on_side(side, 0.0).point);
    // A side that is collapsed, or straight, is in many planes.
    if (!(glm::length(across) > 1e-6 * model_.radius * model_.radius))
      across = glm::cross(p.normal, direction());
    const dvec3 along = glm::normalize(glm::cross(across, p.normal)),
                inward = glm::normalize(glm::cross(across, along)) * (draw() < 0.5 ? -1.0 : 1.0);
    const double size = std::fabs(glm::dot(p.point - center(), p.normal)), off = decade(-14.0, -0.3),
                 steep = draw() < 0.3 ? 4.0 * draw() : 0.0;
    const dvec3 d = glm::normalize(along + steep * inward);
    AimedRay out;
    out.ray = {p.point + off * size * inward - model_.radius * (1.5 + 3.0 * draw()) * d, d};
    out.parity = glm::distance(out.ray.origin, center()) > 1.01 * model_.radius ? 0 : -1;
    return out;
  }

  AimedRay axis_aligned() {
    AimedRay out;
    const int axis = static_cast<int>(below(3));
    dvec3 d(0.0);
    d[axis] = draw() < 0.5 ? -1.0 : 1.0;
    dvec3 through = model_.radius * (2.0 * dvec3(draw(), 0.0, 0.0) - dvec3(1.0, 0.0, 0.0));
    through.y = model_.radius * (2.0 * draw() - 1.0), through.z = model_.radius * (2.0 * draw() - 1.0);
    for (int k = 0; k < 3; ++k)
      if (draw() < 0.3) through[k] = 0.0;
    if (draw() < 0.2) through = on_boundary(draw() < 0.5).point - center();
    out.ray = {center() + through, d};
    out.ray.origin[axis] -= 4.0 * model_.radius * d[axis];
    out.parity = 0;
    return out;
  }

 private:
  const ClosedModel& model_;
  std::mt19937_64& random_;
  const std::size_t deep_ = model_.sphere ? 1 : 128;
};

}  // namespace

const char* name_of(RayClass c) {
  static constexpr const char* names[] = {"random, outside",  "random, inside",  "shared edges",
                                          "corners",          "parameter lines", "tangential",
                                          "from the surface", "10^8 radii",      "10^-8 radii",
                                          "axis-aligned",     "planes of edges", "extreme lengths"};
  return names[static_cast<std::size_t>(c)];
}

AimedRay aim(const ClosedModel& model, RayClass c, std::mt19937_64& random) {
  Aim a(model, random);
  switch (c) {
    case RayClass::from_surface:
      return a.from_surface();
    case RayClass::very_near:
      return a.very_near();
    case RayClass::axis_aligned:
      return a.axis_aligned();
    case RayClass::edge_plane:
      return a.edge_plane();
    case RayClass::far_away: {
      AimedRay out;
      const dvec3 target = a.draw() < 0.5 ? a.outside(0.0, 1.1) : a.on_boundary(a.draw() < 0.5).point;
      const dvec3 way = a.direction();
      out.ray = {target - 1e8 * model.radius * way, way};
      out.parity = 0;
      return out;
    }
    case RayClass::extreme_length: {
      AimedRay out = a.simple(static_cast<RayClass>(a.below(6)));
      // From as small as leaves t a number, denormal, of few bits, where the model is small, to as large as
      // leaves t its 53 bits.
      const int size = std::ilogb(model.radius);
      const int least = std::max(-1060, size + 5 - 1020), most = std::min(1000, size + 960);
      const int exponent = least + static_cast<int>(a.below(static_cast<std::size_t>(most - least)));
      const dvec3 d = out.ray.direction / largest(out.ray.direction);
      for (int k = 0; k < 3; ++k) out.ray.direction[k] = std::ldexp(d[k], exponent);
      return out;
    }
    default:
      return a.simple(c);
  }
}

}  // namespace rondure
