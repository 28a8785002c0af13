// Raw control nets, tensor-product or triangular, from the scene or from a file of the same form.
#include <filesystem>

#include "renderer/api/registry.h"
#include "renderer/bezier/bernstein.h"
#include "renderer/scene/json_reader.h"
#include "surfaces/families.h"
#include "surfaces/net_reader.h"

namespace rondure {
namespace {

// Adds the patches of the list and returns what "closed" says.
bool read_patches(Params& params, Surface& surface) {
  for (Params& patch : params.objects("patches")) {
    surface.patches.push_back(read_net(patch, {"[w x, w y, w z, w]", max_degree}));
  }
  if (surface.patches.empty()) params.fail("patches", "there is no patch");
  return params.boolean("closed", false);
}

// A file that cannot be read is a mistake of the scene, where it is named; one in the file is shown there.
Document read_file(Params& params) {
  const std::string path = params.path("file");
  std::error_code ignored;
  // A pipe that nobody writes to would be waited for without end.
  if (const auto status = std::filesystem::status(path, ignored); std::filesystem::is_other(status))
    params.fail("file", "not a regular file: " + path);
  try {
    return read_json_file(path);
  } catch (const SceneError& error) {
    if (error.where().line > 0) throw;
    params.fail("file", error.what());
  }
}

Surface build_bezier(Params& params) {
  Surface surface;
  if (!params.has("file")) {
    surface.closed = read_patches(params, surface);
    return surface;
  }
  if (params.has("patches")) params.fail("patches", "give either \"patches\" or \"file\", not both");
  const bool closed_here = params.boolean("closed", false);
  const Document document = read_file(params);
  Params inside(document.root, document.source.get(), "the file");
  surface.closed = read_patches(inside, surface) || closed_here;
  inside.finish();
  return surface;
}

}  // namespace

void register_bezier(Registry& registry) {
  registry.add(
      SurfaceFamily{"bezier",
                    "rational Bezier patches from raw control nets, tensor-product or triangular",
                    {{"patches", "array of {\"kind\": \"tensor\" or \"triangle\", \"degree\", \"net\"}", "",
                      "control points are [w x, w y, w z, w]; a tensor net is net[i][j] with \"degree\": [m, "
                      "n], a triangle's is "
                      "keyed \"ijk\" (or \"i,j,k\") for u^i v^j w^k with \"degree\": n"},
                     {"file", "string", "\"\"",
                      "instead of patches: a JSON file {\"patches\": [...]}, found from the scene's folder"},
                     {"closed", "boolean", "false",
                      "the patches bound a solid; the normals d/du x d/dv of all must then point outward"}},
                    build_bezier});
}

}  // namespace rondure
