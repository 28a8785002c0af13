// Whether two hits are one, to the last bit of every number.
#pragma once

#include <array>
#include <cstring>

#include "renderer/intersect/ray.h"

namespace rondure {

inline bool same_bits(const Hit& a, const Hit& b) {
  const auto bits = [](const Hit& h) {
    return std::array{h.t,       h.t_error, double(h.surface), double(h.patch), h.u,        h.v,
                      h.point.x, h.point.y, h.point.z,         h.normal.x,      h.normal.y, h.normal.z};
  };
  const auto x = bits(a), y = bits(b);
  return std::memcmp(x.data(), y.data(), sizeof x) == 0;
}

}  // namespace rondure
