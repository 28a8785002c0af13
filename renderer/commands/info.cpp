// rondure info: what a scene holds, object by object.

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "renderer/bezier/bounds.h"
#include "renderer/commands/commands.h"
#include "renderer/commands/csv.h"
#include "renderer/commands/scene_options.h"
#include "renderer/commands/solver_names.h"
#include "renderer/commands/tracer_of.h"
#include "renderer/scene/scene_reader.h"

namespace rondure {
namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
  SceneOptions scene;
  bool json = false;
};

std::string kind_of(const Net& net) {
  if (const auto* tensor = std::get_if<TensorNet>(&net))
    return fmt::format("tensor ({}, {})", tensor->m, tensor->n);
  return fmt::format("triangle {}", std::get<TriangleNet>(net).n);
}

Json vector_of(const dvec3& p) { return {p.x, p.y, p.z}; }

Json describe_object(const SceneObject& object) {
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
  return out;
}

std::string as_text(const Json& info) {
  std::string out = fmt::format("{}\n", info["scene"].get<std::string>());
  for (const Json& object : info["objects"]) {
    out += fmt::format("  {}: {}, {}, solver {}\n", object["name"].get<std::string>(),
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
  }
  const Json& total = info["total"];
  out += fmt::format("  {} objects, {} patches, {} leaves, {:.1f} kB\n", total["objects"].get<std::size_t>(),
                     total["patches"].get<std::size_t>(), total["leaves"].get<std::size_t>(),
                     total["bytes"].get<double>() / 1e3);
  return out + fmt::format("  {} materials, {} lights, integrator {}, {} samples a pixel\n",
                           info["materials"].get<std::size_t>(), info["lights"].get<std::size_t>(),
                           info["integrator"].get<std::string>(), info["spp"].get<int>());
}

void print_info(const Registry& registry, const InfoOptions& options) {
  Scene scene = read_scene(options.scene.path, registry, options.scene.overrides);
  Json info = {{"scene", scene.path}, {"hash", fmt::format("{:016x}", scene.hash)}};
  info["objects"] = Json::array();
  for (const SceneObject& object : scene.objects) info["objects"].push_back(describe_object(object));
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

}  // namespace

void add_info(CLI::App& program, CommandContext& context) {
  CLI::App* command =
      program.add_subcommand("info", "Tell what a scene holds: patches, degrees, weights, bounds, memory");
  auto options = std::make_shared<InfoOptions>();
  add_scene_options(*command, options->scene);
  command->add_flag("--json", options->json, "Print JSON");
  run_when_chosen(*command, context, [&context, options] { print_info(context.registry, *options); });
}

}  // namespace rondure
