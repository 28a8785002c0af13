#include "renderer/projective/positive_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "renderer/bezier/product.h"
#include "renderer/projective/orientation.h"

namespace rondure {
namespace {

constexpr std::size_t variables = most_ratios + most_turns;
constexpr double pi = std::numbers::pi;

// Less is as good as zero, and told from it no more.
constexpr double least_weight = 1e-6;
// Limits on boxes: in the range of all ratios, in a smaller one, after the first find; and on finds that are
// not regular.
constexpr std::size_t most_boxes = 40000, near_boxes = 3000, more_boxes = 400, most_irregular = 64;

// Re(c exp(i sum of turns turn)) * product of ratio^power
struct Term {
  Complex c;
  std::array<double, variables> power;  // of ratios, then of phases
  double size = 0, phase = 0;           // of c, when the weight is complete
};

struct Weight {
  std::vector<Term> terms;

  Weight() = default;
  explicit Weight(int /* the sum of nothing */) {}
  Weight& operator+=(const Weight& other) {
    for (const Term& t : other.terms) {
      const auto same =
          std::find_if(terms.begin(), terms.end(), [&](const Term& mine) { return mine.power == t.power; });
      if (same == terms.end())
        terms.push_back(t);
      else
        same->c += t.c;
    }
    return *this;
  }
  Weight& operator/=(double divisor) {
    for (Term& t : terms) t.c /= static_cast<long double>(divisor);
    return *this;
  }
};

// The scalar product of two points, as a function of the shape. exp(-ix) is written as a conjugate.
Weight product(const ShapedPoint& p, const ShapedPoint& q) {
  Weight sum;
  for (const ShapedTerm& s : p.terms) {
    for (const ShapedTerm& t : q.terms) {
      Weight one;
      Term term{std::conj(s.coefficient.a) * t.coefficient.a + std::conj(s.coefficient.b) * t.coefficient.b,
                {}};
      for (std::size_t k = 0; k < most_ratios; ++k) term.power[k] = s.power[k] + t.power[k];
      double sign = 0;
      for (std::size_t k = 0; k < most_turns; ++k) {
        const double turn = t.turns[k] - s.turns[k];
        if (sign == 0 && turn != 0) sign = std::copysign(1.0, turn);
        term.power[most_ratios + k] = sign < 0 ? -turn : turn;
      }
      if (sign < 0) term.c = std::conj(term.c);
      one.terms.push_back(term);
      sum += one;
    }
  }
  return sum;
}

// Powers of the corners' weights, which have one term each.
struct Corner {
  double share;  // of this corner at a place
  const Weight* weight;
};

void divide_by_corners(Weight& weight, std::initializer_list<Corner> corners) {
  for (Term& t : weight.terms) {
    for (const Corner& corner : corners) {
      const Term& by = corner.weight->terms[0];
      t.c /= std::pow(std::abs(by.c), static_cast<long double>(corner.share));
      for (std::size_t k = 0; k < most_ratios; ++k) t.power[k] -= corner.share * by.power[k];
    }
    t.size = static_cast<double>(std::abs(t.c));
    t.phase = static_cast<double>(std::arg(t.c));
  }
}

// The weights of the image but the corners', each in units of the corners' geometric mean for its place:
// projective maps of the parameters do not change them.
std::vector<Weight> weights_of(const TensorPolynomial<ShapedPoint>& net) {
  const auto w = multiply(net, net, product);
  std::vector<Weight> list;
  for (int i = 0; i <= w.m; ++i) {
    for (int j = 0; j <= w.n; ++j) {
      if (i % w.m == 0 && j % w.n == 0) continue;
      const double u = static_cast<double>(i) / w.m, v = static_cast<double>(j) / w.n;
      list.push_back(w.at(i, j));
      divide_by_corners(list.back(), {{(1 - u) * (1 - v), &w.at(0, 0)},
                                      {u * (1 - v), &w.at(w.m, 0)},
                                      {u * v, &w.at(w.m, w.n)},
                                      {(1 - u) * v, &w.at(0, w.n)}});
    }
  }
  return list;
}

std::vector<Weight> weights_of(const TrianglePolynomial<ShapedPoint>& net) {
  const auto w = multiply(net, net, product);
  std::vector<Weight> list;
  for (int i = 0; i <= w.n; ++i) {
    for (int j = 0; j <= w.n - i; ++j) {
      if (i == w.n || j == w.n || i + j == 0) continue;
      const double u = static_cast<double>(i) / w.n, v = static_cast<double>(j) / w.n;
      list.push_back(w.at(i, j));
      divide_by_corners(list.back(), {{u, &w.at(w.n, 0)}, {v, &w.at(0, w.n)}, {1 - u - v, &w.at(0, 0)}});
    }
  }
  return list;
}

struct Interval {
  double low, high;

