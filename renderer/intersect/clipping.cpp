#include "renderer/intersect/clipping.h"

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "renderer/intersect/fold.h"
#include "renderer/intersect/newton_step.h"
#include "renderer/intersect/parameter_clip.h"
#include "renderer/intersect/strong_direction.h"

namespace rondure {
namespace {

constexpr int depth_limit = 112;  // 53 halvings of each parameter, and a few clips
// A tangential ray takes tens; a net that takes this many is broken.
constexpr std::size_t cell_limit = 1 << 14;
constexpr double contraction = 0.3;  // below 1/3, full Newton steps converge from anywhere in the cell
constexpr double point_size = 16.0;  // times the rounding error: what is so small is one candidate

enum class Outcome { finished, divide };

template <class Shape>
struct Frame {
  typename Shape::Cell cell;
  int depth = 0;
};

// Scratch memory that a thread keeps, so that a search allocates nothing once it is warm.
struct Workspace {
  std::vector<dvec2> stack, turned, first[2], second;
};

template <class Shape>
class Search {
 public:
  Search(const Shape& shape, const dvec2* patch, double error, std::vector<Root>& roots, SearchCounts& counts)
      : shape_(shape),
        size_(static_cast<std::size_t>(shape.size())),
        patch_(patch),
        error_(error),
        roots_(roots),
        counts_(counts) {
    static thread_local Workspace workspace;
    work_ = &workspace;
    work_->stack.resize(size_ * (depth_limit + 3));
    for (auto* v : {&work_->turned, &work_->first[0], &work_->first[1], &work_->second}) v->resize(size_);
  }

  void run(const typename Shape::Cell& start) {
    Frame<Shape> frames[depth_limit + 2];
    frames[0].cell = start;
    shape_.restrict_to(patch_, start, net(0));
    std::size_t visited = 0;
    for (int level = 0; level >= 0;) {
      Frame<Shape>& frame = frames[level];
      if (++visited > cell_limit || counts_.cells + visited > counts_.limit) {
        ++counts_.exhausted;
        break;
      }
      dvec2* f = net(level);
      const bool deepest = frame.depth >= depth_limit;
      if (examine(f, frame) == Outcome::finished || deepest) {
        if (deepest) keep(Shape::to_patch(frame.cell, Shape::center()), true);
        --level;
        continue;
      }
      if constexpr (std::is_same_v<Shape, TensorShape>)
        if (clip(level, frame)) continue;
      halve(level, frames);
      ++level;
    }
    counts_.cells += visited;
  }

 private:
  const Shape shape_;
  const std::size_t size_;
  const dvec2* patch_;
  const double error_;
  std::vector<Root>& roots_;
  SearchCounts& counts_;
  Workspace* work_;
  glm::dmat2 inverse_{1.0};  // of the Jacobian at the centre of the cell last examined
  bool invertible_ = false;

  dvec2* net(int level) { return work_->stack.data() + static_cast<std::size_t>(level) * size_; }

  Outcome examine(const dvec2* f, const Frame<Shape>& frame) {
    const typename Shape::Cell& cell = frame.cell;
    const Hull raw = hull_of(f, size_);
    invertible_ = false;
    if (raw.avoids_zero(dvec2(error_))) return Outcome::finished;
    const dvec2 magnitude = raw.magnitude();
    if (std::max(magnitude.x, magnitude.y) <= point_size * error_) {
      keep_point(cell);
      return Outcome::finished;
    }
    const FirstOrder<dvec2> middle = shape_.first(f, Shape::center());
    const glm::dmat2 jacobian(middle.du, middle.dv);
    const double det = glm::determinant(jacobian);
    const double norm2 = glm::dot(middle.du, middle.du) + glm::dot(middle.dv, middle.dv);
    if (std::fabs(det) > 1e-14 * norm2) {
      inverse_ = glm::inverse(jacobian);
      invertible_ = true;
      const dvec2 band = preconditioned_error();
      Hull g;
      for (std::size_t k = 0; k < size_; ++k) g.add(inverse_ * f[k]);
      if (g.avoids_zero(band)) return Outcome::finished;
      if (std::max(band.x, band.y) < 0.1 && is_simple(f)) return solve_simple(f, cell, band);
    }
    return try_fold(f, frame, middle.du, middle.dv);
  }

  dvec2 preconditioned_error() const {
    return error_ * dvec2(std::fabs(inverse_[0].x) + std::fabs(inverse_[1].x),
                          std::fabs(inverse_[0].y) + std::fabs(inverse_[1].y));
  }

  // Whether |inverse . J - I| < contraction in the maximum norm, all over the cell, from the Bernstein
  // coefficients of J.
  bool is_simple(const dvec2* f) {
    dvec2 *da = work_->first[0].data(), *db = work_->first[1].data();
    dvec2 from_a(0.0), from_b(0.0);
    if (shape_.can_derive_a()) {
      shape_.derive_a(f, da);
      for (int k = 0; k < shape_.derived_a().size(); ++k)
        from_a = glm::max(from_a, glm::abs(inverse_ * da[k] - dvec2(1.0, 0.0)));
    }
    if (shape_.can_derive_b()) {
      shape_.derive_b(f, db);
      for (int k = 0; k < shape_.derived_b().size(); ++k)
        from_b = glm::max(from_b, glm::abs(inverse_ * db[k] - dvec2(0.0, 1.0)));
    }
    return std::max(from_a.x + from_b.x, from_a.y + from_b.y) < contraction;
  }

