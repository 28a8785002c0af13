#include "renderer/bezier/rational.h"

#include "renderer/bezier/dispatch.h"
#include "renderer/bezier/triangle.h"

namespace rondure {
namespace {

FirstOrder<dvec4> first(const TensorNet& net, double u, double v) {
  return with_degrees(net.m, net.n, [&](auto m, auto n) {
    return tensor_first<m, n>(net.points.data(), net.m, net.n, u, v);
  });
}

SecondOrder<dvec4> second(const TensorNet& net, double u, double v) {
  return with_degrees(net.m, net.n, [&](auto m, auto n) {
    return tensor_second<m, n>(net.points.data(), net.m, net.n, u, v);
  });
}

dvec4 value(const TensorNet& net, double u, double v) {
  return with_degrees(net.m, net.n, [&](auto m, auto n) {
    return tensor_value<m, n>(net.points.data(), net.m, net.n, u, v);
  });
}

FirstOrder<dvec4> first(const TriangleNet& net, double u, double v) {
  return with_degree(net.n, [&](auto n) { return triangle_first<n>(net.points.data(), net.n, u, v); });
}

SecondOrder<dvec4> second(const TriangleNet& net, double u, double v) {
  return with_degree(net.n, [&](auto n) { return triangle_second<n>(net.points.data(), net.n, u, v); });
}

dvec4 value(const TriangleNet& net, double u, double v) {
  return with_degree(net.n, [&](auto n) { return triangle_value<n>(net.points.data(), net.n, u, v); });
}

}  // namespace

FirstOrder<dvec4> net_first(const Net& net, double u, double v) {
  return std::visit([&](const auto& n) { return first(n, u, v); }, net);
}

SecondOrder<dvec4> net_second(const Net& net, double u, double v) {
  return std::visit([&](const auto& n) { return second(n, u, v); }, net);
}

dvec3 net_point(const Net& net, double u, double v) {
  const dvec4 p = std::visit([&](const auto& n) { return value(n, u, v); }, net);
  return dvec3(p) / p.w;
}

// The quotient rule, from X = w f differentiated twice.
SurfaceJet surface_jet(const Net& net, double u, double v) {
  const SecondOrder<dvec4> x = net_second(net, u, v);
  const double w = x.value.w;
  SurfaceJet s{};
  s.point = dvec3(x.value) / w;
  s.du = (dvec3(x.du) - x.du.w * s.point) / w;
  s.dv = (dvec3(x.dv) - x.dv.w * s.point) / w;
  s.duu = (dvec3(x.duu) - 2.0 * x.du.w * s.du - x.duu.w * s.point) / w;
  s.duv = (dvec3(x.duv) - x.du.w * s.dv - x.dv.w * s.du - x.duv.w * s.point) / w;
  s.dvv = (dvec3(x.dvv) - 2.0 * x.dv.w * s.dv - x.dvv.w * s.point) / w;
  return s;
}

}  // namespace rondure
