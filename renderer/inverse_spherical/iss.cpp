#include "renderer/inverse_spherical/iss.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <stdexcept>

#include "renderer/bezier/triangle_keys.h"

namespace rondure {

dvec3 PlanarIss::u(int i, int j) const {
  const double a = i, b = j, c = n - i - j;
  return (a * corners[0] + b * corners[1] + c * corners[2]) / static_cast<double>(n);
}

PlanarIss planar_iss(int n, const std::array<dvec3, 3>& corners, const std::vector<double>& c) {
  PlanarIss s{n, corners, c};
  std::size_t at = 0;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n - i; ++j) s.weights[at++] *= glm::length(s.u(i, j));
  }
  return s;
}

Iss general_form(const PlanarIss& s) {
  Iss out{s.n, {}, s.weights};
  for (int i = 0; i <= s.n; ++i) {
    for (int j = 0; j <= s.n - i; ++j) {
      out.u.push_back(s.u(i, j));
      out.c[out.u.size() - 1] /= glm::length(out.u.back());
    }
  }
  return out;
}

TriangleNet net_of(const Iss& s) {
  TriangleNet net(s.n);
  for (std::size_t k = 0; k < net.points.size(); ++k) {
    net.points[k] = dvec4(s.u[k], s.c[k] * glm::length(s.u[k]));
  }
  return net;
}

TriangleNet net_of(const PlanarIss& s) {
  TriangleNet net(s.n);
  for (int i = 0; i <= s.n; ++i) {
    for (int j = 0; j <= s.n - i; ++j) {
      net.at(i, j) = dvec4(s.u(i, j), s.weights[static_cast<std::size_t>(triangle_index(s.n, i, j))]);
    }
  }
  return net;
}

Iss iss_of(const TriangleNet& net) {
  Iss s{net.n, {}, {}};
  for (int i = 0; i <= net.n; ++i) {
    for (int j = 0; j <= net.n - i; ++j) {
      const dvec4& p = net.at(i, j);
      const double length = glm::length(dvec3(p));
      if (!(p.w > 0.0) || !(length > 0.0)) {
        throw std::invalid_argument(fmt::format(
            "control point {} has {}: no inverse spherical surface", triangle_key_name(net.n, i, j),
            p.w > 0.0 ? "no direction" : "a weight that is not positive"));
      }
      s.u.emplace_back(p);
      s.c.push_back(p.w / length);
    }
  }
  return s;
}

PlanarIss rotated(const PlanarIss& s, int first) {
  PlanarIss out = s;
  for (int m = 0; m < 3; ++m) {
    out.corners[static_cast<std::size_t>(m)] = s.corners[static_cast<std::size_t>((m + first) % 3)];
  }
  for (int i = 0; i <= s.n; ++i) {
    for (int j = 0; j <= s.n - i; ++j) {
      const int renamed[3] = {i, j, s.n - i - j};
      int old[3];
      for (int m = 0; m < 3; ++m) old[(m + first) % 3] = renamed[m];
      out.weights[static_cast<std::size_t>(triangle_index(s.n, i, j))] =
          s.weights[static_cast<std::size_t>(triangle_index(s.n, old[0], old[1]))];
    }
  }
  return out;
}

}  // namespace rondure
