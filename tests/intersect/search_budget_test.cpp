// A surface that takes a ray's searches long does not keep the ray from the next.

#include "renderer/intersect/search_budget.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "renderer/intersect/solve_leaf.h"
#include "tests/catch.h"
#include "tests/intersect/mapped.h"
#include "tests/intersect/placed.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;

TEST_CASE("Each surface's searches have cells of their own", "[solvers]") {
  SearchCounts counts;
  SearchBudget budget;
  const auto take = [&](unsigned surface, std::size_t cells) {
    bool within = true;
    budget.spend(surface, counts, [&] { counts.cells += cells, within = counts.cells <= counts.limit; });
    return within;
  };
  budget.start();
  CHECK(take(3, SearchBudget::cells_per_surface - 1));
  CHECK(take(8, SearchBudget::cells_per_surface));
  CHECK(take(3, 1));
  CHECK(!take(3, 1));
  CHECK(!take(8, 1));
  budget.start();
  CHECK(take(3, 1));
  CHECK(counts.limit == SearchCounts{}.limit);
}

// The ray passes singular corners of all four, 10^-13 outside, which takes some 31,000 cells each, and meets
// the wall head-on. When all searches of a ray had 2^15 together, it went through.
TEST_CASE("A ray that passes singular corners meets what is behind", "[hits]") {
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 1.0, glm::normalize(dvec3(1.0, 2.0, 3.0)));
  const Surface hemispheres =
      mapped(build_family(R"({"type": "sphere_tiling", "topology": "hemispheres"})"), turn);
  const Surface wall = build_family(R"({"type": "sphere_tiling", "topology": "cube"})");
  const Ray ray{{1.760177816880578, -0.65513859013534537, 1.213493914561258},
                {-0.57558558737156029, -0.0082529570281268498, -0.81769989623970729}};
  for (const Solver solver : {Solver::newton, Solver::clipping}) {
    std::vector<TracedSurface> surfaces;
    for (int k = 0; k < 4; ++k)
      surfaces.push_back({placed(hemispheres, 1.0, 2.5 * k * ray.direction), solver});
    surfaces.push_back({placed(wall, 3.0, 14.0 * ray.direction), Solver::clipping});
    const Tracer tracer(surfaces);
    const std::size_t given_up = thread_counts().search.exhausted, cells = thread_counts().search.cells;
    CHECK(tracer.all(ray).size() == 2);
    CHECK(tracer.closest(ray).surface == 4);
    CHECK(tracer.occluded(ray));
    CHECK(thread_counts().search.exhausted == given_up);
    CHECK(thread_counts().search.cells - cells > SearchBudget::cells_per_surface);
  }
}
