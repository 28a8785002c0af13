// rondure eval: position, derivatives, normal and curvature at given parameters of a scene's patches, or the
// point in a given direction.

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "renderer/bezier/rational.h"
#include "renderer/commands/commands.h"
#include "renderer/commands/csv.h"
#include "renderer/commands/distinct_paths.h"
#include "renderer/commands/eval_direction.h"
#include "renderer/scene/scene_reader.h"

namespace rondure {
namespace {

// "nan", whatever its sign, is no number: of a curvature where there is none.
void append(std::string& out, double x) { out += std::isnan(x) ? ",nan" : fmt::format(",{:.17g}", x); }
void append(std::string& out, const dvec3& p) {
  for (int k = 0; k < 3; ++k) append(out, p[k]);
}

}  // namespace

void run_eval(const Registry& registry, const EvalCommand& options) {
  if (options.at.empty() == options.directions.empty())
    throw std::runtime_error("one of --at and --direction is required; see rondure eval --help");
  const Scene scene = read_scene(options.scene.path, registry, options.scene.overrides);
  refuse_table_over_input(scene, options.directions.empty() ? options.at : options.directions,
                          options.output);
  if (!options.directions.empty()) return eval_directions(scene, options.directions, options.output);
  CsvReader reader(options.at, {"surface", "patch", "u", "v"}, 4);
  TextOutput output(options.output);
  output.write(
      "surface,patch,u,v,x,y,z,xu,yu,zu,xv,yv,zv,xuu,yuu,zuu,xuv,yuv,zuv,xvv,yvv,zvv,nx,ny,nz,gaussian,"
      "mean\n");
  std::vector<double> row;
  std::size_t present = 0;
  while (reader.next(row, present)) {
    const std::size_t object = reader.index(row, 0, scene.objects.size(), "surface");
    const Surface& surface = scene.objects[object].traced.surface;
    if (surface.patches.empty())
      reader.fail(0, fmt::format("surface {} ({}) is analytic: it has no patches to evaluate", object,
                                 scene.objects[object].type));
    const std::size_t patch = reader.index(row, 1, surface.patches.size(), "patch");
    const Net& net = surface.patches[patch];
    const double u = row[2], v = row[3];
    const bool triangle = std::holds_alternative<TriangleNet>(net);
    for (std::size_t k = 2; k < 4; ++k)
      if (!(row[k] >= 0.0 && row[k] <= 1.0)) reader.fail(k, "parameters lie in [0, 1]");
    if (triangle && u + v > 1.0) reader.fail(2, "on a triangle u + v must not be above 1");
    const SurfaceJet jet = surface_jet(net, u, v);
    const Curvature bend = curvature(net, u, v);
    std::string line = fmt::format("{},{},{:.17g},{:.17g}", object, patch, u, v);
    append(line, surface.origin + jet.point);
    for (const dvec3& d : {jet.du, jet.dv, jet.duu, jet.duv, jet.dvv}) append(line, d);
    append(line, unit_normal(net, u, v));
    append(line, bend.gaussian);
    append(line, bend.mean);
    output.write(line + "\n");
  }
  output.finish();
}

}  // namespace rondure
