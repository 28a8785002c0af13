#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <stdexcept>

#include "renderer/bezier/tube.h"
#include "renderer/bezier/tube_section.h"

namespace rondure {
namespace {

// A curve of degree n lies on a plane, a line or a circle when 2 n + 1 of its points do.
std::vector<dvec3> samples_of(const RationalCurve& curve) {
  const int count = 8 * static_cast<int>(curve.size());
  std::vector<dvec3> points;
  for (int k = 0; k <= count; ++k) points.push_back(curve_point(curve, static_cast<double>(k) / count));
  return points;
}

double extent_of(const std::vector<dvec3>& points) {
  double extent = 0.0;
  for (const dvec3& p : points) extent = std::max(extent, glm::distance(p, points.front()));
  return extent;
}

// Whether the curve runs along its chord, without turning back.
bool is_straight(const std::vector<dvec3>& points, double tolerance) {
  const double length = glm::distance(points.front(), points.back());
  if (!(length > tolerance)) return false;
  const dvec3 along = (points.back() - points.front()) / length;
  double reached = 0.0;
  for (const dvec3& p : points) {
    const dvec3 way = p - points.front();
    if (!(glm::length(glm::cross(along, way)) <= tolerance)) return false;
    if (!(glm::dot(along, way) >= reached - tolerance)) return false;
    reached = glm::dot(along, way);
  }
  return true;
}

// A curve that is known to lie on a circle.
struct OnCircle {
  const RationalCurve& curve;
  const dvec3 centre, axis;

  dvec3 out(double t) const { return curve_point(curve, t) - centre; }
  // Between two directions less than half a turn apart.
  double turn(const dvec3& from, const dvec3& to) const {
    return std::atan2(glm::dot(axis, glm::cross(from, to)), glm::dot(from, to));
  }
  // How far the curve turns in one sense; NaN where it turns back. Where it is fast, the steps are divided.
  double turned(double t0, const dvec3& from, double t1, const dvec3& to, int depth) const {
    const double t = 0.5 * (t0 + t1);
    const dvec3 middle = out(t);
    const double first = turn(from, middle), second = turn(middle, to);
    if (std::max(std::abs(first), std::abs(second)) < 0.5 || depth > 40)
      return first >= -1e-9 && second >= -1e-9 ? first + second : NAN;
    return turned(t0, from, t, middle, depth + 1) + turned(t, middle, t1, to, depth + 1);
  }
};

// The circular arc that the curve runs along in one sense, if it does.
std::optional<CircleArc> circle_of(const RationalCurve& curve, const std::vector<dvec3>& points,
                                   double tolerance) {
  const dvec3 &p = points.front(), &q = points[points.size() / 3], &r = points[2 * points.size() / 3];
  const dvec3 a = q - p, b = r - p, normal = glm::cross(a, b);
  const double area2 = glm::dot(normal, normal);
  if (!(area2 > 1e-12 * glm::dot(a, a) * glm::dot(b, b))) return std::nullopt;
  const dvec3 centre =
      p + (glm::dot(b, b) * glm::cross(normal, a) - glm::dot(a, a) * glm::cross(normal, b)) / (2.0 * area2);
  const OnCircle circle{curve, centre, glm::normalize(normal)};
  const double size = glm::distance(p, centre);
  double angle = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const dvec3 now = points[k] - centre;
    if (!(std::abs(glm::length(now) - size) <= tolerance)) return std::nullopt;
    if (!(std::abs(glm::dot(circle.axis, now)) <= tolerance)) return std::nullopt;
    const double step = 1.0 / static_cast<double>(points.size() - 1), t = static_cast<double>(k) * step;
    if (k > 0) angle += circle.turned(t - step, points[k - 1] - centre, t, now, 0);
  }
  constexpr double whole = 6.28318530717958647693;
  if (!(angle > 0.0 && angle <= whole + 1e-9)) return std::nullopt;
  return CircleArc{centre, p - centre, glm::cross(circle.axis, p - centre), std::min(angle, whole)};
}

// The curve at one parameter, and how a frame that does not turn about the tangent changes there.
struct Section {
  double t;
  CurveJet jet;
  dvec3 tangent, bend;  // bend: derivative of the tangent
};

Section section_at(const RationalCurve& curve, double t) {
  Section s{t, curve_jet(curve, t), dvec3(0.0), dvec3(0.0)};
  const double speed = glm::length(s.jet.first);
  if (!(speed > 0.0)) return s;
  s.tangent = s.jet.first / speed;
  s.bend = (s.jet.second - glm::dot(s.tangent, s.jet.second) * s.tangent) / speed;
  return s;
}

// The normal carried along by two reflections (Wang, Juettler, Zheng and Liu 2008): hardly any turn about the
// tangent.
dvec3 carried(const dvec3& normal, const Section& from, const Section& to) {
  const auto reflect = [](const dvec3& x, const dvec3& v) {
    const double size = glm::dot(v, v);
    return size > 0.0 ? x - 2.0 * glm::dot(v, x) / size * v : x;
  };
  const dvec3 chord = to.jet.point - from.jet.point;
  const dvec3 turned = reflect(reflect(normal, chord), to.tangent - reflect(from.tangent, chord));
  return glm::normalize(turned - glm::dot(turned, to.tangent) * to.tangent);
}

// Control points of the cubic with these end values and derivatives.
struct Cubic {
  dvec3 c[4];

