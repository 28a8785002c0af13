// The layers that a scene asks for beside those that every film has.
#pragma once

#include <vector>

#include "renderer/api/layer.h"
#include "renderer/api/registry.h"

namespace rondure {

// One layer: its type's name, or an object { "type": name, ... } with the type's parameters. Finishes the
// object.
FilmLayer read_layer(const Value& value, const Params& parent, const std::string& what,
                     const Registry& registry);

// The list under "layers"; empty where there is none. No two channels of a film share a name.
std::vector<FilmLayer> read_layers(Params& film);

// "as", which every layer takes.
const ParameterDoc& layer_group_doc();

}  // namespace rondure
