// A patch equals its subdivisions, its degree elevation and its projective re-parametrisation: the same rays
// meet them, as often, at the same t, point and parameters.
//
// How far apart they may be. The new net differs from one of the same surface by `roundings` roundoffs of
// each control point, which moves the surface by e = sqrt(3) roundings roundoffs (|S| + |base| w) / w at
// most: the sums that tangency_band() takes the largest of, and its quarter more. A root moves along the ray
// by e / cos where the angle of incidence is far from a right one; with curvature k along the ray, cos s - k
// s^2 / 2 = e has the roots s = (cos +- sqrt(cos^2 - 2 k e)) / k, which are within 2 e / cos while cos^2 > 2
// k e, and within 6 e / cos of where they were in any case. To this comes what each solver says of its own
// error. The points are off the ray by their own bands beside; a solver may have slid one along the ray by
// its own error. Either may meet the ray where the other does not when it is within both bands and e of
// touching the surface, which the oracle tells, or of an open surface's rim.

#include <fmt/core.h>

#include <glm/geometric.hpp>
#include <random>

#include "renderer/bezier/quotient.h"
#include "renderer/bezier/rational.h"
#include "renderer/intersect/root.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/intersect/closed_models.h"
#include "tests/intersect/equal_surfaces.h"
#include "tests/intersect/random_direction.h"
#include "tests/oracle/oracle.h"
#include "tests/soak.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

struct Subject {
  std::string name;
  Surface surface;
  bool sphere = false;  // or a part of it, of radius 1
};

// A wavy sheet, open, which rays meet several times, with weights from 1/2 to 2.
Surface sheet(NetMaker& make, bool tensor, int m, int n) {
  const auto point = [&](double x, double y) {
    const double z = make.uniform(-1.5, 1.5), w = std::exp2(make.uniform(-1.0, 1.0));
    return w * dvec4(2.0 * x - 1.0, 2.0 * y - 1.0, z, 1.0);
  };
  Surface out;
  if (tensor) {
    TensorNet net(m, n);
    for (int i = 0; i <= m; ++i)
      for (int j = 0; j <= n; ++j) net.at(i, j) = point(double(i) / m, double(j) / n);
    out.patches.push_back(net);
  } else {
    TriangleNet net(n);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n - i; ++j) net.at(i, j) = point(double(i) / n, double(j) / n);
    out.patches.push_back(net);
  }
  return out;
}

std::vector<Subject> subjects() {
  std::vector<Subject> out;
  for (const char* text : {R"({"type": "sphere_tiling", "topology": "cube"})",
                           R"({"type": "sphere_tiling", "topology": "hemispheres"})",
                           R"({"type": "sphere_tiling", "topology": "octahedron_pairs"})",
                           R"({"type": "sphere_octant"})", R"({"type": "sphere_cap"})", R"({"type": "iss"})",
                           R"({"type": "iss", "form": "degenerate"})", R"({"type": "gc_octahedron"})"})
    out.push_back({text, build_family(text), std::string(text).find("sphere") != std::string::npos});
  NetMaker make(11);
  for (const auto& [tensor, m, n] : {std::tuple{true, 1, 1},
                                     {true, 2, 4},
                                     {true, 3, 3},
                                     {true, 5, 2},
                                     {false, 0, 1},
                                     {false, 0, 3},
                                     {false, 0, 5}})
    out.push_back({fmt::format("a sheet of degree ({}, {}){}", m, n, tensor ? "" : ", a triangle"),
                   sheet(make, tensor, m, n), false});
  return out;
}

double radius_of(const Surface& surface) {
  double radius = 0.0;
  for (const Net& net : surface.patches)
    for (const dvec4& p : points_of(net)) radius = std::max(radius, glm::length(dvec3(p) / p.w));
  return radius;
}

class Aim {
 public:
  Aim(const Surface& surface, double radius, unsigned seed)
      : surface_(surface), radius_(radius), random_(seed) {}

  // Across the ball; at a parameter line that subdivision makes a seam, or at a corner; or past a point at
  // right angles to the normal, at distances from 10^-1 to 10^-16 of the radius to either side.
  Ray next(int sort) {
    const double scale = std::exp2(uniform(-2.0, 2.0));
    if (sort == 0) {
      const dvec3 from = 3.0 * radius_ * random_direction(random_),
                  to = 0.8 * radius_ * std::cbrt(uniform(0.0, 1.0)) * random_direction(random_);
      return {from, scale * (to - from)};
    }
    const auto patch = std::uniform_int_distribution<std::size_t>(0, surface_.patches.size() - 1)(random_);
    const Net& net = surface_.patches[patch];
    dvec2 at(uniform(0.0, 1.0), uniform(0.0, 1.0));
    if (sort == 1) {
      const double lines[] = {0.0, 0.5, 1.0};
      const auto line = [&] { return lines[std::uniform_int_distribution<int>(0, 2)(random_)]; };
      at.x = line();
      if (uniform(0.0, 1.0) < 0.3) at.y = line();
      if (uniform(0.0, 1.0) < 0.5) std::swap(at.x, at.y);
    }
    if (std::holds_alternative<TriangleNet>(net) && at.x + at.y > 1.0) at = dvec2(1.0) - at;
    const dvec3 point = net_point(net, at.x, at.y), normal = unit_normal(net, at.x, at.y);
    dvec3 direction = random_direction(random_), target = point;
    if (sort == 2) {
      const dvec3 along = direction - glm::dot(direction, normal) * normal;
      if (glm::length(along) > 0.1) direction = glm::normalize(along);
      const double off = std::pow(10.0, -uniform(1.0, 16.0)) * (uniform(0.0, 1.0) < 0.5 ? 1.0 : -1.0);
      target += off * radius_ * normal;
    }
    return {surface_.origin + target - 2.5 * radius_ * direction, scale * direction};
  }

