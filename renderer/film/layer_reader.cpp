#include "renderer/film/layer_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/api/utf8.h"
#include "renderer/film/exr.h"
#include "renderer/plugin/call_plugin.h"
#include "renderer/scene/unknown_name.h"

namespace rondure {
namespace {

bool is_group(const std::string& name) {
  const auto plain = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), plain);
}

// The name alone stands for an object with nothing but that "type".
Value as_object(const Value& value) {
  if (value.kind != Value::Kind::string) return value;
  Value object;
  object.kind = Value::Kind::object;
  object.where = value.where;
  object.members.push_back({"type", value.where, value});
  return object;
}

}  // namespace

FilmLayer read_layer(const Value& value, const Params& parent, const std::string& what,
                     const Registry& registry) {
  if (value.kind != Value::Kind::string && value.kind != Value::Kind::object)
    parent.fail(value,
                fmt::format("{} must be a layer's name or an object, {{ \"type\": name, ... }}", what));
  const Value object = as_object(value);
  Params params(object, parent.source(), what);
  params.set_registry(registry);
  FilmLayer layer;
  layer.type = params.text("type");
  const LayerFactory* factory = registry.layer(layer.type);
  if (!factory) params.fail("type", unknown_name("layer", layer.type, registry.layer_names()));
  const std::string group = params.text("as", factory->group);
  if (!is_group(group))
    params.fail(
        "as",
        "\"as\" must be a name of letters, digits and underscores, which the layer's channels begin with");
  for (const std::string& channel : factory->channels) layer.channels.push_back(group + "." + channel);
  const std::string who = fmt::format("the layer \"{}\"", layer.type);
  layer.function = call_plugin(params, who, [&] { return factory->create(params); });
  if (!layer.function) params.fail(who + " made nothing");
  layer.units = factory->units;
  layer.units.resize(layer.channels.size());
  layer.scales = factory->scales;
  layer.scales.resize(layer.channels.size());
  layer.misses = factory->misses;
  params.finish();
  return layer;
}

std::vector<FilmLayer> read_layers(Params& film) {
  const Value* list = film.raw("layers");
  if (!list) return {};
  if (list->kind != Value::Kind::array)
    film.fail(*list,
              "\"layers\" must be an array of layers, each a name or an object, { \"type\": name, ... }");
  if (!film.registry()) film.fail(*list, "no layer can be named here");
  std::vector<FilmLayer> layers;
  std::vector<std::string> taken = standard_channels();
  for (std::size_t k = 0; k < list->items.size(); ++k) {
    const std::string what = fmt::format("layers[{}]", k);
    FilmLayer layer = read_layer(list->items[k], film, what, *film.registry());
    for (const std::string& channel : layer.channels) {
      if (std::find(taken.begin(), taken.end(), channel) != taken.end())
        film.fail(list->items[k],
                  fmt::format("{}: the film has a channel \"{}\" already; name this one's group "
                              "by \"as\"",
                              what, printable(channel)));
      taken.push_back(channel);
    }
    layers.push_back(std::move(layer));
  }
  return layers;
}

const ParameterDoc& layer_group_doc() {
  static const ParameterDoc doc = {"as", "string of letters, digits and _", "the type's own",
                                   "what the names of the layer's channels begin with"};
  return doc;
}

}  // namespace rondure
