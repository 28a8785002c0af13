#include "renderer/scene/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "renderer/api/utf8.h"
#include "renderer/scene/json_reader.h"
#include "renderer/scene/text_file.h"

namespace rondure {
namespace {

[[noreturn]] void refuse(const std::string& text) { throw SceneError(nullptr, {}, text); }

void forget_places(Value& value) {
  value.where = {};
  for (Value& item : value.items) forget_places(item);
  for (Value::Member& member : value.members) {
    member.where = {};
    forget_places(member.value);
  }
}

// A value that begins like an object, an array or a string in quotes is one, or an error.
Value parsed_or_string(const std::string& text) {
  Value value;
  if (text.find_first_of("{[\"") == 0) {
    value = read_json_text("--set", text).root;
    forget_places(value);
    return value;
  }
  try {
    value = read_json_text("--set", text).root;
  } catch (const SceneError&) {
    value = Value{};
    value.kind = Value::Kind::string;
    value.string = text;
  }
  forget_places(value);
  return value;
}

Value number(std::int64_t n) {
  Value value;
  value.kind = Value::Kind::number;
  value.number = static_cast<double>(n);
  value.integral = true;
  return value;
}

Value string(std::string text) {
  Value value;
  value.kind = Value::Kind::string;
  value.string = std::move(text);
  return value;
}

Value& member(Value& object, const std::string& key) {
  for (Value::Member& m : object.members) {
    if (m.key == key) return m.value;
  }
  object.members.push_back({key, {}, {}});
  return object.members.back().value;
}

// The keys between the slashes, "~1" and "~0" decoded.
std::vector<std::string> steps_of(const std::string& pointer) {
  std::vector<std::string> steps;
  for (std::size_t i = 0; i < pointer.size(); ++i) {
    if (pointer[i] == '/') {
      steps.emplace_back();
    } else if (pointer[i] == '~') {
      const char code = i + 1 < pointer.size() ? pointer[++i] : ' ';
      if (code != '0' && code != '1') refuse(fmt::format("--set {}: after \"~\" must stand 0 or 1", pointer));
      steps.back() += code == '0' ? '~' : '/';
    } else {
      steps.back() += pointer[i];
    }
  }
  return steps;
}

const char* kind_name(Value::Kind kind) {
  switch (kind) {
    case Value::Kind::null:
      return "null";
    case Value::Kind::boolean:
      return "a truth value";
    case Value::Kind::number:
      return "a number";
    case Value::Kind::string:
      return "a string";
    case Value::Kind::array:
      return "an array";
    case Value::Kind::object:
      return "an object";
  }
  return "";
}

Value& element(Value& array, const std::string& step, const std::string& pointer) {
  std::size_t index = 0;
  const char* end = step.data() + step.size();
  const auto [stop, error] = std::from_chars(step.data(), end, index);
  const bool plain = error == std::errc{} && stop == end && (step.size() == 1 || step[0] != '0');
  if (plain && index < array.items.size()) return array.items[index];
  refuse(fmt::format("--set {}: \"{}\" is not an element of the array, which has {}", pointer,
                     printable(step), array.items.size()));
}

void set(Value& root, const std::string& assignment) {
  refuse_bad_text({"--set", assignment});
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals < 2 || assignment[0] != '/') {
    refuse(fmt::format("--set takes /json/pointer=value, such as /sampling/spp=16, found \"{}\"",
                       printable(assignment)));
  }
  const std::string pointer = assignment.substr(0, equals);
  const std::vector<std::string> steps = steps_of(pointer);
  if (steps.size() > static_cast<std::size_t>(max_json_depth))
    refuse(fmt::format("--set {}: deeper than {} levels", printable(pointer), max_json_depth));
  Value* at = &root;
  std::string walked;
  for (const std::string& step : steps) {
    // A key that the line above has just created.
    if (at->kind == Value::Kind::null && at->where.line < 1) at->kind = Value::Kind::object;
    if (at->kind == Value::Kind::array) {
      at = &element(*at, step, pointer);
    } else if (at->kind == Value::Kind::object) {
      at = &member(*at, step);
    } else {
      refuse(fmt::format("--set {}: \"{}\" is {}, not an object", pointer, walked, kind_name(at->kind)));
    }
    walked += "/" + step;
  }
  *at = parsed_or_string(assignment.substr(equals + 1));
}

// The object under a key of the scene, made if need be. A value of another kind is left for the reader to
// refuse.
Value* section(Value& root, const std::string& key) {
  Value& value = member(root, key);
  if (value.kind == Value::Kind::null && value.where.line < 1) value.kind = Value::Kind::object;
  return value.kind == Value::Kind::object ? &value : nullptr;
}

void choose_integrator(Value& root, const std::string& name) {
  Value& value = member(root, "integrator");
  const Value* type = value.find("type");
  if (type && type->kind == Value::Kind::string && type->string == name) return;
  value = string(name);
}

void choose_layers(Value& film, const std::vector<std::string>& names) {
  Value& layers = member(film, "layers");
  Value chosen;
  chosen.kind = Value::Kind::array;
  for (const std::string& name : names) {
    bool found = false;
    for (const Value& item : layers.items) {
      const Value* type = item.kind == Value::Kind::object ? item.find("type") : &item;
      if (!type || type->kind != Value::Kind::string || type->string != name) continue;
      chosen.items.push_back(item);
      found = true;
    }
    if (!found) chosen.items.push_back(string(name));
  }
  layers = std::move(chosen);
}

}  // namespace

