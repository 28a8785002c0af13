// rondure trace: rays in, hits out, as tables.

#include <fmt/format.h>

#include <cmath>

#include "renderer/commands/commands.h"
#include "renderer/commands/csv.h"
#include "renderer/commands/distinct_paths.h"
#include "renderer/commands/tracer_of.h"
#include "renderer/intersect/certificate.h"
#include "renderer/parallel/parallel_for.h"
#include "renderer/scene/scene_reader.h"

namespace rondure {
namespace {

constexpr std::size_t block = 1 << 14;     // rays that are traced together and then written in order
constexpr double farthest_origin = 1e297;  // with it set_base() finds the way to any scene

Ray read_ray(const CsvReader& reader, const std::vector<double>& row, std::size_t present) {
  for (std::size_t k = 0; k < 6; ++k)
    if (!std::isfinite(row[k])) reader.fail(k, "origin and direction must be finite");
  for (std::size_t k = 0; k < 3; ++k)
    if (std::fabs(row[k]) > farthest_origin)
      reader.fail(k, fmt::format("a ray from beyond {:.0e} cannot be followed", farthest_origin));
  Ray ray;
  ray.origin = {row[0], row[1], row[2]};
  ray.direction = {row[3], row[4], row[5]};
  if (ray.direction == dvec3(0.0)) reader.fail(3, "the direction is zero");
  if (present > 6) ray.t_min = row[6];
  if (present > 7) ray.t_max = row[7];
  return ray;
}

// Of the closest hit, or of a miss: proven or not, in columns after those of the hit.
void append_certificate(std::string& line, const Hit& hit, const Certificate& c) {
  line.pop_back();
  fmt::format_to(std::back_inserter(line), ",{},{},{},{}", name_of(c.means), int{c.exists}, int{c.unique},
                 int{c.first});
  if (hit && c)
    fmt::format_to(std::back_inserter(line), ",{:.17g},{:.17g}\n", c.t_error, c.point_error);
  else
    line += ",,\n";
}

void append_hit(std::string& out, std::size_t ray, const Hit& hit) {
  if (!hit) {
    fmt::format_to(std::back_inserter(out), "{},0,,,,,,,,,,,\n", ray);
    return;
  }
  fmt::format_to(std::back_inserter(out),
                 "{},1,{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{},{},{:.17g},{:.17g}\n", ray,
                 hit.t, hit.point.x, hit.point.y, hit.point.z, hit.normal.x, hit.normal.y, hit.normal.z,
                 hit.surface, hit.patch, hit.u, hit.v);
}

}  // namespace

void run_trace(const Registry& registry, const TraceCommand& options) {
  Scene scene = read_scene(options.scene.path, registry, options.scene.overrides);
  refuse_table_over_input(scene, options.rays, options.output);
  const Tracer tracer = tracer_of(scene);
  CsvReader reader(options.rays, {"ox", "oy", "oz", "dx", "dy", "dz", "tmin", "tmax"}, 6);
  TextOutput output(options.output);
  output.write("ray,hit,t,x,y,z,nx,ny,nz,surface,patch,u,v");
  output.write(options.certify ? ",means,exists,unique,first,t_error,point_error\n" : "\n");
  const Certifier certifier(tracer);

  std::vector<Ray> rays;
  std::vector<std::string> lines;
  std::vector<double> row;
  std::size_t present = 0, first = 0;
  for (bool more = true; more;) {
    rays.clear();
    while (rays.size() < block && (more = reader.next(row, present)))
      rays.push_back(read_ray(reader, row, present));
    lines.assign(rays.size(), {});
    parallel_for(rays.size(), [&](std::size_t k) {
      if (!options.all) {
        const Hit hit = tracer.closest(rays[k]);
        append_hit(lines[k], first + k, hit);
        if (options.certify) append_certificate(lines[k], hit, certifier.certify(rays[k], hit));
        return;
      }
      const std::vector<Hit> hits = tracer.all(rays[k]);
      if (hits.empty()) append_hit(lines[k], first + k, {});
      for (const Hit& hit : hits) append_hit(lines[k], first + k, hit);
    });
    for (const std::string& line : lines) output.write(line);
    first += rays.size();
  }
  output.finish();
}

}  // namespace rondure