 private:
  const Surface& surface_;
  double radius_;
  std::mt19937_64 random_;

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
};

// How far a point is from the ray's line.
double off_line(const Ray& ray, const dvec3& point) {
  return glm::length(glm::cross(point - ray.origin, glm::normalize(ray.direction)));
}

// A hit as the subject's own patches have it.
struct Place {
  int patch;
  dvec2 at;
  double t;
};

// A ray that meets a flat patch twice, or leaves its plane by no more than `band` on the way across the
// patch, runs within it: wherever it is nearer than `band`, any t is right, and none.
bool within_a_plane(const Surface& surface, const Ray& ray, double radius, const std::vector<Place>& places,
                    double band) {
  std::size_t near = 0;
  double steepest = 0.0;
  for (const Place& place : places) {
    const auto* net = std::get_if<TriangleNet>(&surface.patches[static_cast<std::size_t>(place.patch)]);
    if (!net || net->n != 1) return false;
    const auto corner = [&](int i, int j) { return glm::dvec3(net->at(i, j)) / net->at(i, j).w; };
    const dvec3 normal = glm::normalize(glm::cross(corner(1, 0) - corner(0, 0), corner(0, 1) - corner(0, 0)));
    const dvec3 point = ray.origin - surface.origin + place.t * ray.direction;
    // Rounding of the point itself, which is a few radii away from the origin of the ray.
    near += std::fabs(glm::dot(normal, point - corner(0, 0))) <=
            band + 8.0 * unit_roundoff * (glm::length(ray.origin) + place.t * glm::length(ray.direction));
    steepest = std::max(steepest, std::fabs(glm::dot(normal, glm::normalize(ray.direction))));
  }
  return near == places.size() && (near > 1 || 2.0 * radius * steepest <= band);
}

// Where either answer is right: within `band`, in scene units, of touching the surface, or of its rim.
bool in_band(const Subject& subject, const Ray& ray, double radius, double band,
             const std::vector<Place>& places) {
  const Surface& surface = subject.surface;
  // The rim: whatever patch of an open surface was met beside its boundary, the boundary is that near. The
  // place on it is not the nearest, but no more than twice as far.
  for (const Place& place : places) {
    const Net& net = surface.patches[static_cast<std::size_t>(place.patch)];
    dvec2 rim = place.at;
    const bool triangle = std::holds_alternative<TriangleNet>(net);
    double least = 1.0;
    const auto snap = [&](double distance, dvec2 to) {
      if (std::fabs(distance) < least) least = std::fabs(distance), rim = to;
    };
    snap(place.at.x, {0.0, place.at.y}), snap(place.at.y, {place.at.x, 0.0});
    if (triangle)
      snap(1.0 - place.at.x - place.at.y, place.at + 0.5 * (1.0 - place.at.x - place.at.y));
    else
      snap(1.0 - place.at.x, {1.0, place.at.y}), snap(1.0 - place.at.y, {place.at.x, 1.0});
    if (!surface.closed && least < 1e-6 &&
        off_line(ray, surface.origin + net_point(net, rim.x, rim.y)) <= 2.0 * band)
      return true;
  }
  if (within_a_plane(surface, ray, radius, places, band)) return true;
  // Of a sphere the distance from the centre tells.
  if (subject.sphere) return std::fabs(off_line(ray, surface.origin) - 1.0) <= band;
  const oracle::Meeting meeting = oracle::meet(surface, ray, 2.0 * band / radius);
  for (const oracle::Graze& graze : meeting.grazes)
    if (graze.depth <= band && graze.outside <= 0x1p-40) return true;
  for (const oracle::Root& root : meeting.roots)
    if (root.multiplicity != 1) return true;
  return false;
}

struct Tally {
  long rays = 0, hits = 0, banded = 0, wrong = 0, crossed = 0, unmeasured = 0;
  std::string miss = "none";
  WorstCase t, point, parameters, back;
};

