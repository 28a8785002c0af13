// One channel of a film layer as a colour: a number a pixel to look at.

#include <algorithm>
#include <cmath>

#include "integrators/integrators.h"
#include "renderer/film/layer_reader.h"
#include "renderer/scene/unknown_name.h"
#include "renderer/shading/color_map.h"

namespace rondure {
namespace {

struct ColorScale {
  dvec2 range{0.0, 1.0};
  bool logarithmic = false;
  std::string map;

  // In [0, 1] where the value is in the range; NaN goes to the low end with what is below.
  double place(double value) const {
    if (!(value > range.x)) return 0.0;
    if (value >= range.y) return 1.0;
    if (!logarithmic) return (value - range.x) / (range.y - range.x);
    return std::log(value / range.x) / std::log(range.y / range.x);
  }
};

class Study : public Integrator {
 public:
  Study(FilmLayer layer, std::size_t channel, ColorScale scale)
      : layer_(std::move(layer)), channel_(channel), scale_(std::move(scale)) {}

  dvec3 radiance(const World& world, const Ray& ray, const Hit& first, Sampler&) const override {
    if (!first && !layer_.misses) return dvec3(0.0);
    std::vector<double> values(layer_.channels.size(), 0.0);
    layer_.function(world, ray, first, values.data());
    return mapped_color(scale_.map, scale_.place(values[channel_]));
  }

  std::optional<Legend> legend() const override {
    Legend legend;
    legend.title = layer_.channels[channel_];
    if (!layer_.units[channel_].empty()) legend.title += " (" + layer_.units[channel_] + ")";
    legend.low = scale_.range.x, legend.high = scale_.range.y;
    legend.logarithmic = scale_.logarithmic;
    for (int k = 0; k < 256; ++k) legend.colors.push_back(mapped_color(scale_.map, k / 255.0));
    return legend;
  }

 private:
  FilmLayer layer_;
  std::size_t channel_;
  ColorScale scale_;
};

std::size_t read_channel(Params& params, const FilmLayer& layer) {
  std::vector<std::string> names;
  for (const std::string& channel : layer.channels) names.push_back(channel.substr(channel.find('.') + 1));
  const std::string name = params.text("channel", names.front());
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) params.fail("channel", unknown_name("channel", name, names));
  return static_cast<std::size_t>(found - names.begin());
}

// `own`: what the channel has itself, where the scene gives neither range nor scale.
ColorScale read_scale(Params& params, const LayerScale& own) {
  ColorScale scale;
  const bool given = params.raw("range") || params.raw("scale");
  if (!given) scale.range = {own.low, own.high};
  const bool log = params.choice("scale", {"linear", "log"}, "linear") == "log";
  scale.logarithmic = given ? log : own.logarithmic;
  scale.range = params.vec2("range", scale.range);
  if (!(scale.range.x < scale.range.y)) params.fail("range", "\"range\" must be [low, high] with low < high");
  if (scale.logarithmic && !(scale.range.x > 0.0))
    params.fail("scale", "\"log\" needs a \"range\" of positive numbers");
  // What the places of colours and of the legend's ticks are parts of.
  const double width = scale.logarithmic ? scale.range.y / scale.range.x : scale.range.y - scale.range.x;
  if (!std::isfinite(width)) params.fail("range", "\"range\" is too wide for a double's exponent");
  scale.map = params.choice("colors", {"viridis", "diverging", "grey"}, "viridis");
  return scale;
}

std::unique_ptr<Integrator> create_study(Params& params) {
  if (!params.registry()) params.fail("no layer can be named here");
  Value fallback;
  fallback.kind = Value::Kind::string;
  fallback.string = "normal_error";
  const Value* value = params.raw("layer");
  FilmLayer layer = read_layer(value ? *value : fallback, params, "layer", *params.registry());
  const std::size_t channel = read_channel(params, layer);
  const ColorScale scale = read_scale(params, layer.scales[channel]);
  return std::make_unique<Study>(std::move(layer), channel, scale);
}

}  // namespace

void register_study(Registry& registry) {
  registry.add(IntegratorFactory{
      "study",
      "One channel of a layer as a colour, with a legend below the preview; black where nothing is hit, "
      "unless "
      "the layer tells of that too.",
      {{"layer", "name, or object {\"type\", ...}", "\"normal_error\"", "see rondure list"},
       {"channel", "name", "the layer's first", "which of its numbers: what its channel's name ends in"},
       {"range", "two numbers, low < high", "the channel's own, mostly [0, 1]",
        "what the ends of the colours stand for; beyond them they stay; [0, 1] where only \"scale\" is "
        "given"},
       {"scale", "\"linear\" or \"log\"", "the channel's own, mostly \"linear\"",
        "how the colours are spread over the range; \"linear\" where only \"range\" is given"},
       {"colors", "\"viridis\", \"diverging\" or \"grey\"", "\"viridis\"",
        "dark blue to yellow, blue over white to red, black to white"}},
      create_study});
}

}  // namespace rondure
