// Speed against what people settle for, in one table: every row takes its turn in every round, and is told as
// a ratio to Embree's own sphere in the same round. Then Newton steps, radial forms, what proofs cost, and
// how fast scenes are built.
//
//   rondure_bench [ROUNDS] [--json FILE]
//   rondure_bench [ROUNDS] --rows TEXT     the references, and the rows with that in their names, alone
//   rondure_bench [ROUNDS] --scale COUNT   scenes of up to so many objects alone
//   rondure_bench --count ROW              traces that row's incoherent rays once, for
//                                          tests/bench/count_instructions

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/intersect/solve_leaf.h"
#include "renderer/intersect/tracer.h"
#include "tests/bench/certificates.h"
#include "tests/bench/embree_baselines.h"
#include "tests/bench/newton.h"
#include "tests/bench/radial.h"
#include "tests/bench/ray_sets.h"
#include "tests/bench/rows.h"
#include "tests/bench/scale.h"
#include "tests/bench/stopwatch.h"
#include "tests/surfaces/build_family.h"

namespace rondure::bench {

// Named so that an instruction counter can find it.
[[gnu::noinline]] std::size_t counted_rays(const Row& row, const std::vector<Ray>& rays) {
  return row.trace(rays);
}

namespace {

using TracerPointer = std::shared_ptr<const Tracer>;

TracerPointer tracer_of(Surface surface, Solver solver) {
  std::vector<TracedSurface> surfaces;
  surfaces.push_back({std::move(surface), solver});
  return std::make_shared<const Tracer>(std::move(surfaces));
}

std::size_t trace_spans(const Tracer& tracer, const std::vector<Ray>& rays, std::size_t width) {
  std::size_t hits = 0;
  Hit packet[16];
  for (std::size_t first = 0; first < rays.size(); first += width) {
    const std::size_t count = std::min(width, rays.size() - first);
    tracer.closest(std::span(rays).subspan(first, count), std::span(packet, count));
    for (std::size_t k = 0; k < count; ++k) hits += static_cast<bool>(packet[k]);
  }
  return hits;
}

Row row_of(const std::string& name, TracerPointer tracer, int width, std::size_t part = 1) {
  Row row{name, width, {}, 0.0, tracer->statistics().bytes, part};
  for (const Ray& ray : incoherent_rays(20'000))
    if (const Hit hit = tracer->closest(ray))
      row.error = std::max(row.error, std::fabs(glm::length(hit.point) - 1.0));
  if (width > 1)
    row.trace = [tracer, width](const std::vector<Ray>& rays) {
      return trace_spans(*tracer, rays, static_cast<std::size_t>(width));
    };
  else
    row.trace = [tracer](const std::vector<Ray>& rays) {
      std::size_t hits = 0;
      for (const Ray& ray : rays) hits += static_cast<bool>(tracer->closest(ray));
      return hits;
    };
  return row;
}

Row occlusion_row(const std::string& name, TracerPointer tracer) {
  Row row{name, 1, {}, 0.0, tracer->statistics().bytes};
  row.trace = [tracer](const std::vector<Ray>& rays) {
    std::size_t hits = 0;
    for (const Ray& ray : rays) hits += tracer->occluded(ray);
    return hits;
  };
  return row;
}

void add_baseline(std::vector<Row>& rows, const std::string& name, EmbreeBaseline::Kind kind,
                  std::size_t triangles = 0) {
  const auto baseline = std::make_shared<const EmbreeBaseline>(kind, triangles);
  Row row{name, 1, [baseline](const std::vector<Ray>& rays) { return baseline->trace(rays); }, 0.0,
          baseline->bytes()};
  baseline->trace(incoherent_rays(20'000), &row.error);
  rows.push_back(row);
  row.width = 16;
  row.trace = [baseline](const std::vector<Ray>& rays) { return baseline->trace_packets(rays); };
  rows.push_back(row);
}

struct Shapes {
  Surface sphere = build_family(R"({"type": "sphere"})");
  Surface cube = build_family(R"({"type": "sphere_tiling", "topology": "cube"})");
  Surface hemispheres = build_family(R"({"type": "sphere_tiling", "topology": "hemispheres"})");
  Surface octants = build_family(R"({"type": "sphere_octant"})");
  Surface kites = build_family(R"({"type": "sphere_tiling", "topology": "icosahedron_quads"})");
};

// All, or the one that is called `only` (as NAME/WIDTH).
std::vector<Row> rondure_rows(const Shapes& shapes, const std::string& only = {}) {
  struct Case {
    const char* name;
    const Surface* surface;
    Solver solver;
    std::vector<int> widths;
    std::size_t part = 1;
  };
  const Case cases[] = {{"sphere", &shapes.sphere, Solver::newton, {1, 16}},
                        {"cube, quadric", &shapes.cube, Solver::quadric, {1, 4, 8, 16}},
                        {"hemispheres, quadric", &shapes.hemispheres, Solver::quadric, {1, 16}},
                        {"octants, quadric", &shapes.octants, Solver::quadric, {1, 16}},
                        {"60 kites, quadric", &shapes.kites, Solver::quadric, {1, 16}},
                        {"cube, newton", &shapes.cube, Solver::newton, {1, 16}, 4},
                        {"hemispheres, newton", &shapes.hemispheres, Solver::newton, {1, 16}, 4},
                        {"octants, newton", &shapes.octants, Solver::newton, {1, 16}, 4},
                        {"cube, clipping", &shapes.cube, Solver::clipping, {1}, 8}};
  std::vector<Row> rows;
  for (const Case& c : cases) {
    TracerPointer tracer;
    for (const int width : c.widths) {
      if (!only.empty() && only != fmt::format("{}/{}", c.name, width)) continue;
      if (!tracer) tracer = tracer_of(*c.surface, c.solver);
      rows.push_back(row_of(c.name, tracer, width, c.part));
    }
  }
  if (only.empty())
    rows.push_back(occlusion_row("cube, quadric, occluded", tracer_of(shapes.cube, Solver::quadric)));
  return rows;
}

void print_counts(const char* name, const Tracer& tracer, const std::vector<Ray>& rays) {
  thread_counts() = {};
  for (const Ray& ray : rays) tracer.closest(ray);
  const SolverCounts& counts = thread_counts();
  const double n = static_cast<double>(rays.size());
  fmt::print(
      "  {:<24} {:>8.2f} {:>8.2f} {:>8.2f} {:>12.3f} {:>8.2f}\n", name,
      static_cast<double>(counts.newton.leaves) / n, static_cast<double>(counts.newton.steps) / n,
      static_cast<double>(counts.newton.steps) / std::max(1.0, static_cast<double>(counts.newton.iterated)),
      static_cast<double>(counts.newton.undecided) / n, static_cast<double>(counts.search.cells) / n);
}

void print_steps(const Shapes& shapes) {
  const std::vector<Ray> rays = incoherent_rays(40'000);
  fmt::print("\nper incoherent ray           leaves    steps  steps/it.   undecided    cells\n");
  print_counts("cube, newton", *tracer_of(shapes.cube, Solver::newton), rays);
  print_counts("hemispheres, newton", *tracer_of(shapes.hemispheres, Solver::newton), rays);
  print_counts("octants, newton", *tracer_of(shapes.octants, Solver::newton), rays);
  print_counts("cube, clipping", *tracer_of(shapes.cube, Solver::clipping), rays);
  print_counts("octants, quadric", *tracer_of(shapes.octants, Solver::quadric), rays);
}

int count(const std::string& name) {
  const Shapes shapes;
  for (const Row& row : rondure_rows(shapes, name)) {
    const std::vector<Ray> rays = incoherent_rays(2000);
    const std::size_t hits = counted_rays(row, rays);
    fmt::print("{} rays, {} hits\n", rays.size(), hits);
    return 0;
  }
  fmt::print(stderr, "no row {}\n", name);
  return 1;
}

constexpr const char* usage =
    "usage: rondure_bench [ROUNDS] [--json FILE | --rows TEXT | --scale COUNT], or rondure_bench --count "
    "ROW\n";

// A positive number, or 0.
int number_in(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() ? std::max(number, 0) : 0;
}

int run(const std::vector<std::string>& arguments) {
  int rounds = 7;
  std::string option, value;
  std::size_t k = 0;
  if (k < arguments.size() && number_in(arguments[k]) > 0) rounds = number_in(arguments[k++]);
  if (k + 1 < arguments.size()) option = arguments[k], value = arguments[k + 1], k += 2;
  const bool known = option.empty() || option == "--json" || option == "--rows" || option == "--count" ||
                     option == "--scale";
  if (k < arguments.size() || !known || (option == "--scale" && number_in(value) == 0)) {
    fmt::print(stderr, usage);
    return 1;
  }
  if (option == "--count") return count(value);
  if (option == "--scale") return print_scale(rounds, number_in(value)), 0;
  const Shapes shapes;
  const References references{"Embree SPHERE_POINT", "Embree SPHERE_POINT"};
  std::vector<Row> rows;
  add_baseline(rows, references.single, EmbreeBaseline::Kind::sphere_point);
  add_baseline(rows, "Embree user sphere", EmbreeBaseline::Kind::user_sphere);
  for (const auto& [name, faces] : {std::pair{"Embree mesh, 10^4", 10'000},
                                    {"Embree mesh, 10^5", 100'000},
                                    {"Embree mesh, 10^6", 1'000'000},
                                    {"Embree mesh, 4 10^6", 4'000'000}})
    add_baseline(rows, name, EmbreeBaseline::Kind::triangle_mesh, static_cast<std::size_t>(faces));
  for (std::vector<Row>& more : std::vector<std::vector<Row>>{rondure_rows(shapes), cad_rows()})
    for (Row& row : more) rows.push_back(std::move(row));
  if (option == "--rows")
    std::erase_if(rows, [&](const Row& row) {
      return row.name != references.single && row.name.find(value) == std::string::npos;
    });
  measure(rows, references, rounds);
  print_rows(rows);
  if (option == "--rows") return 0;
  if (option == "--json") write_json(rows, value);
  print_steps(shapes);
  print_radial(rounds);
  print_newton(rounds);
  print_certificates(rounds);
  print_scale(rounds);
  return 0;
}

}  // namespace
}  // namespace rondure::bench

int main(int argc, char** argv) {
  try {
    return rondure::bench::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "rondure_bench: {}\n", error.what());
    return 1;
  }
}
