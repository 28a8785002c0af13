// Nets as scenes write them, whatever their points are: control points or those of a preimage.
#pragma once

#include <fmt/format.h>

#include <string>

#include "renderer/api/patch.h"
#include "renderer/bezier/triangle_keys.h"

namespace rondure {

// Four numbers, with as many digits as read back the same.
template <class Point>
std::string point_text(const Point& p) {
  return fmt::format("[{}, {}, {}, {}]", static_cast<double>(p[0]), static_cast<double>(p[1]),
                     static_cast<double>(p[2]), static_cast<double>(p[3]));
}

// An entry of "patches".
template <class Points>
std::string tensor_text(const Points& net) {
  std::string out = fmt::format(R"({{ "kind": "tensor", "degree": [{}, {}], "net": [)", net.m, net.n);
  for (int i = 0; i <= net.m; ++i) {
    out += i > 0 ? ", [" : "[";
    for (int j = 0; j <= net.n; ++j) out += (j > 0 ? ", " : "") + point_text(net.at(i, j));
    out += "]";
  }
  return out + "] }";
}

template <class Points>
std::string triangle_text(const Points& net) {
  std::string out = fmt::format(R"({{ "kind": "triangle", "degree": {}, "net": {{ )", net.n);
  for (int i = 0; i <= net.n; ++i) {
    for (int j = 0; j <= net.n - i; ++j)
      out += fmt::format(R"({}"{}": {})", i + j > 0 ? ", " : "", triangle_key_name(net.n, i, j),
                         point_text(net.at(i, j)));
  }
  return out + " } }";
}

inline std::string net_text(const Net& net) {
  if (const auto* tensor = std::get_if<TensorNet>(&net)) return tensor_text(*tensor);
  return triangle_text(std::get<TriangleNet>(net));
}

}  // namespace rondure