void compare(const Subject& subject, const EqualSurface& equal, const Tracer& old_one, const Tracer& new_one,
             const char* solver, int count, unsigned seed, Tally& tally) {
  const double radius = radius_of(subject.surface);
  const double old_band = tangency_band(subject.surface, radius),
               new_band = tangency_band(equal.surface, radius),
               e = std::sqrt(3.0) * equal.roundings / residual_roundoffs * new_band;
  Aim aim(subject.surface, radius, seed);
  for (int k = 0; k < count; ++k) {
    const Ray ray = aim.next(k % 3);
    const std::vector<Hit> a = old_one.all(ray), b = new_one.all(ray);
    ++tally.rays, tally.hits += static_cast<long>(a.size());
    const auto describe = [&] {
      return fmt::format(
          "{}, {}, {}, o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g}): {} and {} hits",
          subject.name, equal.name, solver, ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x,
          ray.direction.y, ray.direction.z, a.size(), b.size());
    };
    if (a.size() != b.size()) {
      std::vector<Place> places;
      for (const Hit& hit : a) places.push_back({hit.patch, {hit.u, hit.v}, hit.t});
      for (const Hit& hit : b) {
        const PieceOf& piece = equal.pieces[static_cast<std::size_t>(hit.patch)];
        places.push_back({piece.patch, piece.back({hit.u, hit.v}), hit.t});
      }
      if (in_band(subject, ray, radius, old_band + new_band + e, places))
        ++tally.banded;
      else
        ++tally.wrong, tally.miss = describe();
      continue;
    }
    const double length = glm::length(ray.direction);
    for (std::size_t j = 0; j < a.size(); ++j) {
      const double cosine = std::min(std::fabs(glm::dot(a[j].normal, ray.direction)),
                                     std::fabs(glm::dot(b[j].normal, ray.direction))) /
                            length;
      const double along = quotient(6.0 * e, cosine),
                   t_bound = a[j].t_error + b[j].t_error + (e > 0.0 ? along / length : 0.0);
      tally.t.add(std::fabs(a[j].t - b[j].t), t_bound, describe);
      const double apart = t_bound * length + old_band + new_band + e;
      tally.point.add(glm::length(a[j].point - b[j].point), apart, describe);
      // The same point by the old net, at the new parameters.
      const PieceOf& piece = equal.pieces[static_cast<std::size_t>(b[j].patch)];
      const Net& net = subject.surface.patches[static_cast<std::size_t>(piece.patch)];
      const dvec2 there = piece.back({b[j].u, b[j].v});
      const SurfaceJet jet = surface_jet(net, there.x, there.y);
      // Parameters rounded three times in going back.
      const double turned = 8.0 * unit_roundoff * (glm::length(jet.du) + glm::length(jet.dv));
      tally.back.add(glm::length(subject.surface.origin + jet.point - b[j].point),
                     old_band + new_band + e + turned + b[j].t_error * length, describe);
      if (piece.patch != a[j].patch) {
        ++tally.crossed;  // a seam's hit belongs to either
        continue;
      }
      // The least singular value of the Jacobian: twice what it allows, since it changes on the way.
      const double du = glm::dot(jet.du, jet.du), dv = glm::dot(jet.dv, jet.dv);
      const double area = glm::length(glm::cross(jet.du, jet.dv));
      const double least = area / std::sqrt(du + dv);
      if (!(apart < 1e-3 * least)) {
        ++tally.unmeasured;
        continue;
      }
      tally.parameters.add(glm::length(there - dvec2(a[j].u, a[j].v)),
                           2.0 * apart / least + 8.0 * unit_roundoff, describe);
    }
  }
}

}  // namespace

TEST_CASE("A patch equals its subdivisions, elevations and projective re-parametrisations", "[equalities]") {
  const int count = static_cast<int>(soaked(150, 30'000));
  Tally tally;
  unsigned seed = 0;
  for (const Subject& subject : subjects())
    for (const auto& [solver, name] : {std::pair{Solver::newton, "newton"},
                                       {Solver::clipping, "clipping"},
                                       {Solver::quadric, "quadric"}}) {
      const Tracer old_one({{subject.surface, solver}});
      for (const EqualSurface& equal : equals_of(subject.surface)) {
        const Tracer new_one({{equal.surface, solver}});
        compare(subject, equal, old_one, new_one, name, solver == Solver::clipping ? count / 3 : count,
                ++seed, tally);
      }
    }
  INFO(tally.rays << " rays, " << tally.hits << " hits; counts differ " << tally.banded
                  << " times within the band, " << tally.wrong << " times beyond it: " << tally.miss);
  INFO("t: " << tally.t.text());
  INFO("points: " << tally.point.text());
  INFO("the old net at the new parameters: " << tally.back.text());
  INFO("parameters: " << tally.parameters.text() << "; " << tally.crossed << " on seams, " << tally.unmeasured
                      << " where the Jacobian is singular");
  CHECK(tally.wrong == 0);
  CHECK(tally.t.failures() == 0);
  CHECK(tally.point.failures() == 0);
  CHECK(tally.back.failures() == 0);
  CHECK(tally.parameters.failures() == 0);
  CHECK(tally.hits > tally.rays);
  CHECK(tally.banded < tally.rays / 20);
  CHECK(tally.parameters.count() > tally.hits / 2);
}

}  // namespace rondure