  Outcome solve_simple(const dvec2* f, const typename Shape::Cell& cell, dvec2 band) {
    dvec2 p = Shape::center();
    for (int k = 0;; ++k) {
      // A root of this cell would have been reached: the contraction leaves 10^-16 of the cell after 32 steps
      // at worst.
      if (k == 32) return Outcome::finished;
      const FirstOrder<dvec2> s = shape_.first(f, p);
      const dvec2 step = newton_step(s.value, s.du, s.dv);
      p -= step;
      // A root of this cell would hold every iterate within `contraction` of it.
      if (!(Shape::outside(p) < 1.0)) return Outcome::finished;
      if (std::max(std::fabs(step.x), std::fabs(step.y)) <= std::max(band.x, band.y) + 1e-15) break;
    }
    if (Shape::outside(p) <= 4.0 * std::max(band.x, band.y) + 8.0 * unit_roundoff)
      keep(Shape::to_patch(cell, p), false);
    return Outcome::finished;
  }

  // `du`, `dv`: the derivatives of the pair at the cell's centre.
  Outcome try_fold(const dvec2* f, const Frame<Shape>& frame, dvec2 du, dvec2 dv) {
    const typename Shape::Cell& cell = frame.cell;
    // Turn the two planes about the ray so that the first polynomial takes all of the gradient that one can
    // take.
    const dvec2 strong = strong_direction(du, dv), weak(-strong.y, strong.x);
    dvec2* t = work_->turned.data();
    for (std::size_t k = 0; k < size_; ++k) t[k] = dvec2(glm::dot(strong, f[k]), glm::dot(weak, f[k]));
    const Hull h = hull_of(t, size_);
    if (h.avoids_zero(dvec2(error_))) return Outcome::finished;

    if (!shape_.can_derive_a() || !shape_.can_derive_b()) return Outcome::divide;
    const bool swapped = std::fabs(glm::dot(strong, du)) > std::fabs(glm::dot(strong, dv));
    const DerivativeNets nets{work_->first[0].data(), work_->first[1].data(), work_->second.data()};
    const Slopes slopes = slopes_of(shape_, t, swapped, nets);
    if (slopes.y[0].contains_zero()) return Outcome::divide;
    if (h.magnitude().y <= point_size * error_) {
      // The ray clings to the surface all along the graph. Over a whole leaf it lies inside: no isolated
      // root.
      if (frame.depth == 0 && h.magnitude().y <= error_) return Outcome::finished;
      const auto keep_candidate = [&](dvec2 p) { keep(Shape::to_patch(cell, p), true); };
      const bool any = propose_on_graph(shape_, t, swapped, keep_candidate);
      return any ? Outcome::finished : Outcome::divide;
    }

    const Interval curvature = curvature_of(shape_, slopes, swapped, nets);
    if (curvature.contains_zero() || curvature.magnitude() > 4.0 * curvature.mignitude())
      return Outcome::divide;

    const FoldResult fold = solve_fold(shape_, t, swapped, curvature, error_);
    switch (fold.kind) {
      case FoldResult::Kind::undecided:
        return Outcome::divide;
      case FoldResult::Kind::none:
        return Outcome::finished;
      case FoldResult::Kind::tangent: {
        if (Shape::outside(fold.at[0]) <= fold.tolerance) keep(Shape::to_patch(cell, fold.at[0]), true);
        return Outcome::finished;
      }
      case FoldResult::Kind::pair:
        break;
    }
    keep_pair(cell, fold);
    return Outcome::finished;
  }

  // Roots of a pair that lie within the patch count as they are, and each that rounding may have moved out:
  // one that is by far less outside than the other is away, as where the ray runs in the plane of an edge and
  // meets it twice. If neither does, the nearer. But never a root beside its mirror image across a singular
  // corner: that is outside by as much as the root is inside.
  void keep_pair(const typename Shape::Cell& cell, const FoldResult& fold) {
    dvec2 at[2];
    double outside[2];
    bool here[2];
    for (int k = 0; k < 2; ++k) {
      at[k] = Shape::to_patch(cell, fold.at[k]);
      outside[k] = Shape::outside(at[k]);
      here[k] = Shape::outside(fold.at[k]) <= fold.tolerance;
    }
    constexpr double beside = 1.0 / 16.0;
    const double apart = glm::length(at[1] - at[0]);
    bool any = false;
    for (int k = 0; k < 2; ++k) {
      if (!here[k] || !(outside[k] <= beside * apart)) continue;
      keep(at[k], fold.narrow);
      any = true;
    }
    if (any) return;
    const int nearer = here[0] && (!here[1] || outside[0] <= outside[1]) ? 0 : 1;
    if (here[nearer]) keep(at[nearer], fold.narrow);
  }

