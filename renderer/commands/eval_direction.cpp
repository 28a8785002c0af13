#include "renderer/commands/eval_direction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "renderer/api/utf8.h"
#include "renderer/bezier/star_shaped.h"
#include "renderer/commands/csv.h"

namespace rondure {
namespace {

// One object on its own, so that nothing else is met; built when it is first asked for.
class Objects {
 public:
  explicit Objects(const Scene& scene) : scene_(scene), tracers_(scene.objects.size()) {}

  const Tracer& at(const CsvReader& reader, std::size_t index) {
    std::optional<Tracer>& tracer = tracers_[index];
    if (tracer) return *tracer;
    const SceneObject& object = scene_.objects[index];
    const std::vector<Net>& patches = object.traced.surface.patches;
    for (std::size_t k = 0; k < patches.size(); ++k) {
      const std::optional<Fold> fold = fold_seen_from_origin(patches[k]);
      if (!fold) continue;
      reader.fail(0,
                  fmt::format("surface {} ({}) is no function of the direction from its centre: patch {} {} "
                              "near (u, v) = ({:.4g}, {:.4g})",
                              index, printable(object.type), k,
                              fold->certain ? "turns back" : "cannot be shown not to turn back", fold->at.x,
                              fold->at.y));
    }
    try {
      tracer.emplace(Tracer({object.traced}));
    } catch (const SurfaceError& error) {
      scene_.fail(object.where, fmt::format("{}: {}", printable(object.name), error.reason));
    } catch (const std::runtime_error& error) {
      scene_.fail(object.where, error.what());
    }
    return *tracer;
  }

 private:
  const Scene& scene_;
  std::vector<std::optional<Tracer>> tracers_;
};

}  // namespace

void eval_directions(const Scene& scene, const std::string& table, const std::string& output_path) {
  CsvReader reader(table, {"surface", "dx", "dy", "dz"}, 4);
  TextOutput output(output_path);
  output.write("surface,dx,dy,dz,hit,radius,x,y,z,nx,ny,nz,patch,u,v\n");
  Objects objects(scene);
  std::vector<double> row;
  std::size_t present = 0;
  while (reader.next(row, present)) {
    const std::size_t index = reader.index(row, 0, scene.objects.size(), "surface");
    Ray ray;
    ray.origin = scene.objects[index].traced.surface.origin;
    ray.direction = {row[1], row[2], row[3]};
    for (std::size_t k = 1; k < 4; ++k)
      if (!std::isfinite(row[k])) reader.fail(k, "a direction must be finite");
    if (ray.direction == dvec3(0.0)) reader.fail(1, "the direction is zero");
    // Only the direction counts; of one near the end of a double's range the distance would leave it.
    const double largest = std::max({std::abs(row[1]), std::abs(row[2]), std::abs(row[3])});
    for (int k = 0; k < 3; ++k) ray.direction[k] = std::ldexp(ray.direction[k], -std::ilogb(largest));
    const std::vector<Hit> hits = objects.at(reader, index).all(ray);
    const dvec3& d = ray.direction;
    const double length = std::hypot(d.x, d.y, d.z);
    if (hits.size() > 1) {
      reader.fail(0, fmt::format("surface {} ({}) is met {} times in this direction from its centre, at the "
                                 "distances {:.6g} and {:.6g}",
                                 index, printable(scene.objects[index].type), hits.size(), hits[0].t * length,
                                 hits[1].t * length));
    }
    std::string line = fmt::format("{},{:.17g},{:.17g},{:.17g}", index, row[1], row[2], row[3]);
    if (hits.empty()) {
      line += ",0,,,,,,,,,,\n";
    } else {
      const Hit& h = hits[0];
      fmt::format_to(std::back_inserter(line),
                     ",1,{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{},{:.17g},{:.17g}\n",
                     h.t * length, h.point.x, h.point.y, h.point.z, h.normal.x, h.normal.y, h.normal.z,
                     h.patch, h.u, h.v);
    }
    output.write(line);
  }
  output.finish();
}

}  // namespace rondure
