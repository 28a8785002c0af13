// Normal estimators: what they share, what they are meant to get wrong, and what they do to light.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "renderer/bezier/angle.h"
#include "renderer/bezier/rational.h"
#include "renderer/normals/direction.h"
#include "renderer/normals/normal_field.h"
#include "renderer/normals/normal_germ.h"
#include "renderer/study/corner_normals.h"
#include "renderer/study/ray_trials.h"
#include "tests/catch.h"
#include "tests/normals/subject_quadrics.h"
#include "tests/render/staged_scene.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

Surface built(const std::string& name) {
  return surface_of(subjects_named({name}).at(0), StagedScene::builtins());
}

TEST_CASE("a vector has a direction however long it is", "[normals]") {
  for (const double length : {5e-324, 1e-200, 1e200, 1.7e308}) {
    const auto direction = direction_of(dvec3(length, length, 0.0));
    REQUIRE(direction);
    CHECK(glm::distance(*direction, dvec3(std::sqrt(0.5), std::sqrt(0.5), 0.0)) < 1e-15);
  }
  CHECK_FALSE(direction_of(dvec3(0.0)));
  CHECK_FALSE(direction_of(dvec3(INFINITY, 0.0, 0.0)));
  CHECK_FALSE(direction_of(dvec3(1.0, NAN, 0.0)));
}

TEST_CASE("away from singular points all estimators agree", "[normals]") {
  WorstCase worst;
  for (const Subject& subject : subjects()) {
    const Surface surface = surface_of(subject, StagedScene::builtins());
    const NormalField field(surface);
    const int patches = std::min(4, static_cast<int>(surface.patches.size()));
    for (int patch = 0; patch < patches; ++patch) {
      for (const dvec2& p : {dvec2(0.3, 0.4), dvec2(0.21, 0.17), dvec2(0.45, 0.35)}) {
        const dvec3 limit = unit_normal(surface.patches[static_cast<std::size_t>(patch)], p.x, p.y);
        for (std::size_t k = 0; k < estimator_names().size(); ++k) {
          const auto estimator = static_cast<NormalEstimator>(k);
          if (estimator == NormalEstimator::analytic && !field.quadric(patch)) continue;
          const NormalEstimate n = field.at(estimator, patch, p.x, p.y);
          // Tangents there are at least a tenth of a radian apart and not much shorter than the patch: a
          // cross product is good to some hundred roundings of its arithmetic. The reduced polynomial's
          // coefficients are less sure.
          const double tolerance = estimator == NormalEstimator::cross_float ? 1e-4
                                   : estimator == NormalEstimator::hodograph ? 1e-9
                                                                             : 1e-12;
          worst.add(n ? angle_between(*n, limit) : 4.0, tolerance, [&] {
            return fmt::format("{}, patch {} at {}, {}: {}", subject.name, patch, p.x, p.y,
                               estimator_names()[k]);
          });
        }
      }
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(worst.count() > 800);
}

TEST_CASE("quadrics are found where there are some", "[normals]") {
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    const Surface surface = surface_of(subject, StagedScene::builtins());
    const std::optional<ImplicitQuadric> q = quadric_through(surface.patches);
    const bool cone = subject.name.starts_with("cone");
    const std::optional<SubjectQuadric> exact = subject_quadric(subject.name);
    if (!exact && !cone) continue;
    REQUIRE(q);
    const dvec3 p = net_point(surface.patches[0], 0.3, 0.2);
    CHECK(q->distance(p) < 1e-15);
    if (cone) {
      CHECK(quadric_curvature(*q, p, 1.0).gaussian == Approx(0.0).margin(1e-13));
      continue;
    }
    const std::array<double, 3> g = exact->gradient(std::array<double, 3>{p.x, p.y, p.z});
    const dvec3 gradient(g[0], g[1], g[2]);
    CHECK(std::abs(glm::dot(glm::normalize(q->gradient(p)), glm::normalize(gradient))) ==
          Approx(1.0).epsilon(1e-14));
    const QuadricCurvature k =
        quadric_curvature(*q, p, glm::dot(q->gradient(p), gradient) < 0.0 ? -1.0 : 1.0);
    CHECK(k.gaussian == Approx(exact->gaussian(p)).epsilon(1e-12));
    CHECK(k.mean == Approx(exact->mean(p)).epsilon(1e-12));
  }
  CHECK_FALSE(quadric_through(built("gc1_cubic").patches));
  // A piece of the sphere on which ten unknowns are not told from rounding.
  const StagedScene piece(R"({ "objects": [ { "type": "circular_quad",
    "corners": [[1, 0, 0], [1, 0.02, 0], [1, 0.02, 0.02], [1, 0, 0.03]] } ] })");
  const auto sphere = quadric_through(piece.tracer.surfaces()[0].surface.patches);
  REQUIRE(sphere);
  CHECK(glm::length(glm::normalize(sphere->gradient({1, 0, 0})) - dvec3(1, 0, 0)) ==
        Approx(0.0).margin(1e-12));
  // An ellipsoid, and a plane.
  const StagedScene s(R"({ "objects": [ { "type": "sphere_tiling", "transform": [ { "scale": [2, 3, 1] } ] },
    { "type": "bezier", "patches": [ { "degree": [1, 1], "net": [ [[0,0,1,1],[0,1,1,1]], [[1,0,1,1],[1,1,1,1]] ] } ] } ] })");
  const auto& surfaces = s.tracer.surfaces();
  const auto ellipsoid = quadric_through(surfaces[0].surface.patches),
             plane = quadric_through(surfaces[1].surface.patches);
  REQUIRE(ellipsoid);
  REQUIRE(plane);
  const dvec3 tip(0, 0, 1);  // curvatures c / a^2 and c / b^2
  CHECK(quadric_curvature(*ellipsoid, tip, glm::dot(ellipsoid->gradient(tip), tip) < 0.0 ? -1.0 : 1.0)
            .gaussian == Approx(1.0 / 36.0).epsilon(1e-12));
  CHECK(plane->distance({0.3, 0.2, 1.5}) == Approx(0.5).epsilon(1e-13));
}

