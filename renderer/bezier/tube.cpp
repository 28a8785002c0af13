#include "renderer/bezier/tube.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace rondure {
namespace {

// A third of the unit circle: control points (x, y) of weights 1, 1/2, 1. The middle one lies at distance 2.
struct Third {
  dvec2 point[3];
  double weight[3] = {1.0, 0.5, 1.0};
};

std::array<Third, 3> unit_circle() {
  constexpr double h = 0.86602540378443864676;
  const dvec2 corner[3] = {{1.0, 0.0}, {-0.5, h}, {-0.5, -h}};
  std::array<Third, 3> thirds;
  for (std::size_t k = 0; k < 3; ++k) {
    const dvec2 from = corner[k], to = corner[(k + 1) % 3];
    thirds[k].point[0] = from;
    thirds[k].point[1] = 2.0 * (from + to);  // the corners' sum has length 1
    thirds[k].point[2] = to;
  }
  return thirds;
}

// Any direction at right angles to a unit vector.
dvec3 across(const dvec3& axis) {
  const dvec3 other = std::abs(axis.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  return glm::normalize(glm::cross(axis, other));
}

}  // namespace

std::vector<TensorNet> straight_tube(const dvec3& from, const dvec3& to, double radius) {
  std::vector<TensorNet> nets;
  if (!(glm::distance(from, to) > 0.0)) return nets;
  const dvec3 axis = glm::normalize(to - from), a = radius * across(axis), b = glm::cross(axis, a);
  for (const Third& arc : unit_circle()) {
    TensorNet net(2, 1);
    for (int i = 0; i < 3; ++i) {
      const dvec3 off = arc.point[i].x * a + arc.point[i].y * b;
      net.at(i, 0) = arc.weight[i] * dvec4(from + off, 1.0);
      net.at(i, 1) = arc.weight[i] * dvec4(to + off, 1.0);
    }
    nets.push_back(net);
  }
  return nets;
}

std::vector<TensorNet> arc_tube(const dvec3& from, const dvec3& to, double radius) {
  std::vector<TensorNet> nets;
  const dvec3 a = glm::normalize(from), b = glm::normalize(to);
  const dvec3 normal = glm::cross(a, b);
  if (!(glm::length(normal) > 0.0)) return nets;
  if (glm::dot(a, b) < 0.0) {  // longer than a quarter: in halves, whose middle weights are large enough
    for (const dvec3& start : {a, a + b}) {
      for (TensorNet& net : arc_tube(start, start == a ? a + b : b, radius)) nets.push_back(std::move(net));
    }
    return nets;
  }
  const dvec3 axis = glm::normalize(normal), middle = glm::normalize(a + b);
  const double half_cosine = glm::dot(a, middle);
  for (const Third& arc : unit_circle()) {
    TensorNet net(2, 2);
    for (int j = 0; j < 3; ++j) {
      const double out = 1.0 + radius * arc.point[j].x, up = radius * arc.point[j].y, w = arc.weight[j];
      net.at(0, j) = w * dvec4(out * a + up * axis, 1.0);
      net.at(1, j) = w * half_cosine * dvec4(out / half_cosine * middle + up * axis, 1.0);
      net.at(2, j) = w * dvec4(out * b + up * axis, 1.0);
    }
    nets.push_back(net);
  }
  return nets;
}

}  // namespace rondure