  double size() const { return std::max(std::abs(low), std::abs(high)); }
};

Interval cosine(double low, double high) {
  const double a = std::cos(low), b = std::cos(high);
  const auto passes = [&](double at) { return std::floor((high - at) / (2 * pi)) >= (low - at) / (2 * pi); };
  return {passes(pi) ? -1.0 : std::min(a, b), passes(0) ? 1.0 : std::max(a, b)};
}

// A factor that is not negative times one of any sign.
Interval times(const Interval& size, const Interval& b) {
  return {b.low * (b.low < 0 ? size.high : size.low), b.high * (b.high > 0 ? size.high : size.low)};
}

// Logarithms of ratios, then phases.
struct Box {
  std::array<double, variables> low, high;
  double most;  // no shape in it has a greater least weight

  double middle(std::size_t k) const { return 0.5 * (low[k] + high[k]); }
  bool operator<(const Box& other) const { return most < other.most; }
};

double value_at(const Weight& weight, const std::array<double, variables>& x) {
  double sum = 0;
  for (const Term& t : weight.terms) {
    double log = 0, phase = t.phase;
    for (std::size_t k = 0; k < variables; ++k) (k < most_ratios ? log : phase) += t.power[k] * x[k];
    sum += t.size * std::exp(log) * std::cos(phase);
  }
  return sum;
}

std::array<double, variables> middle_of(const Box& box) {
  std::array<double, variables> x{};
  for (std::size_t k = 0; k < variables; ++k) x[k] = box.middle(k);
  return x;
}

// An upper bound: the sum of the terms' bounds, or by the mean value theorem, which is better on small boxes.
double bound(const Weight& weight, const Box& box) {
  double sum = 0;
  std::array<Interval, variables> slope{};
  for (const Term& t : weight.terms) {
    Interval log{0, 0}, phase{t.phase, t.phase};
    for (std::size_t k = 0; k < variables; ++k) {
      Interval& part = k < most_ratios ? log : phase;
      const double a = t.power[k] * box.low[k], b = t.power[k] * box.high[k];
      part.low += std::min(a, b), part.high += std::max(a, b);
    }
    const Interval amplitude{t.size * std::exp(log.low), t.size * std::exp(log.high)};
    const Interval value = times(amplitude, cosine(phase.low, phase.high));
    const Interval turned = times(amplitude, cosine(phase.low + pi / 2, phase.high + pi / 2));
    sum += value.high;
    for (std::size_t k = 0; k < variables; ++k) {
      const Interval& by = k < most_ratios ? value : turned;
      const double a = t.power[k] * by.low, b = t.power[k] * by.high;
      slope[k].low += std::min(a, b), slope[k].high += std::max(a, b);
    }
  }
  double mean = value_at(weight, middle_of(box));
  for (std::size_t k = 0; k < variables; ++k) mean += 0.5 * (box.high[k] - box.low[k]) * slope[k].size();
  return std::min(sum, mean);
}

Shape shape_at(const std::array<double, variables>& x) {
  Shape shape;
  for (std::size_t k = 0; k < most_ratios; ++k) shape.ratio[k] = std::exp(x[k]);
  for (std::size_t k = 0; k < most_turns; ++k) shape.turn[k] = x[most_ratios + k];
  return shape;
}

class ShapeSearch {
 public:
  explicit ShapeSearch(const PreimageFamily& family)
      : family_(family), weights_(std::visit([](const auto& net) { return weights_of(net); }, family.net)) {}

