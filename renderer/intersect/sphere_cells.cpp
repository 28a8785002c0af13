#include "renderer/intersect/sphere_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/box.h"
#include "renderer/bezier/curve.h"
#include "renderer/bezier/rational.h"
#include "renderer/intersect/cell.h"
#include "renderer/intersect/direction_search.h"

namespace rondure {
namespace {

constexpr double margin = 1e-6;       // around sides: far beyond rounding, far within a cell
constexpr double worst_start = 4e-3;  // error of a cell's cubic; two steps then suffice

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
      : nets_(nets), out_(out), side_(out.cells_a_side), drafts_(6 * count(side_) * count(side_)) {
    for (const Net& net : nets) {
      Box box;
      for (const dvec4& p : points_of(net)) box.add(dvec3(p) / p.w);
      box.low -= margin, box.high += margin;
      boxes_.push_back(box);
    }
  }

  void fill() {
    for (std::size_t k = 0; k < nets_.size(); ++k) {
      mark_inside(k);
      mark_sides(k);
    }
    out_.cells.assign(drafts_.size(), SphereCell{});
    std::vector<std::size_t> fresh;
    for (std::size_t k = 0; k < drafts_.size(); ++k) {
      out_.cells[k].owner = out_.cells[k].others = out_.cells[k].next = -1;
      if (try_own(k)) fresh.push_back(k);
    }
    // What the samples passed over, next to owned cells.
    while (!fresh.empty()) {
      std::vector<std::size_t> next;
      for (const std::size_t k : fresh) {
        for (int j = 0; j < 8; ++j) {
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
      if (out_.cells[k].owner < 0) ask_for(k);
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
    const double g = cell_reach * ((2.0 * row + 1.0 + a) / side_ - 1.0),
                 h = cell_reach * ((2.0 * column + 1.0 + b) / side_ - 1.0);
    dvec3 n;
    const int axis = face / 2;
    const double major = std::sqrt(std::max(1.0 - g * g - h * h, 0.0));
    n[axis] = face % 2 == 0 ? major : -major, n[(axis + 1) % 3] = g, n[(axis + 2) % 3] = h;
    return glm::normalize(n);
  }
  dvec3 middle_of(std::size_t cell) const { return direction(cell, 0.0, 0.0); }
  // Beside a cell in its own face's grid (0 to 3), or itself where that ends; or where the points beyond it
  // are (4 to 7). Cells across the face's rim are reached in the grid alone: the points beyond them may be
  // another face's.
  std::size_t neighbour(std::size_t cell, int j) const {
    const int way = j % 2 == 0 ? 1 : -1, along_row = j / 2 % 2;
    if (j < 4) {
      const int place =
          along_row ? static_cast<int>(cell % count(side_)) : static_cast<int>(cell / count(side_)) % side_;
      if (place + way < 0 || place + way >= side_) return cell;
      const std::size_t step = along_row ? 1 : count(side_);
      return way > 0 ? cell + step : cell - step;
    }
    const double step = 1.001 * way;
    return cell_at(direction(cell, along_row ? 0.0 : step, along_row ? step : 0.0), side_).cell;
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
    const dvec3 z(patch.axes[0].z, patch.axes[1].z, patch.axes[2].z);
    double size = 0.0;
    for (const dvec4& p : points_of(nets_[k]))
      size = std::max(size, std::min(glm::length(dvec3(p) / p.w + z), 2.0));
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

  // The cells of a face that points of the sphere in the box are in.
  void mark_face(std::size_t k, const Box& box, int face, dvec2 at) {
    const int axis = face / 2, second = (axis + 1) % 3, third = (axis + 2) % 3;
    const double far = face % 2 == 0 ? box.high[axis] : -box.low[axis];
    if (far < 0.5) return;  // a face's points have at least 1 / sqrt(3)
    const auto range = [&](int c, int& first, int& last) {
      const auto cell = [&](double x) {
        return static_cast<int>(std::floor((x * cells_per_reach + 0.5) * side_));
      };
      first = std::max(0, cell(box.low[c])), last = std::min(side_ - 1, cell(box.high[c]));
    };
    int r0, r1, c0, c1;
    range(second, r0, r1);
    range(third, c0, c1);
    for (int r = r0; r <= r1; ++r)
      for (int c = c0; c <= c1; ++c) {
        const std::size_t cell = (count(face) * count(side_) + count(r)) * count(side_) + count(c);
        drafts_[cell].has_side = true;
        // Of samples inside, any is a better start.
        touch(cell, {static_cast<std::int32_t>(k), at - middle(k),
                     2.0 + glm::distance(middle_of(cell), box.center())});
      }
  }

  dvec2 start_of(std::size_t cell, const dvec3& n) const {
    const auto owner = static_cast<std::size_t>(out_.cells[cell].owner);
    dvec2 p(out_.cells[cell].start[0][0], out_.cells[cell].start[0][1]);
    invert(inverse_of(owner), out_.patches[owner], n, 8, p);
    return p;
  }

  // Of a cell that nobody owns, which patches hold one of its points that are not known to be there: a patch
  // without a side in the cell fills it, or has nothing in it.
  void ask_for(std::size_t k) {
    const dvec3 n = innermost(k);
    if (cell_at(n, side_).cell != k) return;  // no point of the sphere is in it
    for (std::size_t patch = 0; patch < nets_.size(); ++patch) {
      const Box& box = boxes_[patch];
      if (n.x < box.low.x || n.y < box.low.y || n.z < box.low.z || n.x > box.high.x || n.y > box.high.y ||
          n.z > box.high.z || has(k, static_cast<std::int32_t>(patch)))
        continue;
      if (const auto found = search_direction(nets_[patch], n))
        touch(k, {static_cast<std::int32_t>(patch), *found - middle(patch), 1.0});
    }
    try_own(k);
  }
  // The direction in the cell that is nearest to the middle of its face.
  dvec3 innermost(std::size_t cell) const {
    const int row = static_cast<int>(cell / count(side_)) % side_,
              column = static_cast<int>(cell % count(side_));
    const auto inner = [&](int place) {
      return 2 * place + 1 > side_ ? -0.999 : 2 * place + 1 < side_ ? 0.999 : 0.0;
    };
    return direction(cell, inner(row), inner(column));
  }

  // Gives a cell to the patch that fills it.
  bool try_own(std::size_t k) {
    const Draft& draft = drafts_[k];
    return !draft.has_side && draft.touches.size() == 1 &&
           set_start(k, draft.touches[0], true, out_.cells[k]);
  }

  // The cubic that is nearest to the parameters at sixteen of the cell's points, Chebyshev's.
  bool set_start(std::size_t k, const Touch& touch, bool fills, SphereCell& cell) const {
    const auto patch = static_cast<std::size_t>(touch.patch);
    // T_0 to T_3 at their nodes, and what they are of 1, x, x^2, x^3.
    static constexpr double far = 0.92387953251128674, near = 0.38268343236508977, half = 0.70710678118654752;
    static constexpr double nodes[4] = {-far, -near, near, far};
    static constexpr double basis[4][4] = {
        {1, 1, 1, 1}, {-far, -near, near, far}, {half, -half, -half, half}, {-near, far, -far, near}};
    static constexpr double powers[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {-1, 0, 2, 0}, {0, -3, 0, 4}};
    // One after the other from the middle, each from one beside it.
    dvec2 at[4][4];
    for (const int i : {1, 2, 0, 3})
      for (const int j : {1, 2, 0, 3}) {
        dvec2& p = at[i][j];
        p = i == 1 && j == 1 ? touch.at : j == 1 ? at[i == 0 ? 1 : i - 1][1] : at[i][j == 0 ? 1 : j - 1];
        const double moved =
            invert(inverse_of(patch), out_.patches[patch], direction(k, nodes[i], nodes[j]), 12, p, 1e-5);
        const double beyond = outside(out_.patches[patch], p + middle(patch));
        if (!(moved < 1e-9) || !(beyond < (fills ? 0.0 : 0.5))) return false;
      }
    double worst = 0.0;
    for (int c = 0; c < 2; ++c) {
      double monomials[4][4]{};
      for (int p = 0; p < 4; ++p)
        for (int q = 0; p + q < 4; ++q) {
          double sum = 0.0;
          for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) sum += at[i][j][c] * basis[p][i] * basis[q][j];
          sum *= (p == 0 ? 0.25 : 0.5) * (q == 0 ? 0.25 : 0.5);
          for (int i = 0; i <= p; ++i)
            for (int j = 0; j <= q; ++j) monomials[i][j] += sum * powers[p][i] * powers[q][j];
        }
      constexpr int order[10][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1},
                                    {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}};
      for (int i = 0; i < 10; ++i) cell.start[i][c] = static_cast<float>(monomials[order[i][0]][order[i][1]]);
    }
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const dvec2 off =
            cell.start_at(static_cast<float>(nodes[i]), static_cast<float>(nodes[j])) - at[i][j];
        worst = std::max({worst, std::fabs(off.x), std::fabs(off.y)});
      }
    if (!(worst < worst_start)) return false;
    cell.owner = static_cast<std::int32_t>(patch);
    return true;
  }

  void list_candidates(std::size_t k) {
    std::vector<Touch>& touches = drafts_[k].touches;
    std::stable_sort(touches.begin(), touches.end(),
                     [](const Touch& a, const Touch& b) { return a.distance < b.distance; });
    out_.cells[k].others = static_cast<std::int32_t>(out_.candidates.size());
    std::size_t last = k;
    for (const Touch& t : touches) {
      SphereCell cell = out_.cells[k];
      cell.next = -1;
      if (!set_start(k, t, false, cell)) continue;
      if (out_.cells[k].owner < 0) {
        out_.cells[k] = cell;
        continue;
      }
      out_.cells[last].next = static_cast<std::int32_t>(out_.cells.size());
      last = out_.cells.size();
      out_.cells.push_back(cell);
    }
    for (const Touch& t : touches)
      out_.candidates.push_back({t.patch, static_cast<float>(t.at.x), static_cast<float>(t.at.y)});
    out_.candidates.push_back({-1, 0.0f, 0.0f});
  }

  const std::vector<Net>& nets_;
  SpherePatches& out_;
  int side_;
  std::vector<Draft> drafts_;
  std::vector<Box> boxes_;  // of the nets
};

}  // namespace

void fill_sphere_cells(const std::vector<Net>& nets, SpherePatches& out) { Grid(nets, out).fill(); }

}  // namespace rondure
