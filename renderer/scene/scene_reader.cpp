#include "renderer/scene/scene_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>

#include "renderer/api/utf8.h"
#include "renderer/plugin/call_plugin.h"
#include "renderer/scene/default_view.h"
#include "renderer/scene/json_reader.h"
#include "renderer/scene/object_reader.h"
#include "renderer/scene/text_file.h"
#include "renderer/scene/unknown_name.h"

namespace rondure {
namespace {

// FNV-1a, 64 bits (Fowler, Noll and Vo 1991).
std::uint64_t hash_bytes(std::uint64_t hash, const std::string& bytes) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
  return hash;
}

SamplingSettings read_sampling(Params params) {
  SamplingSettings sampling;
  sampling.spp = static_cast<int>(params.integer("spp", sampling.spp, 1, 1 << 30));
  constexpr std::int64_t most = (std::int64_t{1} << 53) - 1;  // the next integers are not all doubles
  const auto seed = static_cast<std::int64_t>(sampling.seed);
  sampling.seed = static_cast<std::uint64_t>(params.integer("seed", seed, 0, most));
  params.finish();
  return sampling;
}

std::unique_ptr<Integrator> make_integrator(const IntegratorFactory& factory, Params& params) {
  const std::string who = fmt::format("the integrator \"{}\"", factory.name);
  std::unique_ptr<Integrator> integrator = call_plugin(params, who, [&] { return factory.create(params); });
  if (!integrator) params.fail(who + " made nothing");
  return integrator;
}

// The name alone stands for an object with nothing but that "type".
void read_integrator(Scene& scene, Params& root, const Registry& registry) {
  Value object;
  object.kind = Value::Kind::object;
  Value name;
  name.kind = Value::Kind::string;
  name.string = "path";
  const Value* value = root.raw("integrator");
  if (value && value->kind == Value::Kind::object) {
    object = *value;
  } else {
    if (value && value->kind != Value::Kind::string) {
      root.fail(*value, "\"integrator\" must be a name or an object, { \"type\": name, ... }");
    }
    if (value) name = *value;
    object.where = name.where;
    object.members.push_back({"type", name.where, name});
  }
  Params params(object, root.source(), "integrator");
  params.set_registry(registry);
  scene.integrator_name = params.text("type");
  const IntegratorFactory* factory = registry.integrator(scene.integrator_name);
  if (!factory) {
    params.fail("type", unknown_name("integrator", scene.integrator_name, registry.integrator_names()));
  }
  scene.integrator = make_integrator(*factory, params);
  params.finish();
}

std::map<std::string, int> read_materials(Scene& scene, Params& root) {
  std::map<std::string, int> names;
  const Value* value = root.raw("materials");
  if (!value) return names;
  if (value->kind != Value::Kind::object)
    root.fail(*value, "\"materials\" must be an object, { name: material, ... }");
  for (const Value::Member& member : value->members) {
    Params params(member.value, root.source(), "materials." + member.key);
    names.emplace(member.key, static_cast<int>(scene.materials.size()));
    scene.materials.push_back(read_material(params));
  }
  return names;
}

// Nearly black, or nearly white on a surface that is dark itself.
int contrasting_material(Scene& scene, int surface) {
  const Material material =
      surface == default_material ? Material{} : scene.materials[static_cast<std::size_t>(surface)];
  const auto* diffuse = std::get_if<Diffuse>(&material.scattering);
  const bool dark =
      diffuse && !emits(material) && diffuse->albedo.x + diffuse->albedo.y + diffuse->albedo.z < 0.6;
  scene.materials.push_back(Material{Diffuse{dvec3(dark ? 0.85 : 0.03)}});
  return static_cast<int>(scene.materials.size()) - 1;
}

void read_objects(Scene& scene, Params& root, const Registry& registry,
                  const std::map<std::string, int>& materials) {
  std::vector<Params> objects = root.objects("objects");
  if (objects.empty()) root.fail("objects", "\"objects\" is empty; a scene needs at least one");
  scene.objects_where = root.raw("objects")->where;
  std::vector<SceneObject> wires;  // last, so that the numbers of the scene's own objects stay
  for (Params& params : objects) {
    std::vector<SceneObject> parts = read_object(params, registry, materials);
    if (parts.size() > 1) {
      if (parts[1].material == contrast_material)
        parts[1].material = contrasting_material(scene, parts[0].material);
      wires.push_back(std::move(parts[1]));
    }
    const SceneObject& object = scene.objects.emplace_back(std::move(parts[0]));
    if (object.material == default_material || !object.traced.surface.patches.empty()) continue;
    const Material& material = scene.materials[static_cast<std::size_t>(object.material)];
    if (material.isolines || material.curvature) {
      params.fail("material", fmt::format("\"{}\" has no patches, and so no {}; take a tiling, such as "
                                          "\"sphere_tiling\"",
                                          printable(object.type),
                                          material.isolines ? "isolines" : "colours of curvature"));
    }
  }
  std::move(wires.begin(), wires.end(), std::back_inserter(scene.objects));
  const NormalEstimator normals = read_estimator(root, "normals");
  for (SceneObject& object : scene.objects) object.normals = object.normals.value_or(normals);
  int plain = default_material;
  for (SceneObject& object : scene.objects) {
    if (object.material != default_material) continue;
    if (plain == default_material) {
      plain = static_cast<int>(scene.materials.size());
      scene.materials.emplace_back();
    }
    object.material = plain;
  }
}

void read_lights(Scene& scene, Params& root) {
  if (root.raw("lights")) {
    for (Params& params : root.objects("lights")) scene.lights.push_back(read_light(params));
  }
  const bool glowing =
      std::any_of(scene.objects.begin(), scene.objects.end(), [&](const SceneObject& object) {
        return emits(scene.materials[static_cast<std::size_t>(object.material)]);
      });
  if (scene.lights.empty() && !glowing) scene.lights.emplace_back(ConstantLight{});
}

// Adds what the keys "file" of a scene beside `folder` name.
void add_files(const Value& value, const std::filesystem::path& folder, std::vector<std::string>& files) {
  for (const Value& item : value.items) add_files(item, folder, files);
  for (const Value::Member& member : value.members) {
    if (member.key == "file" && member.value.kind == Value::Kind::string)
      files.push_back((folder / member.value.string).string());
    add_files(member.value, folder, files);
  }
}

Scene read_document(Document document, const std::string& path, const Registry& registry,
                    const SceneOverrides& overrides) {
  apply_overrides(document.root, overrides);
  Params root(document.root, document.source.get(), "");
  Scene scene;
  scene.path = path;
  scene.source = document.source;
  add_files(document.root, std::filesystem::path(path).parent_path(), scene.files);
  scene.hash = hash_bytes(hash_bytes(0xCBF29CE484222325u, document.source->text), overrides_text(overrides));
  root.text("$schema", "");
  root.text("name", "");
  root.text("comment", "");
  if (root.raw("film")) {
    Params params = root.object("film");
    params.set_registry(registry);
    scene.film = read_film(params);
  }
  if (root.raw("sampling")) scene.sampling = read_sampling(root.object("sampling"));
  read_integrator(scene, root, registry);
  const std::map<std::string, int> materials = read_materials(scene, root);
  read_objects(scene, root, registry, materials);
  read_lights(scene, root);
  if (root.raw("camera")) {
    Params params = root.object("camera");
    scene.camera = read_camera(params);
  } else {
    scene.camera = view_of(scene.objects, static_cast<double>(scene.film.width) / scene.film.height);
  }
  root.finish();
  return scene;
}

}  // namespace

Scene read_scene(const std::string& path, const Registry& registry, const SceneOverrides& overrides) {
  return read_document(read_json_file(path), path, registry, overrides);
}

Scene read_scene_text(const std::string& name, std::string text, const Registry& registry,
                      const SceneOverrides& overrides) {
  return read_document(read_json_text(name, std::move(text)), name, registry, overrides);
}

}  // namespace rondure
