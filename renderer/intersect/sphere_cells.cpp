#include "renderer/intersect/sphere_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/box.h"
#include "renderer/bezier/curve.h"
#include "renderer/bezier/rational.h"
#include "renderer/intersect/cell.h"

namespace rondure {
namespace {

constexpr double margin = 1e-6;       // around sides: far beyond rounding, far within a cell
constexpr double worst_start = 4e-3;  // error of a cell's quadratic; two or three steps then suffice

struct Touch {
  std::int32_t patch;
  dvec2 at;         // parameters, less the middle
  double distance;  // from the cell's middle
};

struct Draft {
  std::vector<Touch> touches;  // one a patch at most
  bool has_side = false;
};

double outside(const SpherePatch& patch, dvec2 p) {
  return patch.triangle ? TriangleShape::outside(p) : TensorShape::outside(p);
}

class Grid {
 public:
  Grid(const std::vector<Net>& nets, SpherePatches& out)
      : nets_(nets), out_(out), side_(out.cells_a_side), drafts_(6 * count(side_) * count(side_)) {}

  void fill() {
    for (std::size_t k = 0; k < nets_.size(); ++k) {
      mark_inside(k);
      mark_sides(k);
    }
    out_.cells.assign(drafts_.size(), SphereCell{});
    std::vector<std::size_t> fresh;
    for (std::size_t k = 0; k < drafts_.size(); ++k) {
      out_.cells[k].owner = out_.cells[k].others = -1;
      if (try_own(k)) fresh.push_back(k);
    }
    // What the samples passed over, next to owned cells.
    while (!fresh.empty()) {
      std::vector<std::size_t> next;
      for (const std::size_t k : fresh) {
        for (int j = 0; j < 4; ++j) {
          const std::size_t beside = neighbour(k, j);
          const std::int32_t owner = out_.cells[k].owner;
          const bool known = has(beside, owner);
          if (!known) touch(beside, {owner, start_of(k, middle_of(beside)), INFINITY});
          if (out_.cells[beside].owner < 0 && !known && try_own(beside)) next.push_back(beside);
        }
      }
      fresh = std::move(next);
    }
    for (std::size_t k = 0; k < drafts_.size(); ++k)
      if (out_.cells[k].owner < 0 && !drafts_[k].touches.empty()) list_candidates(k);
  }

 private:
  static std::size_t count(int n) { return static_cast<std::size_t>(n); }

  const PatchInverse& inverse_of(std::size_t patch) const {
    return out_.inverses[static_cast<std::size_t>(out_.patches[patch].inverse)];
  }
  dvec2 middle(std::size_t patch) const { return inverse_of(patch).middle; }

  // Where coordinates (a, b), -1 to 1 inside, of a cell point to.
  dvec3 direction(std::size_t cell, double a, double b) const {
    const int face = static_cast<int>(cell / (count(side_) * count(side_))),
              row = static_cast<int>(cell / count(side_)) % side_,
              column = static_cast<int>(cell % count(side_));
    const double g = (2.0 * row + 1.0 + a) / side_ - 1.0, h = (2.0 * column + 1.0 + b) / side_ - 1.0;
    dvec3 n;
    const int axis = face / 2;
    n[axis] = face % 2 == 0 ? 1.0 : -1.0, n[(axis + 1) % 3] = g, n[(axis + 2) % 3] = h;
    return glm::normalize(n);
  }
  dvec3 middle_of(std::size_t cell) const { return direction(cell, 0.0, 0.0); }
  std::size_t neighbour(std::size_t cell, int j) const {
    const double step = j % 2 == 0 ? 1.001 : -1.001;
    return cell_at(direction(cell, j < 2 ? step : 0.0, j < 2 ? 0.0 : step), side_).cell;
  }

  bool has(std::size_t cell, std::int32_t patch) const {
    for (const Touch& t : drafts_[cell].touches)
      if (t.patch == patch) return true;
    return false;
  }
  void touch(std::size_t cell, const Touch& touch) {
    for (Touch& t : drafts_[cell].touches) {
      if (t.patch != touch.patch) continue;
      if (touch.distance < t.distance) t = touch;
      return;
    }
    drafts_[cell].touches.push_back(touch);
  }

