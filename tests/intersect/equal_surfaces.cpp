#include "tests/intersect/equal_surfaces.h"

#include <fmt/core.h>

#include <algorithm>

#include "renderer/bezier/elevate.h"
#include "renderer/bezier/tensor.h"
#include "renderer/bezier/triangle.h"

namespace rondure {
namespace {

using Map = std::function<dvec2(dvec2)>;

struct Piece {
  Net net;
  Map back;
};

dvec2 identity(dvec2 p) { return p; }

// Roundings: a mean of two coefficients a level of de Casteljau's algorithm.
double halving_roundings(const Net& net) {
  if (const auto* tensor = std::get_if<TensorNet>(&net)) return tensor->m + tensor->n;
  return std::get<TriangleNet>(net).n;
}

std::vector<Piece> halves_u(const Piece& whole) {
  const auto& net = std::get<TensorNet>(whole.net);
  TensorNet low(net.m, net.n), high(net.m, net.n);
  tensor_halve_u(net.points.data(), net.m, net.n, low.points.data(), high.points.data());
  const Map outer = whole.back;
  return {{low,
           [outer](dvec2 p) {
             return outer({0.5 * p.x, p.y});
           }},
          {high, [outer](dvec2 p) {
             return outer({0.5 + 0.5 * p.x, p.y});
           }}};
}

std::vector<Piece> halves_v(const Piece& whole) {
  const auto& net = std::get<TensorNet>(whole.net);
  TensorNet low(net.m, net.n), high(net.m, net.n);
  tensor_halve_v(net.points.data(), net.m, net.n, low.points.data(), high.points.data());
  const Map outer = whole.back;
  return {{low,
           [outer](dvec2 p) {
             return outer({p.x, 0.5 * p.y});
           }},
          {high, [outer](dvec2 p) {
             return outer({p.x, 0.5 + 0.5 * p.y});
           }}};
}

// Of a triangle's parts: where their corners u = 1, v = 1 and w = 1 are.
Map map_of(dvec2 cu, dvec2 cv, dvec2 cw) {
  return [=](dvec2 p) { return p.x * cu + p.y * cv + (1.0 - p.x - p.y) * cw; };
}

std::vector<Piece> bisected(const TriangleNet& net) {
  TriangleNet low(net.n), high(net.n);
  triangle_bisect(net.points.data(), net.n, low.points.data(), high.points.data());
  return {{low, map_of({1, 0}, {0.5, 0.5}, {0, 0})}, {high, map_of({0.5, 0.5}, {0, 1}, {0, 0})}};
}

std::vector<Piece> quartered(const TriangleNet& net) {
  TriangleNet at_u(net.n), at_v(net.n), at_w(net.n), middle(net.n);
  triangle_quarter(net.points.data(), net.n, at_u.points.data(), at_v.points.data(), at_w.points.data(),
                   middle.points.data());
  const dvec2 uv(0.5, 0.5), vw(0.0, 0.5), uw(0.5, 0.0);
  return {{at_u, map_of({1, 0}, uv, uw)},
          {at_v, map_of(uv, {0, 1}, vw)},
          {at_w, map_of(uw, vw, {0, 0})},
          {middle, map_of(vw, uw, uv)}};
}

std::vector<Piece> quarters(const Net& net) {
  if (const auto* triangle = std::get_if<TriangleNet>(&net)) return quartered(*triangle);
  std::vector<Piece> out;
  for (const Piece& half : halves_u({net, identity}))
    for (Piece& quarter : halves_v(half)) out.push_back(std::move(quarter));
  return out;
}

Net elevated(const Net& net) {
  if (const auto* triangle = std::get_if<TriangleNet>(&net)) {
    TriangleNet out(triangle->n + 1);
    triangle_elevate(triangle->points.data(), triangle->n, out.points.data());
    return out;
  }
  const auto& tensor = std::get<TensorNet>(net);
  TensorNet in_u(tensor.m + 1, tensor.n), out(tensor.m + 1, tensor.n + 1);
  tensor_elevate_u(tensor.points.data(), tensor.m, tensor.n, in_u.points.data());
  tensor_elevate_v(in_u.points.data(), in_u.m, in_u.n, out.points.data());
  return out;
}

// A product and three more roundings, and in a tensor net 1 - t, which is good to a roundoff of 1 and may be
// as small as 1 / (degree + 1).
double elevation_roundings(const Net& net) {
  if (const auto* tensor = std::get_if<TensorNet>(&net)) return tensor->m + tensor->n + 8;
  return 4;
}

// Control point (i, j) times a^i b^j. With B_i(u') a^i in place of B_i(u), u : 1 - u = a u' : 1 - u'; on a
// triangle u : v : w = a u' : b v' : w'.
Piece projected(const Net& net, double a, double b) {
  const auto power = [](double base, int exponent) {
    double out = 1.0;
    for (int k = 0; k < exponent; ++k) out *= base;
    return out;
  };
  if (const auto* triangle = std::get_if<TriangleNet>(&net)) {
    TriangleNet out = *triangle;
    for (int i = 0; i <= out.n; ++i)
      for (int j = 0; j <= out.n - i; ++j) out.at(i, j) *= power(a, i) * power(b, j);
    return {out, [a, b](dvec2 p) {
              const double u = a * p.x, v = b * p.y, w = 1.0 - p.x - p.y;
              return dvec2(u, v) / (u + v + w);
            }};
  }
  TensorNet out = std::get<TensorNet>(net);
  for (int i = 0; i <= out.m; ++i)
    for (int j = 0; j <= out.n; ++j) out.at(i, j) *= power(a, i) * power(b, j);
  return {out, [a, b](dvec2 p) {
            return dvec2(a * p.x / (1.0 - p.x + a * p.x), b * p.y / (1.0 - p.y + b * p.y));
          }};
}

// A product a power, one of the two powers, and one with the point.
double projection_roundings(const Net& net) { return halving_roundings(net) + 2; }

// `make`: the pieces of one net; `roundings`: of each of them.
template <class Make, class Roundings>
EqualSurface made(const std::string& name, const Surface& surface, const Make& make,
                  const Roundings& roundings) {
  EqualSurface out;
  out.name = name;
  out.surface = surface;
  out.surface.patches.clear(), out.surface.joins.clear(), out.surface.guides.clear();
  for (std::size_t k = 0; k < surface.patches.size(); ++k) {
    out.roundings = std::max<double>(out.roundings, roundings(surface.patches[k]));
    for (Piece& piece : make(surface.patches[k])) {
      out.surface.patches.push_back(std::move(piece.net));
      out.pieces.push_back({static_cast<int>(k), std::move(piece.back)});
    }
  }
  return out;
}

}  // namespace

std::vector<EqualSurface> equals_of(const Surface& surface) {
  const auto one = [](Piece piece) {
    std::vector<Piece> out;
    out.push_back(std::move(piece));
    return out;
  };
  const auto halves = [](const Net& net, bool in_u) {
    if (const auto* triangle = std::get_if<TriangleNet>(&net)) return bisected(*triangle);
    return in_u ? halves_u({net, identity}) : halves_v({net, identity});
  };
  std::vector<EqualSurface> out;
  out.push_back(made(
      "halves in u", surface, [&](const Net& net) { return halves(net, true); }, halving_roundings));
  out.push_back(made(
      "halves in v", surface, [&](const Net& net) { return halves(net, false); }, halving_roundings));
  out.push_back(made("quarters", surface, quarters, halving_roundings));
  out.push_back(made(
      "one degree more", surface,
      [&](const Net& net) {
        return one({elevated(net), identity});
      },
      elevation_roundings));
  const auto thrice = [](const Net& net) { return elevated(elevated(elevated(net))); };
  // Of three elevations of growing degree.
  out.push_back(made(
      "three degrees more", surface,
      [&](const Net& net) {
        return one({thrice(net), identity});
      },
      [](const Net& net) { return 3.0 * elevation_roundings(net) + 6.0; }));
  for (const auto& [a, b] : {std::pair{2.0, 0.25}, {0.125, 1.0}})
    out.push_back(made(
        fmt::format("weights times {:g}^i {:g}^j", a, b), surface,
        [&, a = a, b = b](const Net& net) { return one(projected(net, a, b)); },
        [](const Net&) { return 0.0; }));
  for (const auto& [a, b] : {std::pair{1.3, 0.7}, {3.0, 5.0}})
    out.push_back(made(
        fmt::format("weights times {:g}^i {:g}^j", a, b), surface,
        [&, a = a, b = b](const Net& net) { return one(projected(net, a, b)); }, projection_roundings));
  return out;
}

}  // namespace rondure