  Cubic(const dvec3& a, const dvec3& da, const dvec3& b, const dvec3& db, double h)
      : c{a, a + h / 3.0 * da, b - h / 3.0 * db, b} {}
  dvec3 at(double s) const {
    const double r = 1.0 - s;
    return r * r * (r * c[0] + 3.0 * s * c[1]) + s * s * (3.0 * r * c[2] + s * c[3]);
  }
};

// The skin between two sections: centre + x normal + y binormal for (x, y) on a circle, each a cubic.
struct Span {
  Cubic centre, normal, binormal;

  Span(const Section& from, const dvec3& n0, const Section& to, const dvec3& n1)
      : centre(from.jet.point, from.jet.first, to.jet.point, to.jet.first, to.t - from.t),
        normal(cubic(from, n0, to, n1)),
        binormal(cubic(from, glm::cross(from.tangent, n0), to, glm::cross(to.tangent, n1))) {}

 private:
  static Cubic cubic(const Section& from, const dvec3& n0, const Section& to, const dvec3& n1) {
    return Cubic(n0, -glm::dot(n0, from.bend) * from.tangent, n1, -glm::dot(n1, to.bend) * to.tangent,
                 to.t - from.t);
  }
};

class TubeMaker {
 public:
  TubeMaker(const RationalCurve& curve, double radius) : curve_(curve), radius_(radius) {}

  CurveTube make() {
    sections_.push_back(section_at(curve_, 0.0));
    divide(sections_.front(), section_at(curve_, 1.0));
    // Runs between cusps, each with one frame that is carried from section to section.
    dvec3 normal(0.0);
    for (std::size_t k = 0; k + 1 < sections_.size(); ++k) {
      const Section &from = sections_[k], &to = sections_[k + 1];
      if (std::find(skipped_.begin(), skipped_.end(), k) != skipped_.end()) {
        tube_.cusps.push_back(0.5 * (from.jet.point + to.jet.point));
        normal = dvec3(0.0);
        continue;
      }
      if (normal == dvec3(0.0)) normal = detail::across(from.tangent);
      const dvec3 next = carried(normal, from, to);
      add(Span(from, normal, to, next));
      if (k == 0) tube_.start = from.tangent;
      if (k + 2 == sections_.size()) tube_.end = to.tangent;
      normal = next;
    }
    return std::move(tube_);
  }

 private:
  const RationalCurve& curve_;
  const double radius_;
  CurveTube tube_;
  std::vector<Section> sections_;
  std::vector<std::size_t> skipped_;  // sections after which there is no skin

