#include "renderer/bezier/tube.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/tube_section.h"

namespace rondure {

using detail::Third, detail::across, detail::unit_circle;

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

std::vector<TensorNet> circle_tube(const CircleArc& arc, double radius) {
  constexpr double quarter = 1.57079632679489661923, rounding = 1e-9;
  const int parts = std::max(1, static_cast<int>(std::ceil(arc.angle / quarter - rounding)));
  const double size = glm::length(arc.a), half_cosine = std::cos(0.5 * arc.angle / parts);
  const dvec3 axis = glm::normalize(glm::cross(arc.a, arc.b));
  // Of length 1, at so many halves of a part; the end of a whole circle is its start.
  const auto direction = [&](int halves) {
    const bool around = halves == 2 * parts && arc.angle > 4.0 * quarter - rounding;
    const double s = around ? 0.0 : 0.5 * halves * arc.angle / parts;
    return (std::cos(s) * arc.a + std::sin(s) * arc.b) / size;
  };
  std::vector<TensorNet> nets;
  for (int part = 0; part < parts; ++part) {
    const dvec3 ends[3] = {direction(2 * part), direction(2 * part + 1) / half_cosine,
                           direction(2 * part + 2)};
    for (const Third& third : unit_circle()) {
      TensorNet net(2, 2);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          const double out = size + radius * third.point[j].x, up = radius * third.point[j].y;
          const double weight = third.weight[j] * (i == 1 ? half_cosine : 1.0);
          net.at(i, j) = weight * dvec4(arc.centre + out * ends[i] + up * axis, 1.0);
        }
      }
      nets.push_back(net);
    }
  }
  return nets;
}

}  // namespace rondure
