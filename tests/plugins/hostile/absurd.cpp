// A plugin whose families, integrators and layers do what "as" says, and nothing of it right.
#include <array>
#include <limits>
#include <new>
#include <stdexcept>
#include <type_traits>

#include "renderer/api/registry.h"

namespace rondure {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

TensorNet square() {
  TensorNet net(1, 1);
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) net.at(i, j) = dvec4(i, j, 0, 1);
  }
  return net;
}

Surface with(TensorNet net) {
  Surface surface;
  surface.patches.emplace_back(std::move(net));
  return surface;
}

Surface build(Params& params) {
  const std::string as = params.text("as");
  TensorNet net = square();
  Surface surface;
  if (as == "empty") return surface;
  if (as == "nan") net.points[2].y = nan;
  if (as == "infinite") net.points[3].w = infinite;
  if (as == "few_points") net.points.pop_back();
  if (as == "many_points") net.points.resize(1000);
  if (as == "no_points") net.points.clear();
  if (as == "zeros") net.points.assign(4, dvec4(0.0));
  if (as == "negative_degree") net.m = -1;
  if (as == "zero_degree") net.n = 0;
  if (as == "large_degree") net = TensorNet(1000, 1);
  if (as == "huge_degree") net.m = net.n = std::numeric_limits<int>::max();
  if (as == "negative_triangle" || as == "large_triangle") {
    TriangleNet triangle;
    triangle.n = as == "large_triangle" ? 1000 : -1;
    surface.patches.emplace_back(triangle);
    return surface;
  }
  if (as == "throws") throw std::runtime_error("no licence for surfaces");
  if (as == "throws_number") throw 42;
  if (as == "no_memory") throw std::bad_alloc();
  surface = with(net);
  if (as == "both") surface.ellipsoid = dmat3(1.0);
  if (as == "nan_origin") surface.origin.z = nan;
  if (as == "join_patch") surface.joins = {{0, 1, 99'999'999, 2}};
  if (as == "join_negative") surface.joins = {{-5, 0, 0, 1}};
  if (as == "join_side") surface.joins = {{0, 77, 0, 1}};
  if (as == "join_other_side") surface.joins = {{0, 3, 0, -3}};
  if (as == "nan_guide") surface.guides["ribs"] = {{{dvec4(1.0), dvec4(nan)}, 1.0}};
  if (as == "no_guide") surface.guides["ribs"] = {{}};
  if (as == "nan_ellipsoid" || as == "flat_ellipsoid") {
    surface.patches.clear();
    surface.ellipsoid = dmat3(as == "nan_ellipsoid" ? nan : 0.0);
  }
  return surface;
}

class Absurd final : public Integrator {
 public:
  explicit Absurd(std::string as) : as_(std::move(as)) {}
  dvec3 radiance(const World&, const Ray&, const Hit&, Sampler&) const override {
    if (as_ == "throws_late") throw std::runtime_error("no licence for light");
    if (as_ == "throws_number_late") throw 42;
    return dvec3(as_ == "nan" ? nan : 1.0);
  }
  std::optional<Legend> legend() const override {
    if (as_ == "throws_legend") throw std::runtime_error("no licence for words");
    if (as_ == "throws_number_legend") throw 42;
    if (as_ == "no_colors") return Legend();
    Legend legend;
    legend.colors.assign(2, dvec3(0.5));
    if (as_ == "log_zero") legend.low = 0.0, legend.logarithmic = true;
    if (as_ == "log_negative") legend.low = -1.0, legend.logarithmic = true;
    if (as_ == "nan_scale") legend.low = nan;
    if (as_ == "empty_scale") legend.low = legend.high;
    if (as_ == "wide_scale") legend.high = infinite;
    if (as_ == "nan_color") legend.colors[1].z = nan;
    if (as_ == "bad_title") legend.title = "\x1b[2J";
    if (as_ == "long_title") legend.title.assign(10'000, 'x');
    return legend;
  }

 private:
  std::string as_;
};

std::unique_ptr<Integrator> create(Params& params) {
  std::string as = params.text("as", "well");
  if (as == "null") return nullptr;
  if (as == "throws") throw std::runtime_error("no licence for integrators");
  if (as == "throws_number") throw 42;
  return std::make_unique<Absurd>(std::move(as));
}

LayerFunction create_layer(Params& params) {
  const std::string as = params.text("does", "well");  // "as" names the channels
  if (as == "null") return nullptr;
  if (as == "throws") throw std::runtime_error("no licence for layers");
  if (as == "throws_number") throw 42;
  return [as](const World&, const Ray&, const Hit&, double* values) {
    if (as == "throws_late") throw std::runtime_error("no licence for numbers");
    if (as == "throws_number_late") throw 42;
    values[0] = as == "nan" ? nan : infinite;
  };
}

}  // namespace

void register_absurd(Registry& registry) {
  registry.add(SurfaceFamily{"absurd", "all that a surface must not be", {}, build});
  registry.add(IntegratorFactory{"absurd", "all that an integrator must not do", {}, create});
  registry.add(LayerFactory{"absurd", "all that a layer must not do", "Absurd", {"x"}, {}, create_layer});
}

}  // namespace rondure
