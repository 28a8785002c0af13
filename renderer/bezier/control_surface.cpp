#include "renderer/bezier/control_surface.h"

#include <glm/geometric.hpp>
#include <initializer_list>

namespace rondure {
namespace {

// Whether all points are finite and they span an area, but for rounding.
bool has_area(std::initializer_list<dvec4> points) {
  dvec3 first(0.0);
  double extent = 0.0, area = 0.0;
  for (const dvec4& p : points) {
    if (p.w == 0.0) return false;
    if (&p == points.begin()) first = dvec3(p) / p.w;
  }
  for (const dvec4& p : points) {
    const dvec3 a = dvec3(p) / p.w - first;
    extent = std::max(extent, glm::dot(a, a));
    for (const dvec4& q : points) area = std::max(area, glm::length(glm::cross(a, dvec3(q) / q.w - first)));
  }
  return area > 1e-9 * extent;
}

dvec4 point(const dvec4& p) { return dvec4(dvec3(p) / p.w, 1.0); }

void add(const dvec4& u, const dvec4& v, const dvec4& w, std::vector<Net>& out) {
  if (!has_area({u, v, w})) return;
  TriangleNet flat(1);
  flat.at(1, 0) = point(u), flat.at(0, 1) = point(v), flat.at(0, 0) = point(w);
  out.emplace_back(std::move(flat));
}

void add_pieces(const TriangleNet& net, std::vector<Net>& out) {
  for (int i = 0; i < net.n; ++i) {
    for (int j = 0; j < net.n - i; ++j) {
      add(net.at(i + 1, j), net.at(i, j + 1), net.at(i, j), out);
      if (i + j > net.n - 2) continue;
      add(net.at(i + 1, j + 1), net.at(i, j + 1), net.at(i + 1, j), out);
    }
  }
}

void add_pieces(const TensorNet& net, std::vector<Net>& out) {
  for (int i = 0; i < net.m; ++i) {
    for (int j = 0; j < net.n; ++j) {
      if (!has_area({net.at(i, j), net.at(i, j + 1), net.at(i + 1, j), net.at(i + 1, j + 1)})) continue;
      TensorNet flat(1, 1);
      for (int k = 0; k < 2; ++k) {
        for (int l = 0; l < 2; ++l) flat.at(k, l) = point(net.at(i + k, j + l));
      }
      out.emplace_back(std::move(flat));
    }
  }
}

}  // namespace

std::vector<Net> control_surface(const Net& net) {
  std::vector<Net> pieces;
  std::visit([&](const auto& n) { add_pieces(n, pieces); }, net);
  return pieces;
}

}  // namespace rondure