void apply_overrides(Value& root, const SceneOverrides& overrides) {
  if (root.kind != Value::Kind::object) return;  // the reader says so
  for (const std::string& assignment : overrides.set) set(root, assignment);
  if (overrides.spp) {
    if (Value* sampling = section(root, "sampling")) member(*sampling, "spp") = number(*overrides.spp);
  }
  if (overrides.seed) {
    if (Value* sampling = section(root, "sampling")) member(*sampling, "seed") = number(*overrides.seed);
  }
  if (overrides.resolution) {
    if (Value* film = section(root, "film")) {
      Value size;
      size.kind = Value::Kind::array;
      size.items = {number(overrides.resolution->first), number(overrides.resolution->second)};
      member(*film, "resolution") = std::move(size);
    }
  }
  if (overrides.layers) {
    if (Value* film = section(root, "film")) choose_layers(*film, *overrides.layers);
  }
  if (overrides.integrator) choose_integrator(root, *overrides.integrator);
  if (overrides.solver || overrides.normals) {
    Value& objects = member(root, "objects");
    for (Value& object : objects.items) {
      if (object.kind != Value::Kind::object) continue;
      if (overrides.solver) member(object, "solver") = string(*overrides.solver);
      if (overrides.normals) member(object, "normals") = string(*overrides.normals);
    }
    if (objects.kind == Value::Kind::null && objects.where.line < 1) {
      std::erase_if(root.members, [](const Value::Member& m) { return m.key == "objects"; });
    }
  }
}

std::string overrides_text(const SceneOverrides& overrides) {
  std::string text;
  for (const std::string& assignment : overrides.set) text += "set " + assignment + "\n";
  if (overrides.spp) text += fmt::format("spp {}\n", *overrides.spp);
  if (overrides.seed) text += fmt::format("seed {}\n", *overrides.seed);
  if (overrides.resolution) {
    text += fmt::format("resolution {} {}\n", overrides.resolution->first, overrides.resolution->second);
  }
  if (overrides.layers) {
    for (const std::string& name : *overrides.layers) text += "layer " + name + "\n";
  }
  if (overrides.integrator) text += "integrator " + *overrides.integrator + "\n";
  if (overrides.normals) text += "normals " + *overrides.normals + "\n";
  if (overrides.solver) text += "solver " + *overrides.solver + "\n";
  return text;
}

}  // namespace rondure