  void mark_inside(std::size_t k) {
    const SpherePatch& patch = out_.patches[k];
    double size = 0.0;
    for (const dvec4& p : points_of(nets_[k]))
      size = std::max(size, std::min(glm::length(dvec3(p) / p.w + patch.axes[2]), 2.0));
    const int steps = std::clamp(static_cast<int>(2.0 * side_ * size), 6, 3 * side_ + 6);
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; j <= (patch.triangle ? steps - i : steps); ++j) {
        const double u = double(i) / steps, v = double(j) / steps;
        const dvec3 n = net_point(nets_[k], u, v);
        const CellPlace place = cell_at(n, side_);
        touch(place.cell, {static_cast<std::int32_t>(k), dvec2(u, v) - middle(k),
                           std::max(std::fabs(place.a), std::fabs(place.b))});
      }
  }

  void mark_sides(std::size_t k) {
    const auto side = [&](std::vector<dvec4> points, dvec2 from, dvec2 to) {
      mark_curve(k, points, from, to, 0);
    };
    std::vector<dvec4> points;
    if (const auto* t = std::get_if<TensorNet>(&nets_[k])) {
      for (const int i : {0, t->m}) {
        points.clear();
        for (int j = 0; j <= t->n; ++j) points.push_back(t->at(i, j));
        side(points, dvec2(i > 0, 0.0), dvec2(i > 0, 1.0));
      }
      for (const int j : {0, t->n}) {
        points.clear();
        for (int i = 0; i <= t->m; ++i) points.push_back(t->at(i, j));
        side(points, dvec2(0.0, j > 0), dvec2(1.0, j > 0));
      }
      return;
    }
    const auto& t = std::get<TriangleNet>(nets_[k]);
    for (int edge = 0; edge < 3; ++edge) {
      points.clear();
      for (int i = 0; i <= t.n; ++i)
        points.push_back(edge == 0 ? t.at(0, i) : edge == 1 ? t.at(i, 0) : t.at(i, t.n - i));
      side(points, edge == 2 ? dvec2(0.0, 1.0) : dvec2(0.0), edge == 0 ? dvec2(0.0, 1.0) : dvec2(1.0, 0.0));
    }
  }

  void mark_curve(std::size_t k, const std::vector<dvec4>& points, dvec2 from, dvec2 to, int depth) {
    Box box;
    for (const dvec4& p : points) box.add(dvec3(p) / p.w);
    const dvec3 extent = box.high - box.low;
    if (largest(extent) > 0.5 / side_ && depth < 24) {
      std::vector<dvec4> low(points.size()), high(points.size());
      curve_halve(points.data(), static_cast<int>(points.size()) - 1, 1, low.data(), high.data());
      const dvec2 half = 0.5 * (from + to);
      mark_curve(k, low, from, half, depth + 1);
      mark_curve(k, high, half, to, depth + 1);
      return;
    }
    box.low -= margin, box.high += margin;
    for (int face = 0; face < 6; ++face) mark_face(k, box, face, 0.5 * (from + to));
  }

  // The cells of a face that the box covers, seen from the middle.
  void mark_face(std::size_t k, const Box& box, int face, dvec2 at) {
    const int axis = face / 2, second = (axis + 1) % 3, third = (axis + 2) % 3;
    const double near = face % 2 == 0 ? box.low[axis] : -box.high[axis],
                 far = face % 2 == 0 ? box.high[axis] : -box.low[axis];
    if (far < 0.5) return;  // a face's points have at least 1 / sqrt(3)
    const auto range = [&](int c, int& first, int& last) {
      const double low = box.low[c] / (box.low[c] < 0.0 ? near : far),
                   high = box.high[c] / (box.high[c] > 0.0 ? near : far);
      first = std::max(0, static_cast<int>(std::floor((low + 1.0) * 0.5 * side_)));
      last = std::min(side_ - 1, static_cast<int>(std::floor((high + 1.0) * 0.5 * side_)));
    };
    int r0, r1, c0, c1;
    range(second, r0, r1);
    range(third, c0, c1);
    for (int r = r0; r <= r1; ++r)
      for (int c = c0; c <= c1; ++c) {
        const std::size_t cell = (count(face) * count(side_) + count(r)) * count(side_) + count(c);
        drafts_[cell].has_side = true;
        touch(cell, {static_cast<std::int32_t>(k), at - middle(k), 2.0});
      }
  }