TEST_CASE("there is no limit at a cone's tip, and one at each place of its collapsed side", "[normals]") {
  const Surface corner = built("cone_corner"), side = built("cone_side");
  const NormalGerm tip = germ_of(corner.patches[0], {0.0, 0.0});
  CHECK(tip.order == 2);
  CHECK_FALSE(tip.has_limit);
  // Ways along the two straight sides, (1, 0, -1) and (-1, 0, -1), have normals at a right angle.
  CHECK(tip.spread == Approx(std::numbers::pi / 2.0).margin(0.01));
  CHECK_FALSE(limit_normal(corner.patches[0], 0.0, 0.0));
  CHECK(limit_normal(corner.patches[0], 1e-12, 1e-13));
  for (const double u : {0.0, 0.25, 1.0}) {
    const NormalGerm germ = germ_of(side.patches[0], {u, 1.0});
    CHECK(germ.side_order == 1);
    CHECK(germ.order == 0);
    const NormalEstimate n = limit_normal(side.patches[0], u, 1.0);
    REQUIRE(n);
    const dvec3 below = net_point(side.patches[0], u, 0.0);
    CHECK(angle_between(*n, glm::normalize(below + dvec3(0, 0, 1))) < 1e-12);
  }
}

TEST_CASE("the order of the shipped singular points is what the formulas say", "[normals]") {
  // f_u x f_v = 6 sqrt(2) (u + v) (1, 0, 0) + ... at a hemisphere's corner; at the pole of an octant the
  // factor 1 - v.
  const Surface hemispheres = built("hemispheres"), octants = built("octants");
  for (const Net& net : hemispheres.patches) {
    for (const dvec2& p : {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1), dvec2(1, 1)}) {
      const NormalGerm germ = germ_of(net, p);
      CHECK(germ.order == 1);
      CHECK(germ.has_limit);
      CHECK(germ.spread < 1e-12);
    }
    CHECK(germ_of(net, {0.5, 0.0}).order == 0);
  }
  for (const Net& net : octants.patches) {
    // The mirrored octants have u reversed, never v.
    CHECK(germ_of(net, {0.3, 1.0}).side_order == 1);
    CHECK(germ_of(net, {0.3, 1.0}).order == 0);
    CHECK(angle_between(limit_normal(net, 0.3, 1.0).value(), net_point(net, 0.3, 1.0)) < 1e-15);
  }
}

// The row of a group and estimator.
double slope_of(const Table& slopes, const std::string& group, const std::string& estimator) {
  for (std::size_t k = 0; k < slopes.size(); ++k)
    if (slopes.at(k, "group") == group && slopes.at(k, "estimator") == estimator)
      return slopes.number(k, "slope");
  return std::nan("");
}
double worst_of(const Table& slopes, const std::string& group, const std::string& estimator) {
  for (std::size_t k = 0; k < slopes.size(); ++k)
    if (slopes.at(k, "group") == group && slopes.at(k, "estimator") == estimator)
      return slopes.number(k, "worst");
  return std::nan("");
}