  // All ratios decide whether there is a shape; then one is preferred whose ratios are near 1, as far from it
  // lines crowd.
  PositiveShape run() {
    const PositiveShape any = search(std::log(widest_ratio), most_boxes);
    if (any.outcome != PositiveShape::Outcome::found || family_.ratios == 0) return any;
    std::size_t boxes = any.boxes;
    for (double widest = 2; widest < widest_ratio; widest *= 2) {
      PositiveShape near = search(std::log(widest), near_boxes);
      near.boxes = boxes += near.boxes;
      if (near.outcome == PositiveShape::Outcome::found) return near;
    }
    return any;
  }

 private:
  const PreimageFamily& family_;
  std::vector<Weight> weights_;
  std::priority_queue<Box> boxes_;
  std::size_t limit_ = 0, irregular_ = 0;
  bool dropped_ = false;  // a box that is too small to divide
  PositiveShape result_;

  // `widest`: the logarithm of the most extreme ratio.
  PositiveShape search(double widest, std::size_t limit) {
    boxes_ = {};
    dropped_ = false;
    irregular_ = 0;
    limit_ = limit;
    result_ = {};
    Box all{};
    for (std::size_t k = 0; k < family_.ratios; ++k) all.low[k] = -widest, all.high[k] = widest;
    for (std::size_t k = 0; k < family_.turns; ++k)
      all.low[most_ratios + k] = -1.5 * pi, all.high[most_ratios + k] = 1.5 * pi;
    push(all);
    while (!boxes_.empty() && result_.boxes < limit_ && irregular_ < most_irregular) {
      const Box box = boxes_.top();
      if (result_.least >= 0.5 * box.most) break;
      boxes_.pop();
      ++result_.boxes;
      look_at(middle_of(box));
      divide(box);
    }
    if (result_.outcome != PositiveShape::Outcome::found && (!boxes_.empty() || dropped_))
      result_.outcome = PositiveShape::Outcome::undecided;
    return result_;
  }

  void push(Box box) {
    for (const SidePhase& side : family_.sides) {
      double low = static_cast<double>(side.even), high = low;
      for (std::size_t k = 0; k < most_turns; ++k) {
        const double a = side.turns[k] * box.low[most_ratios + k],
                     b = side.turns[k] * box.high[most_ratios + k];
        low += std::min(a, b), high += std::max(a, b);
      }
      if (low >= pi || high <= -pi) return;
    }
    box.most = INFINITY;
    for (const Weight& weight : weights_) {
      box.most = std::min(box.most, bound(weight, box));
      if (!(box.most > std::max(least_weight, result_.least))) return;
    }
    boxes_.push(box);
  }

  void look_at(const std::array<double, variables>& x) {
    double least = INFINITY;
    for (const Weight& weight : weights_) least = std::min(least, value_at(weight, x));
    if (!(least > std::max(least_weight, result_.least))) return;
    const Shape shape = shape_at(x);
    if (!within_half_turns(family_, shape)) return;
    if (!regularity(preimage_at(family_, shape)).regular) {
      ++irregular_;
      return;
    }
    if (result_.outcome != PositiveShape::Outcome::found)
      limit_ = std::min(limit_, result_.boxes + more_boxes);
    result_.outcome = PositiveShape::Outcome::found;
    result_.shape = shape;
    result_.least = least;
  }

  void divide(const Box& box) {
    std::size_t widest = 0;
    for (std::size_t k = 1; k < variables; ++k) {
      if (box.high[k] - box.low[k] > box.high[widest] - box.low[widest]) widest = k;
    }
    const double width = box.high[widest] - box.low[widest];
    if (!(width > 1e-6)) {
      dropped_ = dropped_ || width > 0;
      return;
    }
    Box half = box;
    half.high[widest] = box.middle(widest);
    push(half);
    half = box;
    half.low[widest] = box.middle(widest);
    push(half);
  }
};

}  // namespace

PositiveShape positive_shape(const PreimageFamily& family) { return ShapeSearch(family).run(); }

}  // namespace rondure