  // A cell that is a point in space may still be wide in the parameters, at a collapsed edge: a few starts
  // for `settle`, since which of the edge's parameters leads to the ray is more than rounding can tell here.
  void keep_point(const typename Shape::Cell& cell) {
    const dvec2 middle = Shape::center();
    keep(Shape::to_patch(cell, middle), true);
    for (const dvec2 p :
         {dvec2(0.125, middle.y), dvec2(0.875, middle.y), dvec2(middle.x, 0.125), dvec2(middle.x, 0.875)}) {
      if (Shape::outside(p) > 0.0) continue;
      const dvec2 far = Shape::to_patch(cell, p) - Shape::to_patch(cell, middle);
      if (std::max(std::fabs(far.x), std::fabs(far.y)) > 1e-3) keep(Shape::to_patch(cell, p), true);
    }
  }

  // Sharpens a root on the patch's own net, whose coefficients have not been through any subdivision, and
  // checks it there.
  void keep(dvec2 p, bool tangent) {
    FirstOrder<dvec2> s = shape_.first(patch_, p);
    if (!tangent) {
      const dvec2 step = newton_step(s.value, s.du, s.dv);
      if (std::max(std::fabs(step.x), std::fabs(step.y)) < 1e-6) {
        p -= step;
        s = shape_.first(patch_, p);
      }
    }
    const auto size = [](dvec2 x) { return std::max(std::fabs(x.x), std::fabs(x.y)); };
    const double residual = size(s.value);
    // Half an ulp of each parameter moves the point by this much, on a steep patch by more than its rounding.
    const double resolution = unit_roundoff * (size(s.du) + size(s.dv));
    // A root that is sure to be near is kept: where the ray grazes, Newton's steps along it may leave more of
    // the residual than rounding does.
    if (!tangent || residual <= point_size * error_ + resolution)
      roots_.push_back({p.x, p.y, tangent || residual > 0.25 * error_});
  }

  void halve(int level, Frame<Shape>* frames) {
    dvec2* f = net(level);
    const int edge = shape_.steepest_edge(f, work_->first[0].data(), work_->first[1].data());
    Frame<Shape> low, high;
    low.depth = high.depth = frames[level].depth + 1;
    dvec2* scratch = work_->turned.data();
    shape_.halve(f, frames[level].cell, edge, scratch, net(level + 1), low.cell, high.cell);
    std::copy(scratch, scratch + size_, f);
    frames[level] = low;
    frames[level + 1] = high;
  }

  // In a sliver the gradient across it is less than rounding, and folds along it are not seen: neither side
  // is cut to less than this part of the other.
  static void keep_broad(const dvec2& size, dvec2& from, dvec2& to) {
    constexpr double least = 0x1p-20;
    const dvec2 kept = size * (to - from);
    for (int k = 0; k < 2; ++k) {
      const double more = least * kept[1 - k] - kept[k];
      if (!(more > 0.0)) continue;
      from[k] = std::fmax(from[k] - 0.5 * more / size[k], 0.0);
      to[k] = std::fmin(to[k] + 0.5 * more / size[k], 1.0);
    }
  }

  // Shrinks the cell to where roots can be. True when the frame was finished or shrunk enough to look again.
  bool clip(int& level, Frame<Shape>& frame) {
    if (!invertible_ || shape_.m == 0 || shape_.n == 0) return false;
    dvec2* f = net(level);
    const dvec2 band = preconditioned_error();
    dvec2 from, to;
    for (int k = 0; k < 2; ++k) {
      if (!clip_parameter(shape_, f, inverse_, k, band[k], from[k], to[k])) {
        --level;
        return true;
      }
    }
    // Room for the rounding of the crossings themselves.
    from = glm::max(from - 1e-12, dvec2(0.0)), to = glm::min(to + 1e-12, dvec2(1.0));
    keep_broad(frame.cell.high - frame.cell.low, from, to);
    const dvec2 kept = to - from;
    if (kept.x * kept.y > 0.5 || frame.depth + 1 >= depth_limit) return false;
    tensor_restrict(f, shape_.m, shape_.n, from.x, to.x, from.y, to.y, f);
    frame.cell = {Shape::to_patch(frame.cell, from), Shape::to_patch(frame.cell, to)};
    ++frame.depth;
    return true;
  }
};

}  // namespace

void find_roots(const TensorShape& shape, const dvec2* f, const RectangleCell& cell, double error,
                std::vector<Root>& roots, SearchCounts& counts) noexcept {
  Search<TensorShape>(shape, f, error, roots, counts).run(cell);
}

void find_roots(const TriangleShape& shape, const dvec2* f, const TriangleCell& cell, double error,
                std::vector<Root>& roots, SearchCounts& counts) noexcept {
  Search<TriangleShape>(shape, f, error, roots, counts).run(cell);
}

}  // namespace rondure
