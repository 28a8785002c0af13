#include "renderer/complex/validate.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "renderer/bezier/index.h"

namespace rondure {
namespace {

using glm::dmat2;
using glm::dvec2;

constexpr double pi = 3.14159265358979323846;
constexpr double rounding = 1e-9;

using ExactMap = std::array<std::array<Exact, 2>, 2>;  // entry[row][column]

ExactMap product(const ExactMap& a, const ExactMap& b) {
  ExactMap c;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j];
  }
  return c;
}

ExactMap inverse(const ExactMap& a) {
  const Exact d = a[0][0] * a[1][1] - a[0][1] * a[1][0];
  return {{{a[1][1] / d, -a[0][1] / d}, {-a[1][0] / d, a[0][0] / d}}};
}

// The columns are the frame's vectors.
ExactMap frame_of(const SurfaceComplex& complex, const EdgeRef& e) {
  const auto f = edge_frame(complex.sides[index(e.polygon)], e.edge);
  return {{{Exact(f[0][0]), Exact(f[1][0])}, {Exact(f[0][1]), Exact(f[1][1])}}};
}

class Validator {
 public:
  explicit Validator(const SurfaceComplex& complex) : complex_(complex) {}

  std::vector<Violation> run() {
    polygons();
    if (found_.empty()) relation();
    if (!found_.empty()) return found_;
    for (const EdgeJoin& join : complex_.joins) parameter(join);
    if (!found_.empty()) return found_;
    for (const EdgeJoin& join : complex_.joins) bundle(join);
    if (!found_.empty()) return found_;
    for (const VertexFan& fan : vertex_fans(complex_)) vertex(fan);
    return found_;
  }

 private:
  const SurfaceComplex& complex_;
  std::vector<Violation> found_;

  void add(const char* condition, std::string where, std::string what, double amount) {
    found_.push_back({condition, std::move(where), std::move(what), amount});
  }

  static std::string place(const EdgeJoin& join) {
    return fmt::format("{}, glued to {}", name_of(join.p), name_of(join.q));
  }

  void polygons() {
    if (complex_.sides.empty()) add("1", "the complex", "there are no polygons", 0.0);
    for (std::size_t k = 0; k < complex_.sides.size(); ++k) {
      const int sides = complex_.sides[k];
      if (sides == 3 || sides == 4) continue;
      add("1", fmt::format("polygon {}", k), fmt::format("it has {} sides, not 3 or 4", sides), sides);
    }
  }

  void relation() {
    std::vector<std::vector<int>> count;
    for (const int sides : complex_.sides) count.emplace_back(index(sides), 0);
    for (const EdgeJoin& join : complex_.joins) {
      for (const EdgeRef& e : {join.p, join.q}) {
        const bool polygon = e.polygon >= 0 && index(e.polygon) < count.size();
        if (!polygon || e.edge < 0 || e.edge >= complex_.sides[index(e.polygon)]) {
          add("2", name_of(e), "there is no such edge", 0.0);
          continue;
        }
        if (++count[index(e.polygon)][index(e.edge)] == 2) {
          add("2", name_of(e), join.p == join.q ? "it is glued to itself" : "it is glued more than once",
              2.0);
        }
      }
    }
  }

  // The least value, sampled; only for messages.
  static double least(const EdgeFunction& f) {
    double low = INFINITY;
    for (int k = 0; k <= 64; ++k) low = std::fmin(low, f.at(k / 64.0));
    return low;
  }
  static double largest(const EdgeFunction& f) {
    double high = 0.0;
    for (int k = 0; k <= 64; ++k) high = std::fmax(high, std::abs(f.at(k / 64.0)));
    return high;
  }

  // Where a function with a denominator that has no zero is not above 0.
  static std::optional<Exact> not_above_zero(const EdgeFunction& f) {
    return not_positive(f.numerator * f.denominator);
  }

  // A denominator must not vanish, for the function to be continuous.
  bool continuous(const char* condition, const EdgeJoin& join, const EdgeFunction& f, const char* name) {
    const auto at = not_positive(f.denominator * f.denominator);
    if (at) {
      add(condition, place(join), fmt::format("{} has a pole at s = {:.6g}", name, rounded(*at)), 0.0);
    }
    return !at;
  }

  void parameter(const EdgeJoin& join) {
    const EdgeFunction& mu = join.parameter;
    if (!continuous("3", join, mu, "the map of parameters")) return;
    const Exact from = mu.at(Exact(0)), to = mu.at(Exact(1));
    if (!((from == 0 && to == 1) || (from == 1 && to == 0))) {
      const double a = rounded(from), b = rounded(to);
      const double off = std::fmin(std::hypot(a, b - 1), std::hypot(a - 1, b));
      add("3", place(join), fmt::format("the map of parameters takes the ends 0, 1 to {:.6g}, {:.6g}", a, b),
          off);
      return;
    }
    const EdgeFunction slope = derivative(mu) * EdgeFunction(from == 0 ? 1 : -1);
    if (const auto at = not_above_zero(slope)) {
      add("3", place(join),
          fmt::format("the map of parameters is no diffeomorphism: its derivative vanishes or changes sign "
                      "near s = {:.6g}",
                      rounded(*at)),
          rounded(slope.at(*at)));
    }
  }