  dvec2 start_of(std::size_t cell, const dvec3& n) const {
    const auto owner = static_cast<std::size_t>(out_.cells[cell].owner);
    dvec2 p(out_.cells[cell].u[0], out_.cells[cell].v[0]);
    invert(inverse_of(owner), out_.patches[owner], n, 8, p);
    return p;
  }

  // Gives a cell to the patch that fills it.
  bool try_own(std::size_t k) {
    const Draft& draft = drafts_[k];
    return !draft.has_side && draft.touches.size() == 1 && set_start(k, draft.touches[0], true);
  }

  // A quadratic through nine of the cell's points.
  bool set_start(std::size_t k, const Touch& touch, bool fills) {
    const auto patch = static_cast<std::size_t>(touch.patch);
    dvec2 at[3][3];
    at[1][1] = touch.at;
    constexpr double step = 0.75;
    for (const auto& [i, j] :
         {std::pair{1, 1}, {0, 1}, {2, 1}, {1, 0}, {1, 2}, {0, 0}, {0, 2}, {2, 0}, {2, 2}}) {
      dvec2 p = at[1][1];
      const double moved =
          invert(inverse_of(patch), out_.patches[patch], direction(k, (i - 1) * step, (j - 1) * step), 12, p);
      const double beyond = outside(out_.patches[patch], p + middle(patch));
      if (!(moved < 1e-9) || !(beyond < (fills ? 0.0 : 0.5))) return false;
      at[i][j] = p;
    }
    SphereCell& cell = out_.cells[k];
    for (int c = 0; c < 2; ++c) {
      const auto f = [&](int i, int j) { return at[i][j][c]; };
      float* out = c == 0 ? cell.u : cell.v;
      const double middle = f(1, 1);
      const double bend_a = f(2, 1) - 2.0 * middle + f(0, 1), bend_b = f(1, 2) - 2.0 * middle + f(1, 0),
                   twist = 0.25 * (f(2, 2) - f(2, 0) - f(0, 2) + f(0, 0));
      const double values[6] = {middle,
                                0.5 * (f(2, 1) - f(0, 1)) / step,
                                0.5 * (f(1, 2) - f(1, 0)) / step,
                                0.5 * bend_a / (step * step),
                                twist / (step * step),
                                0.5 * bend_b / (step * step)};
      for (int i = 0; i < 6; ++i) out[i] = static_cast<float>(values[i]);
      // The corners tell how good it is.
      for (const auto& [i, j] : {std::pair{0, 0}, {0, 2}, {2, 0}, {2, 2}}) {
        const double a = (i - 1) * step, b = (j - 1) * step;
        const double start = values[0] + values[1] * a + values[2] * b + values[3] * a * a +
                             values[4] * a * b + values[5] * b * b;
        if (!(std::fabs(start - f(i, j)) < worst_start)) return false;
      }
    }
    cell.owner = static_cast<std::int32_t>(patch);
    return true;
  }

  void list_candidates(std::size_t k) {
    std::vector<Touch>& touches = drafts_[k].touches;
    std::stable_sort(touches.begin(), touches.end(),
                     [](const Touch& a, const Touch& b) { return a.distance < b.distance; });
    for (const Touch& t : touches)
      if (set_start(k, t, false)) break;
    out_.cells[k].others = static_cast<std::int32_t>(out_.candidates.size());
    for (const Touch& t : touches)
      out_.candidates.push_back({t.patch, static_cast<float>(t.at.x), static_cast<float>(t.at.y)});
    out_.candidates.push_back({-1, 0.0f, 0.0f});
  }

  const std::vector<Net>& nets_;
  SpherePatches& out_;
  int side_;
  std::vector<Draft> drafts_;
};

}  // namespace

void fill_sphere_cells(const std::vector<Net>& nets, SpherePatches& out) { Grid(nets, out).fill(); }

}  // namespace rondure
