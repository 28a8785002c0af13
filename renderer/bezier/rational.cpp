#include "renderer/bezier/rational.h"

#include "renderer/bezier/triangle.h"

namespace rondure {
namespace {

FirstOrder<dvec4> first(const TensorNet& net, double u, double v) {
  const dvec4* p = net.points.data();
  switch (net.m * 100 + net.n) {
    case 202:
      return tensor_first<2, 2>(p, 2, 2, u, v);
    case 204:
      return tensor_first<2, 4>(p, 2, 4, u, v);
    case 402:
      return tensor_first<4, 2>(p, 4, 2, u, v);
    case 404:
      return tensor_first<4, 4>(p, 4, 4, u, v);
    default:
      return tensor_first(p, net.m, net.n, u, v);
  }
}

SecondOrder<dvec4> second(const TensorNet& net, double u, double v) {
  const dvec4* p = net.points.data();
  switch (net.m * 100 + net.n) {
    case 202:
      return tensor_second<2, 2>(p, 2, 2, u, v);
    case 204:
      return tensor_second<2, 4>(p, 2, 4, u, v);
    case 402:
      return tensor_second<4, 2>(p, 4, 2, u, v);
    case 404:
      return tensor_second<4, 4>(p, 4, 4, u, v);
    default:
      return tensor_second(p, net.m, net.n, u, v);
  }
}

dvec4 value(const TensorNet& net, double u, double v) {
  const dvec4* p = net.points.data();
  switch (net.m * 100 + net.n) {
    case 202:
      return tensor_value<2, 2>(p, 2, 2, u, v);
    case 204:
      return tensor_value<2, 4>(p, 2, 4, u, v);
    case 402:
      return tensor_value<4, 2>(p, 4, 2, u, v);
    case 404:
      return tensor_value<4, 4>(p, 4, 4, u, v);
    default:
      return tensor_value(p, net.m, net.n, u, v);
  }
}

FirstOrder<dvec4> first(const TriangleNet& net, double u, double v) {
  const dvec4* p = net.points.data();
  switch (net.n) {
    case 1:
      return triangle_first<1>(p, 1, u, v);
    case 2:
      return triangle_first<2>(p, 2, u, v);
    case 3:
      return triangle_first<3>(p, 3, u, v);
    case 4:
      return triangle_first<4>(p, 4, u, v);
    case 5:
      return triangle_first<5>(p, 5, u, v);
    case 6:
      return triangle_first<6>(p, 6, u, v);
    default:
      return triangle_first(p, net.n, u, v);
  }
}

SecondOrder<dvec4> second(const TriangleNet& net, double u, double v) {
  const dvec4* p = net.points.data();
  switch (net.n) {
    case 1:
      return triangle_second<1>(p, 1, u, v);
    case 2:
      return triangle_second<2>(p, 2, u, v);
    case 3:
      return triangle_second<3>(p, 3, u, v);
    case 4:
      return triangle_second<4>(p, 4, u, v);
    case 5:
      return triangle_second<5>(p, 5, u, v);
    case 6:
      return triangle_second<6>(p, 6, u, v);
    default:
      return triangle_second(p, net.n, u, v);
  }
}

dvec4 value(const TriangleNet& net, double u, double v) {
  const dvec4* p = net.points.data();
  switch (net.n) {
    case 1:
      return triangle_value<1>(p, 1, u, v);
    case 2:
      return triangle_value<2>(p, 2, u, v);
    case 3:
      return triangle_value<3>(p, 3, u, v);
    case 4:
      return triangle_value<4>(p, 4, u, v);
    case 5:
      return triangle_value<5>(p, 5, u, v);
    case 6:
      return triangle_value<6>(p, 6, u, v);
    default:
      return triangle_value(p, net.n, u, v);
  }
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