  bool negligible(const EdgeFunction& f) const {
    return f.zero() || (!complex_.exact && largest(f) <= rounding);
  }

  void bundle(const EdgeJoin& join) {
    static constexpr const char* names[2][2] = {{"along to along", "inward to along"},
                                                {"along to inward", "inward to inward"}};
    bool good = true;
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < 2; ++j) {
        good = continuous("4", join, join.bundle[i][j], names[i][j]) && good;
      }
    }
    if (!good) return;
    const auto& b = join.bundle;
    const EdgeFunction off_edge = b[1][0], off_speed = b[0][0] - derivative(join.parameter);
    if (!negligible(off_edge)) {
      add("4a", place(join), "vectors along the edge are not taken to such vectors", largest(off_edge));
    }
    if (!negligible(off_speed)) {
      add("4a", place(join), "along the edge the map of vectors is not the derivative of that of parameters",
          largest(off_speed));
    }
    const EdgeFunction across = EdgeFunction(-1) * b[1][1];
    const auto at = not_above_zero(across);
    if (!at) return;
    const double value = rounded(b[1][1].at(*at));
    if (*at == 0 || *at == 1) {
      const EdgeRef& e = join.p;
      const int corner = (e.edge + (*at == 1 ? 1 : 0)) % complex_.sides[index(e.polygon)];
      add("4c", fmt::format("corner {} of polygon {} ({})", corner, e.polygon, place(join)),
          fmt::format("the two corners meet in more than a half-line: inward is taken to {:.6g} inward, "
                      "where it must be negative",
                      value),
          value);
    }
    // The sign inside the edge, which may fail as well.
    const double worst = -least(across);
    if ((*at != 0 && *at != 1) || worst > 0.0) {
      add("4b", place(join),
          fmt::format("inward is taken to {:.6g} inward, where it must be negative, so that the sides "
                      "overlap",
                      std::fmax(worst, value)),
          std::fmax(worst, value));
    }
  }

  // The map of one step, between the planes of the two polygons.
  ExactMap step_map(const FanStep& step, const Corner& from) const {
    const EdgeJoin& join = complex_.joins[index(step.join)];
    const EdgeRef& here = step.forwards ? join.p : join.q;
    bool start = here.edge == from.corner;
    if (!step.forwards && join.parameter.at(Exact(0)) != 0) start = !start;
    const Exact s = start ? 0 : 1;
    ExactMap m;
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < 2; ++j) m[i][j] = join.bundle[i][j].at(s);
    }
    const ExactMap map = product(frame_of(complex_, join.q), product(m, inverse(frame_of(complex_, join.p))));
    return step.forwards ? map : inverse(map);
  }

  // The corner's angle after `back`, which takes its plane to that of the first corner.
  double angle(const Corner& c, const ExactMap& back) const {
    const int sides = complex_.sides[index(c.polygon)];
    const auto f = edge_frame(sides, c.corner);
    const dmat2 m(rounded(back[0][0]), rounded(back[1][0]), rounded(back[0][1]), rounded(back[1][1]));
    const dvec2 a = m * dvec2(f[0][0], f[0][1]), b = m * dvec2(f[1][0], f[1][1]);
    return std::abs(std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b)));
  }

  void vertex(const VertexFan& fan) {
    const Corner& first = fan.corners.front();
    const std::string where = fmt::format("the vertex at corner {} of polygon {}, where {} corners meet",
                                          first.corner, first.polygon, fan.corners.size());
    ExactMap back = {{{1, 0}, {0, 1}}};
    double sum = 0.0;
    for (std::size_t k = 0; k < fan.corners.size(); ++k) {
      sum += angle(fan.corners[k], back);
      if (k < fan.steps.size()) back = product(back, inverse(step_map(fan.steps[k], fan.corners[k])));
    }
    const double turns = sum / (2.0 * pi);
    if (!fan.closed) {
      if (turns >= 1.0 - rounding) {
        add("5a", where, fmt::format("the corners of this open fan fill {:.6g} turns", turns), turns - 1.0);
      }
      return;
    }
    double off = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < 2; ++j) {
        const Exact d = back[i][j] - (i == j ? 1 : 0);
        off = std::fmax(off, std::abs(rounded(d)));
      }
    }
    if (off > (complex_.exact ? 0.0 : rounding)) {
      add("5b", where, fmt::format("once round is not the identity: an entry is off by {:.6g}", off), off);
    } else if (std::abs(turns - 1.0) > rounding) {
      add("5b", where, fmt::format("the corners go round {:.6g} times, not once", turns),
          std::abs(turns - 1.0));
    }
  }
};

}  // namespace

std::vector<Violation> violations(const SurfaceComplex& complex) { return Validator(complex).run(); }

std::string text_of(const Violation& v) {
  return fmt::format("({}) at {}: {}", v.condition, v.where, v.what);
}

}  // namespace rondure
