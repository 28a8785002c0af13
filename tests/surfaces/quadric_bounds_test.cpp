// Bounded patches of all kinds of quadrics against the equation and the bounds.
#include <fmt/format.h>

#include <numbers>

#include "renderer/bezier/bounds.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"
#include "tests/surfaces/quadric_roots.h"

namespace rondure {
namespace {

Quadric plain(QuadricKind kind, const lvec3& axes) { return {kind, axes, lmat4(1)}; }

constexpr double degrees = 180 / std::numbers::pi;

double within(double x, double low, double high) { return std::min(x - low, high - x); }

}  // namespace

// Lines that are aimed at nothing: a patch is met at the roots of the equation that lie on it, and not at
// others. `inside` says how far within the patch a point of the quadric is, in its own coordinates; negative
// outside.
TEST_CASE("a line meets a patch at the roots within its bounds", "[surfaces]") {
  struct Bounded {
    const char* parameters;
    Quadric quadric;
    double (*inside)(const dvec3& p);
  };
  const Bounded bounded[] = {
      {R"("semi_axes": [2, 1, 0.5], "surface": {"type": "sphere_tiling", "topology": "cube_2_4"})",
       plain(QuadricKind::ellipsoid, {2, 1, 0.5L}), [](const dvec3&) { return 1.0; }},
      // z / c = 1 / -s_z.
      {R"("quadric": "two_sheets", "semi_axes": [1, 2, 0.5], "surface": {"type": "sphere_cap", "z_max": -0.4})",
       plain(QuadricKind::two_sheets, {1, 2, 0.5L}),
       [](const dvec3& p) { return within(p.z / 0.5, 0.0, 1 / 0.4); }},
      // z / c = (1 + s_z) / (1 - s_z).
      {R"("quadric": "elliptic_paraboloid", "semi_axes": [1, 2, 3], "surface": {"type": "sphere_cap", "z_max": 0.2})",
       plain(QuadricKind::elliptic_paraboloid, {1, 2, 3}),
       [](const dvec3& p) { return within(p.z / 3, -1.0, 1.2 / 0.8); }},
      {R"("quadric": "one_sheet", "semi_axes": [1, 2, 0.5], "rulings": [[-30, 40], [-20, 35]])",
       plain(QuadricKind::one_sheet, {1, 2, 0.5L}),
       [](const dvec3& p) {
         const double sum = std::atan2(p.y / 2, p.x) * degrees, difference = std::atan(p.z / 0.5) * degrees;
         double best = -INFINITY;
         for (const double turn : {-360.0, 0.0, 360.0})
           best = std::max(best, std::min(within((sum + turn + difference) / 2, -30, 40),
                                          within((sum + turn - difference) / 2, -20, 35)));
         return best;
       }},
      {R"("quadric": "hyperbolic_paraboloid", "semi_axes": [1, 2, 3], "rulings": [[-1, 2], [-2, 1]])",
       plain(QuadricKind::hyperbolic_paraboloid, {1, 2, 3}),
       [](const dvec3& p) { return std::min(within(p.x + p.y / 2, -1, 2), within(p.x - p.y / 2, -2, 1)); }}};
  NetMaker make(64);
  int wrong = 0, doubtful = 0, met = 0, passed_by = 0;
  std::string which;
  for (const Bounded& b : bounded) {
    const Surface surface = build_family(fmt::format(R"({{"type": "quadric_patch", {}}})", b.parameters));
    Box box;
    for (const Net& net : surface.patches) box.add(*bounds_of(net));
    const auto somewhere = [&](double wider) {
      const dvec3 middle = 0.5 * (box.low + box.high), half = 0.5 * wider * (box.high - box.low);
      return middle + half * dvec3(make.uniform(-1, 1), make.uniform(-1, 1), make.uniform(-1, 1));
    };
    const lmat4 matrix = matrix_of(b.quadric);
    for (const Solver solver : {Solver::newton, Solver::clipping, Solver::quadric}) {
      const Tracer tracer({{surface, solver}});
      for (int k = 0; k < 2000; ++k) {
        Ray ray;
        ray.origin = somewhere(4);
        ray.direction = somewhere(1.2) - ray.origin;
        const Meeting roots = meet(matrix, ray);
        int expected = 0;
        bool doubt = roots.count == 2 && std::abs(roots.t[0] - roots.t[1]) < 1e-6;
        for (int i = 0; i < roots.count; ++i) {
          if (roots.t[i] < 0.0) continue;
          const double inside = b.inside(ray.origin + roots.t[i] * ray.direction);
          doubt = doubt || std::abs(inside) < 1e-9 || roots.t[i] < 1e-9;
          expected += inside > 0.0;
          passed_by += inside < 0.0;
        }
        if (doubt) {
          ++doubtful;
          continue;
        }
        met += expected;
        if (static_cast<int>(tracer.all(ray).size()) == expected) continue;
        ++wrong;
        which = fmt::format("{} ray {}", b.parameters, k);
      }
    }
  }
  INFO(which << "; " << met << " met, " << passed_by << " roots outside, " << doubtful << " doubtful");
  CHECK(wrong == 0);
  CHECK(met > 10000);
  CHECK(passed_by > 5000);
  CHECK(doubtful < 10);
}

}  // namespace rondure
