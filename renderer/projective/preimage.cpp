#include "renderer/projective/preimage.h"

#include <algorithm>
#include <cmath>

namespace rondure {
namespace {

TensorNet net_like(const TensorPolynomial<lvec4>& p) { return {p.m, p.n}; }
TriangleNet net_like(const TrianglePolynomial<lvec4>& p) { return TriangleNet(p.n); }

template <class Polynomial>
auto rounded(const Polynomial& image, const lmat4& map) {
  auto net = net_like(image);
  long double largest = 0;
  std::vector<lvec4> points;
  for (const lvec4& c : image.coefficients) {
    points.push_back(map * c);
    for (int d = 0; d < 4; ++d) largest = std::max(largest, std::abs(points.back()[d]));
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (int d = 0; d < 4; ++d) {
      // What is left of a sum that vanishes exactly: some units of the last of the 64 bits.
      const bool vanishes = std::abs(points[k][d]) < 0x1p-58L * largest;
      net.points[k][d] = vanishes ? 0.0 : static_cast<double>(points[k][d]);
    }
  }
  return net;
}

}  // namespace

long double squaring_factor(const std::vector<lvec4>& points) {
  long double largest = 0;
  for (const lvec4& p : points) {
    for (int d = 0; d < 4; ++d) largest = std::max(largest, std::abs(p[d]));
  }
  const bool usual = largest == 0 || (largest > 0x1p-100L && largest < 0x1p100L);
  return usual ? 1.0L : std::ldexp(1.0L, -std::ilogb(largest));
}

Net sphere_image(const Preimage& preimage) {
  return quadric_image(preimage, {QuadricKind::ellipsoid, lvec3(1), lmat4(1)});
}

Net quadric_image(const Preimage& preimage, const Quadric& quadric) {
  const lmat4 map = map_to(quadric);
  const auto form = [ruled = is_ruled(quadric.kind)](const lvec4& p, const lvec4& q) {
    return ruled ? ruled_image(p, q) : delta(p, q);
  };
  return std::visit([&](const auto& p) -> Net { return rounded(multiply(p, p, form), map); }, preimage);
}

}  // namespace rondure