  void divide(const Section& from, const Section& to) {
    constexpr std::size_t most_sections = 50000;
    constexpr double shortest = 0x1p-40, longest_cusp = 1.0 / 16;  // of the parameter's interval
    if (sections_.size() > most_sections || to.t - from.t < shortest)
      throw std::invalid_argument(
          "the curve winds too much, or its weights differ too much, for so thin a tube");
    const Section middle = section_at(curve_, 0.5 * (from.t + to.t));
    const double length =
        glm::distance(from.jet.point, middle.jet.point) + glm::distance(middle.jet.point, to.jet.point);
    // Not of a long piece: a curve may return to where it was.
    const bool small = to.t - from.t <= longest_cusp && !(length > tube_accuracy * radius_);
    if (small || error(from, middle, to) <= 0.8 * tube_accuracy) {
      if (small && !(error(from, middle, to) <= tube_accuracy)) skipped_.push_back(sections_.size() - 1);
      sections_.push_back(to);
      return;
    }
    divide(from, middle);
    divide(middle, to);
  }

  // The greatest distance from the true offset, relative to the radius, at a few points where the cubics are
  // furthest off; infinite where a tangent is missing or turns by a right angle.
  double error(const Section& from, const Section& middle, const Section& to) const {
    if (!(glm::dot(from.tangent, middle.tangent) > 0.1) || !(glm::dot(middle.tangent, to.tangent) > 0.1))
      return INFINITY;
    const dvec3 normal = detail::across(from.tangent);
    const Span span(from, normal, to, carried(normal, from, to));
    double worst = 0.0;
    for (const double s : {0.25, 0.5, 0.75}) {
      const Section at = s == 0.5 ? middle : section_at(curve_, from.t + s * (to.t - from.t));
      const dvec3 centre = span.centre.at(s), n = span.normal.at(s), b = span.binormal.at(s);
      for (const dvec3& off : {n, b, -n, -b}) {
        const dvec3 way = centre + radius_ * off - at.jet.point;
        const dvec3 across = way - glm::dot(way, at.tangent) * at.tangent;
        worst = std::max(worst, glm::length(way - radius_ * glm::normalize(across)));
      }
    }
    return std::isfinite(worst) ? worst / radius_ : INFINITY;
  }

  void add(const Span& span) {
    for (const detail::Third& third : detail::unit_circle()) {
      TensorNet net(2, 3);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 4; ++j) {
          const dvec2 at = radius_ * third.point[i];
          net.at(i, j) = third.weight[i] *
                         dvec4(span.centre.c[j] + at.x * span.normal.c[j] + at.y * span.binormal.c[j], 1.0);
        }
      }
      tube_.nets.push_back(net);
    }
  }
};

}  // namespace

CurveTube curve_tube(const RationalCurve& curve, double radius) {
  const std::vector<dvec3> points = samples_of(curve);
  const double extent = extent_of(points);
  // Rounding of the points themselves, and no more than is allowed anyway.
  const double tolerance = std::min(1e-11 * extent, 0.1 * tube_accuracy * radius);
  CurveTube tube;
  if (!(extent > 1e-9 * radius)) return tube;
  double largest = 0.0;
  for (const dvec3& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  if (!(radius >= 1e-9 * largest))
    throw std::invalid_argument("the tube is too thin for the size of the curve");
  if (is_straight(points, tolerance)) {
    tube.nets = straight_tube(points.front(), points.back(), radius);
    tube.start = tube.end = glm::normalize(points.back() - points.front());
    return tube;
  }
  if (const std::optional<CircleArc> arc = circle_of(curve, points, tolerance)) {
    tube.nets = circle_tube(*arc, radius);
    tube.start = glm::normalize(arc->b);
    tube.end = glm::normalize(std::cos(arc->angle) * arc->b - std::sin(arc->angle) * arc->a);
    return tube;
  }
  return TubeMaker(curve, radius).make();
}

}  // namespace rondure
