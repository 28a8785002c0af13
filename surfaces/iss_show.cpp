#include "surfaces/iss_show.h"

#include "renderer/bezier/tube.h"
#include "renderer/inverse_spherical/sphere_triangle.h"

namespace rondure {
namespace {

dvec3 control_point(const TriangleNet& net, int i, int j) { return dvec3(net.at(i, j)) / net.at(i, j).w; }

void add(std::vector<TensorNet> nets, std::vector<Net>& out) {
  for (TensorNet& net : nets) out.emplace_back(std::move(net));
}

TriangleNet flat_triangle(const dvec3& a, const dvec3& b, const dvec3& c) {
  TriangleNet net(1);
  net.at(1, 0) = dvec4(a, 1.0), net.at(0, 1) = dvec4(b, 1.0), net.at(0, 0) = dvec4(c, 1.0);
  return net;
}

void add_control_surface(const TriangleNet& net, std::vector<Net>& out) {
  const int n = net.n;
  const auto point = [&](int i, int j) { return control_point(net, i, j); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n - i; ++j) {
      out.emplace_back(flat_triangle(point(i + 1, j), point(i, j + 1), point(i, j)));
      if (i + j > n - 2) continue;
      out.emplace_back(flat_triangle(point(i + 1, j + 1), point(i, j + 1), point(i + 1, j)));
    }
  }
}

void add_ball(const dvec3& center, double radius, std::vector<Net>& out) {
  for (int octant = 0; octant < 8; ++octant) {
    const double x = (octant & 1) != 0 ? -1.0 : 1.0, y = (octant & 2) != 0 ? -1.0 : 1.0,
                 z = (octant & 4) != 0 ? -1.0 : 1.0;
    const dvec3 a(x, 0, 0), b(0, y, 0), c(0, 0, z);
    TriangleNet net = x * y * z > 0.0 ? sphere_triangle({a, b, c}) : sphere_triangle({b, a, c});
    for (dvec4& p : net.points) p = dvec4(radius * dvec3(p) + p.w * center, p.w);
    out.emplace_back(std::move(net));
  }
}

void add_control_net(const TriangleNet& net, double wire, std::vector<Net>& out) {
  const auto point = [&](int i, int j) { return control_point(net, i, j); };
  for (int i = 0; i <= net.n; ++i) {
    for (int j = 0; j <= net.n - i; ++j) {
      add_ball(point(i, j), 2.0 * wire, out);
      if (i + j == net.n) continue;
      add(straight_tube(point(i, j), point(i + 1, j), wire), out);
      add(straight_tube(point(i, j), point(i, j + 1), wire), out);
      add(straight_tube(point(i + 1, j), point(i, j + 1), wire), out);
    }
  }
}

}  // namespace

void add_iss_part(IssPart part, const IssPatch& patch, double wire, std::vector<Net>& out) {
  const TriangleNet net = net_of(patch);
  const auto* planar = std::get_if<PlanarIss>(&patch);
  if (part == IssPart::control_surface) add_control_surface(net, out);
  if (part == IssPart::control_net) add_control_net(net, wire, out);
  const dvec3 corners[3] = {dvec3(net.at(net.n, 0)), dvec3(net.at(0, net.n)), dvec3(net.at(0, 0))};
  for (int k = 0; k < 3; ++k) {
    const dvec3 &from = corners[k], &to = corners[(k + 1) % 3];
    if (part == IssPart::spherical_triangle) add(arc_tube(from, to, wire), out);
    if (part == IssPart::domain && planar) add(straight_tube(from, to, wire), out);
  }
}

}  // namespace rondure
