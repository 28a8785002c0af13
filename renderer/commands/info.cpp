// rondure info: what a scene holds, object by object.

#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "renderer/api/utf8.h"
#include "renderer/bezier/bounds.h"
#include "renderer/bezier/mass_properties.h"
#include "renderer/commands/commands.h"
#include "renderer/commands/csv.h"
#include "renderer/commands/info_continuity.h"
#include "renderer/commands/solver_names.h"
#include "renderer/commands/tracer_of.h"
#include "renderer/scene/scene_reader.h"

namespace rondure {
namespace {

using Json = nlohmann::ordered_json;

std::string kind_of(const Net& net) {
  if (const auto* tensor = std::get_if<TensorNet>(&net))
    return fmt::format("tensor ({}, {})", tensor->m, tensor->n);
  return fmt::format("triangle {}", std::get<TriangleNet>(net).n);
}

Json vector_of(const dvec3& p) { return {p.x, p.y, p.z}; }

// A number that may be unknown: then null.
Json number_or_null(double value, double error) { return std::isfinite(error) ? Json(value) : Json(nullptr); }

Json body_of(const Body& body, const char* what, const dvec3& origin) {
  Json out = {{"of", what}, {"centroid", nullptr}, {"inertia", nullptr}};
  if (std::isfinite(body.centroid_error)) out["centroid"] = vector_of(body.centroid + origin);
  out["centroid_error"] = number_or_null(body.centroid_error, body.centroid_error);
  if (std::isfinite(body.inertia_error)) {
    out["inertia"] = Json::array();
    for (int k = 0; k < 3; ++k) out["inertia"].push_back(vector_of(body.inertia[k]));
  }
  out["inertia_error"] = number_or_null(body.inertia_error, body.inertia_error);
  return out;
}

void add_mass(Json& out, const Surface& surface) {
  const MassProperties mass = mass_properties(surface);
  const auto add = [&](const char* name, const Body& body) {
    out[name] = number_or_null(body.measure, body.measure_error);
    out[std::string(name) + "_error"] = number_or_null(body.measure_error, body.measure_error);
  };
  add("area", mass.shell);
  if (mass.solid) {
    add("volume", *mass.solid);
  } else {
    out["volume"] = nullptr;
    out["why_no_volume"] = mass.leaks ? "the normals of its patches do not add up to zero: it is not closed"
                                      : "volume needs a closed surface";
  }
  out["body"] = mass.solid ? body_of(*mass.solid, "solid", surface.origin)
                           : body_of(mass.shell, "shell", surface.origin);
}

Json describe_object(const SceneObject& object, const InfoCommand& options) {
  const Surface& surface = object.traced.surface;
  std::map<std::string, int> kinds;
  Box box;
  double low = INFINITY, high = -INFINITY;
  for (const Net& net : surface.patches) {
    ++kinds[kind_of(net)];
    if (const auto bounds = bounds_of(net)) box.add(*bounds);
    for (const dvec4& p : points_of(net)) low = std::fmin(low, p.w), high = std::fmax(high, p.w);
  }
  Json out = {{"name", object.name}, {"type", object.type}, {"closed", surface.closed}};
  out["solver"] = solver_name(object.traced);
  out["patches"] = surface.patches.size();
  if (surface.ellipsoid) {
    const dmat3& m = *surface.ellipsoid;
    dvec3 half(0.0);
    for (int k = 0; k < 3; ++k) half[k] = glm::length(dvec3(m[0][k], m[1][k], m[2][k]));
    box.add(Box{-half, half});
  } else {
    for (const auto& [kind, count] : kinds) out["degrees"][kind] = count;
    out["weights"] = {low, high};
  }
  if (!box.empty())
    out["bounds"] = {{"low", vector_of(box.low + surface.origin)},
                     {"high", vector_of(box.high + surface.origin)}};
  for (const Note& note : surface.notes)
    out["notes"][note.name] = {{"value", note.value}, {"meaning", note.meaning}};
  if (!options.no_mass) add_mass(out, surface);
  if (!options.no_continuity) add_continuity(out, surface, options.certify);
  return out;
}

std::string measured(const Json& value, const Json& error) {
  if (value.is_null()) return "not known";
  return fmt::format("{:.16g} +- {:.1e}", value.get<double>(), error.get<double>());
}

// Coordinates below the error are shown as 0.
std::string vector_text(const Json& v, const Json& error) {
  const auto shown = [&](std::size_t k) {
    const double x = v[k].get<double>();
    return std::abs(x) <= error.get<double>() ? 0.0 : x;
  };
  return fmt::format("({:.12g}, {:.12g}, {:.12g})", shown(0), shown(1), shown(2));
}

std::string mass_text(const Json& object) {
  std::string out = fmt::format("    area {}, ", measured(object["area"], object["area_error"]));
  if (object.contains("why_no_volume")) {
    out += fmt::format("no volume: {}\n", object["why_no_volume"].get<std::string>());
  } else {
    out += fmt::format("volume {}{}\n", measured(object["volume"], object["volume_error"]),
                       object["volume"].is_number() && object["volume"].get<double>() < 0.0
                           ? " (normals point inward)"
                           : "");
  }
  const Json& body = object["body"];
  const std::string of = body["of"].get<std::string>();
  if (!body["centroid"].is_null()) {
    out += fmt::format("    {}: centroid {} +- {:.1e}\n", of,
                       vector_text(body["centroid"], body["centroid_error"]),
                       body["centroid_error"].get<double>());
  }
  if (!body["inertia"].is_null()) {
    const Json &rows = body["inertia"], &error = body["inertia_error"];
    out += fmt::format("    {}: inertia about its centroid, density 1: {} {} {} +- {:.1e}\n", of,
                       vector_text(rows[0], error), vector_text(rows[1], error), vector_text(rows[2], error),
                       error.get<double>());
  }
  return out;
}

std::string as_text(const Json& info) {
  std::string out = fmt::format("{}\n", info["scene"].get<std::string>());
  for (const Json& object : info["objects"]) {
    out += fmt::format("  {}: {}, {}, solver {}\n", printable(object["name"].get<std::string>(), 1000),
                       object["type"].get<std::string>(), object["closed"].get<bool>() ? "closed" : "open",
                       object["solver"].get<std::string>());
    if (object.contains("degrees")) {
      for (const auto& [kind, count] : object["degrees"].items())
        out += fmt::format("    {} patches, {}\n", count.get<int>(), kind);
      out += fmt::format("    weights from {:.6g} to {:.6g}\n", object["weights"][0].get<double>(),
                         object["weights"][1].get<double>());
    }
    if (object.contains("bounds")) {
      const Json &a = object["bounds"]["low"], &b = object["bounds"]["high"];
      out += fmt::format("    within ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})\n",
                         a[0].get<double>(), a[1].get<double>(), a[2].get<double>(), b[0].get<double>(),
                         b[1].get<double>(), b[2].get<double>());
    }
    if (object.contains("notes")) {
      for (const auto& [name, note] : object["notes"].items())
        out += fmt::format("    {} {:.6g}: {}\n", name, note["value"].get<double>(),
                           note["meaning"].get<std::string>());
    }
    if (object.contains("area")) out += mass_text(object);
    out += continuity_text(object);
  }
  const Json& total = info["total"];
  out += fmt::format("  {} objects, {} patches, {} leaves, {:.1f} kB\n", total["objects"].get<std::size_t>(),
                     total["patches"].get<std::size_t>(), total["leaves"].get<std::size_t>(),
                     total["bytes"].get<double>() / 1e3);
  return out + fmt::format("  {} materials, {} lights, integrator {}, {} samples a pixel\n",
                           info["materials"].get<std::size_t>(), info["lights"].get<std::size_t>(),
                           info["integrator"].get<std::string>(), info["spp"].get<int>());
}

}  // namespace

void run_info(const Registry& registry, const InfoCommand& options) {
  Scene scene = read_scene(options.scene.path, registry, options.scene.overrides);
  Json info = {{"scene", scene.path}, {"hash", fmt::format("{:016x}", scene.hash)}};
  info["objects"] = Json::array();
  for (const SceneObject& object : scene.objects) {
    info["objects"].push_back(describe_object(object, options));
  }
  info["materials"] = scene.materials.size();
  info["lights"] = scene.lights.size();
  info["integrator"] = scene.integrator_name;
  info["spp"] = scene.sampling.spp;
  const Tracer tracer = tracer_of(scene);
  const TracerStatistics statistics = tracer.statistics();
  info["total"] = {{"objects", statistics.surfaces},
                   {"patches", statistics.patches},
                   {"leaves", statistics.leaves},
                   {"bytes", statistics.bytes}};
  TextOutput output("-");
  // A path need not be UTF-8; what is not is replaced, since JSON text must be.
  output.write(options.json ? info.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"
                            : as_text(info));
  output.finish();
}

}  // namespace rondure
