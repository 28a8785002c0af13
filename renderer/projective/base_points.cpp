#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/tensor.h"
#include "renderer/bezier/triangle.h"
#include "renderer/projective/preimage.h"

namespace rondure {
namespace {

// Halvings after which a cell that may still hold a zero counts as one.
constexpr int most_halvings = 30;

// A piece of the domain with its control points. Corners of a rectangle: its lowest and highest; of a
// triangle: where u, v, w = 1.
struct PreimageCell {
  std::vector<dvec4> points;
  dvec2 corner[3];
  int depth;
};

// Cells looked at before the rest counts as holding a zero: beyond, the net is as good as one that does.
constexpr int most_cells = 1 << 18;

// Whether a plane separates all control points from zero: then the cell holds none. Directions alone count,
// so that one large point does not choose the plane for all.
bool separated(const std::vector<dvec4>& points) {
  dvec4 sum(0.0);
  for (const dvec4& p : points) {
    const double length = glm::length(p);
    if (length > 0.0) sum += p / length;
  }
  return std::all_of(points.begin(), points.end(), [&](const dvec4& p) { return glm::dot(sum, p) > 0.0; });
}

std::vector<PreimageCell> parts_of(const TensorPreimage& p, const PreimageCell& cell) {
  const std::size_t size = cell.points.size();
  const auto part = [&](dvec2 low, dvec2 high) {
    return PreimageCell{std::vector<dvec4>(size), {low, high, high}, cell.depth + 1};
  };
  const dvec2 low = cell.corner[0], high = cell.corner[1], middle = 0.5 * (low + high);
  std::vector<PreimageCell> parts{part(low, middle), part({low.x, middle.y}, {middle.x, high.y}),
                                  part({middle.x, low.y}, {high.x, middle.y}), part(middle, high)};
  std::vector<dvec4> left(size), right(size);
  tensor_halve_u(cell.points.data(), p.m, p.n, left.data(), right.data());
  tensor_halve_v(left.data(), p.m, p.n, parts[0].points.data(), parts[1].points.data());
  tensor_halve_v(right.data(), p.m, p.n, parts[2].points.data(), parts[3].points.data());
  return parts;
}

std::vector<PreimageCell> parts_of(const TrianglePreimage& p, const PreimageCell& cell) {
  const dvec2 &u = cell.corner[0], &v = cell.corner[1], &w = cell.corner[2];
  const dvec2 uv = 0.5 * (u + v), vw = 0.5 * (v + w), uw = 0.5 * (u + w);
  const auto part = [&](dvec2 a, dvec2 b, dvec2 c) {
    return PreimageCell{std::vector<dvec4>(cell.points.size()), {a, b, c}, cell.depth + 1};
  };
  std::vector<PreimageCell> parts{part(u, uv, uw), part(uv, v, vw), part(uw, vw, w), part(vw, uw, uv)};
  triangle_quarter(cell.points.data(), p.n, parts[0].points.data(), parts[1].points.data(),
                   parts[2].points.data(), parts[3].points.data());
  return parts;
}

PreimageCell whole(const TensorPreimage&) { return {{}, {dvec2(0.0), dvec2(1.0), dvec2(1.0)}, 0}; }
PreimageCell whole(const TrianglePreimage&) { return {{}, {{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}}, 0}; }

template <class Polynomial>
void search(const Polynomial& p, const lvec4& mask, std::size_t limit, std::vector<dvec2>& found) {
  std::vector<PreimageCell> cells{whole(p)};
  for (const lvec4& c : p.coefficients) cells[0].points.emplace_back(c * mask);
  for (int count = 0; !cells.empty() && found.size() < limit && count <= most_cells; ++count) {
    const PreimageCell cell = std::move(cells.back());
    cells.pop_back();
    if (separated(cell.points)) continue;
    if (cell.depth < most_halvings && count < most_cells) {
      for (PreimageCell& part : parts_of(p, cell)) cells.push_back(std::move(part));
      continue;
    }
    const dvec2 at = 0.5 * (cell.corner[0] + cell.corner[1]);
    const auto near = [&](const dvec2& other) { return glm::distance(at, other) < 0x1p-20; };
    if (std::none_of(found.begin(), found.end(), near)) found.push_back(at);
  }
}

}  // namespace

std::vector<dvec2> base_points(const Preimage& preimage, bool ruled, std::size_t limit) {
  std::vector<dvec2> found;
  std::visit(
      [&](const auto& p) {
        search(p, ruled ? lvec4(1, 1, 0, 0) : lvec4(1), limit, found);
        if (ruled) search(p, {0, 0, 1, 1}, limit, found);
      },
      preimage);
  return found;
}

}  // namespace rondure