TEST_CASE("errors beside singular points grow as the analysis says", "[normals]") {
  for (const auto& [family, group] :
       {std::pair("hemispheres", "corner of 180 degrees"), std::pair("octants", "collapsed side (middle)")}) {
    CAPTURE(family);
    const CornerTables t =
        measure_corners(turned(subjects_named({family}).at(0)), StagedScene::builtins(), false);
    const Table slopes = corner_slopes(t.walks);
    // Su x Sv vanishes as the distance, rounding does not: errors grow as its inverse.
    CHECK(slope_of(slopes, group, "cross") == Approx(-1.0).margin(0.15));
    CHECK(slope_of(slopes, group, "cross_float") == Approx(-1.0).margin(0.3));
    CHECK(worst_of(slopes, group, "cross_float") > 0.3);
    for (const char* right : {"limit", "analytic"}) {
      CHECK(worst_of(slopes, group, right) < 1e-12);
    }
    CHECK(worst_of(slopes, group, "hodograph") < 1e-9);
    // Parallel tangents they see, and step away from; beside a collapsed side only one is short, and they do
    // not.
    if (family == std::string("hemispheres")) {
      CHECK(worst_of(slopes, group, "shift") < 3e-3);
      CHECK(worst_of(slopes, group, "taylor") < 1e-10);
    } else {
      CHECK(worst_of(slopes, group, "shift") == worst_of(slopes, group, "cross"));
      CHECK(worst_of(slopes, group, "taylor") == worst_of(slopes, group, "cross"));
    }
    for (const std::string solver : RayTrials::names) {
      CAPTURE(solver);
      double rays = 0, hits = 0, off = 0;
      for (std::size_t k = 0; k < t.walks.size(); ++k) {
        rays += t.walks.number(k, "rays"), hits += t.walks.number(k, "hits_" + solver);
        off = std::max(off, t.walks.number(k, "off_" + solver));
      }
      CHECK(rays > 500);
      CHECK(hits == rays);
      CHECK(off < 1e-14);
    }
  }
}

TEST_CASE("wrong normals add no light and no NaN", "[normals]") {
  // White bodies in a white room, from so close to a singular corner that single precision knows no normal.
  for (const std::string& name : estimator_names()) {
    for (const char* material :
         {R"({ "albedo": 1 })", R"({ "type": "mirror" })", R"({ "type": "dielectric" })",
          R"({ "type": "rough_conductor", "roughness": 0.4 })"}) {
      CAPTURE(name, material);
      const StagedScene s(fmt::format(
          R"({{ "camera": {{ "type": "orthographic", "origin": [3, 0.1, 0.2], "target": [1, 0, 0], "height": 1e-5 }},
        "film": {{ "resolution": [12, 12] }}, "integrator": {{ "type": "path", "max_depth": 60, "min_depth": 60 }},
        "materials": {{ "m": {} }}, "lights": [ {{ "type": "constant" }} ], "normals": "{}",
        "objects": [ {{ "type": "sphere_tiling", "topology": "hemispheres", "material": "m" }} ] }})",
          material, name));
      const Film film = s.render(8);
      CHECK(film.rejected == 0);
      double brightest = 0.0;
      for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x) brightest = std::max(brightest, film.mean(x, y).color.x);
      CHECK(brightest < 1.0 + 1e-12);
      CHECK(picture_mean(film).mean > 0.1);
    }
  }
}

TEST_CASE("an object's estimator shades it and leaves its geometry alone", "[normals]") {
  const auto scene = [](const char* top, const char* own) {
    return fmt::format(R"({{ "camera": {{ "type": "orthographic", "origin": [3, 0, 0], "height": 2e-4 }},
      "film": {{ "resolution": [16, 16] }}, "integrator": "normals", "normals": "{}",
      "objects": [ {{ "type": "sphere_tiling", "topology": "hemispheres"{} }} ] }})",
                       top, own);
  };
  const Film limit = StagedScene(scene("limit", "")).render(1);
  const Film wrong = StagedScene(scene("limit", R"(, "normals": "cross_float")")).render(1);
  const Film all = StagedScene(scene("cross_float", "")).render(1);
  const Film kept = StagedScene(scene("cross_float", R"(, "normals": "limit")")).render(1);
  int same = 0, shaded = 0, moved = 0;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      same +=
          limit.mean(x, y).color == kept.mean(x, y).color && wrong.mean(x, y).color == all.mean(x, y).color;
      shaded += limit.mean(x, y).color != wrong.mean(x, y).color;
      moved += limit.geometry[limit.index(x, y)].point != wrong.geometry[wrong.index(x, y)].point;
    }
  }
  CHECK(same == 256);
  CHECK(shaded == 256);
  CHECK(moved == 0);
}

}  // namespace
}  // namespace rondure
