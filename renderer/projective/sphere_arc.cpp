#include "renderer/projective/sphere_arc.h"

namespace rondure {

// The derivative of the curve at an end is along b - w p: it is at right angles to p, as p . b = w.
lvec3 SphereArc::start_tangent() const { return glm::normalize(b - w * p); }
lvec3 SphereArc::end_tangent() const { return glm::normalize(w * q - b); }

SphereArc great_arc(const lvec3& p, const lvec3& q) {
  const lvec3 sum = p + q;
  const long double length = glm::length(sum);
  return {p, q, sum / length, length / 2};
}

// B = (b, w) is the combination of P, Q and R = (r, 1) with <P, B> = <Q, B> = 0 and 2 <B, B> = -<P, Q>, where
// <.,.> is the form of the sphere, x x' + y y' + z z' - w w'. On the sphere <P, Q> = -|p - q|^2 / 2. The
// positive coefficient of R makes the arc pass through r.
SphereArc arc_through(const lvec3& p, const lvec3& r, const lvec3& q) {
  const lvec3 pq = q - p, pr = r - p, qr = r - q;
  const long double a = glm::dot(qr, qr), b = glm::dot(pr, pr), c = glm::dot(pq, pq);
  const long double factor = 1 / (2 * glm::length(pr) * glm::length(qr));
  return {p, q, factor * (c * r - a * p - b * q), factor * (c - a - b)};
}

lvec3 middle_in_plane(const lvec3& p, const lvec3& q, const lvec3& normal, long double distance) {
  const lvec3 middle = distance * normal;
  const lvec3 chord = (p - middle) + (q - middle);
  // Back into the plane: the corners lie there only as well as they are rounded.
  const lvec3 flat = chord - glm::dot(chord, normal) * normal;
  const lvec3 r = middle + flat * (glm::length(p - middle) / glm::length(flat));
  return glm::normalize(r);
}

}  // namespace rondure
