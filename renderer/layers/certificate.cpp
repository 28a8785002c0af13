#include "renderer/intersect/certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/bezier/epsilon.h"
#include "renderer/layers/certificate.h"
#include "renderer/layers/layers.h"

namespace rondure {
namespace {

constexpr const char* type_name = "certificate";

// From 1, so that a pixel that nobody looked at is no proof.
double code_of(Means means) { return 1.0 + static_cast<int>(means); }

// The film holds floats; a bound stays one.
double rounded_up(double bound) {
  const float nearest = static_cast<float>(bound);
  return nearest < bound ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

void certificate(const World& world, const Ray& ray, const Hit& hit, double* values) {
  const Certificate c = world.certifier().certify(ray, hit);
  const auto bound = [&](double error) { return !c ? infinity : hit ? rounded_up(error) : 0.0; };
  values[0] = code_of(c.means);
  values[1] = c.exists, values[2] = c.unique, values[3] = c.first;
  values[4] = bound(c.t_error), values[5] = bound(c.point_error);
  values[6] = static_cast<double>(c.pieces);
}

}  // namespace

std::optional<std::size_t> unresolved_pixels(const Film& film, const std::vector<FilmLayer>& layers) {
  std::size_t plane = 0;
  for (const FilmLayer& layer : layers) {
    if (layer.type == type_name) {
      const std::vector<float>& means = film.layers[plane].values;
      const auto resolved = std::count_if(means.begin(), means.end(), [](float code) {
        return code >= code_of(Means::interval) && code < code_of(Means::unresolved);
      });
      return means.size() - static_cast<std::size_t>(resolved);
    }
    plane += layer.channels.size();
  }
  return {};
}

void register_certificate_layer(Registry& registry) {
  registry.add(LayerFactory{
      type_name,
      "What interval arithmetic on the nets alone proves of the hit, or of there being none: by which means "
      "(1 "
      "interval, 2 extended precision, 3 on a patch's boundary, 4 unresolved), whether the root exists, is "
      "the only one near (u, v) and is the ray's first; bounds on the errors of t and of the point; pieces "
      "of patches looked at.",
      "Certificate",
      {"means", "exists", "unique", "first", "t_error", "point_error", "pieces"},
      {},
      [](Params&) { return LayerFunction(certificate); },
      {"1 interval, 2 extended, 3 boundary, 4 unresolved", "", "", "", "in t", "scene units", ""},
      {{1.0, 4.0}, {}, {}, {}, {1e-18, 1e-8, true}, {1e-18, 1e-8, true}, {1.0, 1e4, true}},
      true});
}

}  // namespace rondure
