// Bases of spline spaces with small supports.
#include "renderer/complex/local_basis.h"

#include <algorithm>
#include <map>
#include <set>

#include "renderer/complex/gc_function.h"
#include "renderer/complex/shipped.h"
#include "tests/catch.h"

namespace rondure {
namespace {

// How many functions live on so many polygons; each is checked to be geometrically continuous, exactly.
std::map<std::size_t, int> supports_of(const SurfaceComplex& complex, int n) {
  const SplineSpace space = local_spline_space(complex, n);
  const SplineSpace plain = spline_space(complex, n);
  CHECK(space.dimension() == plain.dimension());
  const GcBasis basis = basis_of(complex, space);
  std::map<std::size_t, int> count;
  int broken = 0;
  for (std::size_t k = 0; k < space.dimension(); ++k) {
    ++count[support_of(space, k).size()];
    broken += !is_gc1(complex, function_of(basis, k));
  }
  CHECK(broken == 0);
  // A name each.
  CHECK(std::set<std::string>(basis.names.begin(), basis.names.end()).size() == space.dimension());
  if (space.dimension() > 100) return count;  // elimination would take seconds
  // Independent: as many pivots as functions, by elimination of the functions themselves.
  std::vector<int> order(static_cast<std::size_t>(space.offsets.back()));
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
  CHECK(exact_null_space(space.solutions.basis, order).rank == static_cast<int>(space.dimension()));
  return count;
}

}  // namespace

TEST_CASE("functions live on few polygons, on every complex from degree 4 on", "[complex]") {
  using Count = std::map<std::size_t, int>;
  CHECK(supports_of(octahedron_complex(), 3) == Count{{7, 8}});
  CHECK(supports_of(octahedron_complex(), 4) == Count{{4, 24}});
  CHECK(supports_of(octahedron_complex(), 6) == Count{{1, 8}, {2, 48}, {4, 24}});
  CHECK(supports_of(cube_complex(), 3) == Count{{4, 24}});
  CHECK(supports_of(cube_complex(), 4) == Count{{1, 6}, {2, 12}, {3, 24}, {4, 12}});
  // Of 36 rhombi: none reaches further than the polygons around the two ends of an edge.
  const Count torus = supports_of(torus_complex(4, 3), 4);
  CHECK(torus.rbegin()->first <= 11);
  CHECK(torus.at(1) == 36);
  CHECK(torus.at(2) == 72);
}

TEST_CASE("on a torus in degree 3 some functions must be wide", "[complex]") {
  // Regions up to the polygons around a polygon hold 71 independent functions of 108: no basis is more local.
  const SurfaceComplex complex = torus_complex(4, 3);
  const SplineSpace space = local_spline_space(complex, 3);
  CHECK(space.dimension() == 108);
  int near = 0;
  for (std::size_t k = 0; k < space.dimension(); ++k) near += support_of(space, k).size() <= 8;
  CHECK(near == 71);
  CHECK(largest_entry(space.solutions) < 1e4);
}

TEST_CASE("rounded bases are local as far as they can be, and small", "[complex]") {
  // As if they were not rational: the dimensions are known exactly.
  struct Known {
    SurfaceComplex complex;
    int degree;
    int local;  // functions on 11 polygons at most
  };
  for (const Known& known : {Known{octahedron_complex(), 4, 24}, Known{cube_complex(), 4, 54},
                             Known{torus_complex(4, 3), 3, 72}}) {
    SurfaceComplex rounded = known.complex;
    rounded.exact = false;
    const SplineSpace exact = local_spline_space(known.complex, known.degree);
    const SplineSpace space = rounded_local_space(rounded, known.degree);
    CAPTURE(known.complex.sides.size(), space.solutions.gap);
    CHECK(space.dimension() == exact.dimension());
    CHECK(space.solutions.gap > 1e10);
    CHECK(largest_entry(space.solutions) < 16.0);
    CHECK(std::set<int>(space.solutions.free.begin(), space.solutions.free.end()).size() ==
          space.dimension());
    int local = 0;
    for (std::size_t k = 0; k < space.dimension(); ++k) local += support_of(space, k).size() <= 11;
    CHECK(local >= known.local);
    const GcBasis basis = basis_of(known.complex, space);
    double worst = 0.0;
    for (std::size_t k = 0; k < basis.functions.size(); k += 10) {
      const GcDefect d = gc1_defect(known.complex, function_of(basis, k));
      worst = std::max({worst, d.value, d.derivative});
    }
    // Entries are good to some eps of the largest, and derivatives multiply by the degree.
    CHECK(worst < 1e-12);
  }
}

}  // namespace rondure
