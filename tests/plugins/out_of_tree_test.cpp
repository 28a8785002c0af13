// A third party's project, built against the installed package and loaded into this process and into the
// installed program. Everything is made under the build tree.
#include <ImfArray.h>
#include <ImfRgbaFile.h>

#include <algorithm>
#include <filesystem>

#include "renderer/api/abi.h"
#include "renderer/plugin/builtin.h"
#include "renderer/plugin/loader.h"
#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/process.h"

namespace rondure {
namespace {

struct ThirdParty {
  std::string prefix;   // where Rondure is installed
  std::string plugins;  // where the project's shared objects are
};

void require_success(const std::vector<std::string>& arguments) {
  const ProcessResult result = run_process(arguments);
  INFO(result.out << result.err);
  REQUIRE(result.exit_code == 0);
}

ThirdParty install_and_build() {
  const ThirdParty made{fresh_folder("third_party/prefix"), fresh_folder("third_party/build")};
  require_success({cmake_path(), "--install", build_folder(), "--prefix", made.prefix});
  require_success({cmake_path(), "-S", source_folder() + "/tests/plugins/project", "-B", made.plugins, "-G",
                   "Ninja", "-DCMAKE_PREFIX_PATH=" + made.prefix, "-DCMAKE_BUILD_TYPE=Debug"});
  require_success({cmake_path(), "--build", made.plugins});
  return made;
}

std::string message_of(const std::string& path, Registry& registry) {
  try {
    load_plugin(path, registry);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

bool names(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

void check_loading(const ThirdParty& made) {
  Registry registry;
  register_builtins(registry);
  const std::vector<std::string> families = registry.family_names(),
                                 integrators = registry.integrator_names();
  const auto path_of = [&](const std::string& name) { return made.plugins + "/" + name + ".so"; };
  const auto refusal = [&](const std::string& name) { return message_of(path_of(name), registry); };
  const auto about = [&](const std::string& name) { return "plugin " + path_of(name) + ": "; };

  constexpr AbiString abi = abi_string();
  CHECK(refusal("wrong_abi") == about("wrong_abi") +
                                    "it was built for another Rondure; rebuild it against this one\n" +
                                    "  this program: " + abi.text + "\n  the plugin:   rondure 0.0.1 abi 0");
  CHECK(refusal("no_entry") ==
        about("no_entry") +
            "it has no entry point rondure_plugin_abi; build it with rondure_add_plugin of "
            "Rondure's CMake package");
  CHECK(refusal("throws") == about("throws") + "registration failed: no licence for spheres");
  CHECK(refusal("throws_number") ==
        about("throws_number") + "registration failed with an exception of unknown type");
  CHECK(refusal("duplicate") ==
        about("duplicate") + "registration failed: the name \"sphere\" is taken by another surface family");
  CHECK(registry.family_names() == families);  // nothing was left behind
  CHECK(registry.integrator_names() == integrators);

  CHECK(refusal("paraboloid") == "no error");
  CHECK(refusal("silhouette") == "no error");
  CHECK(refusal("pair") == "no error");
  for (const char* name : {"paraboloid", "left", "right"}) CHECK(names(registry.family_names(), name));
  CHECK(names(registry.integrator_names(), "silhouette"));
  CHECK(registry.family_names().size() == families.size() + 3);
  CHECK(registry.integrator_names().size() == integrators.size() + 1);
}

// The three places to search, and that an earlier one shadows a later one by file name.
void check_search_order(const ThirdParty& made) {
  const std::string program = made.prefix + "/bin/rondure";
  const std::string installed = made.prefix + "/lib/rondure/plugins/paraboloid.so";
  // The name heads a line; summaries may hold the same word.
  const auto shows = [](const ProcessResult& result, const std::string& name) {
    INFO(result.err);
    CHECK(result.exit_code == 0);
    return result.out.find("\n  " + name + " ") != std::string::npos;
  };
  CHECK_FALSE(shows(run_process({program, "list"}), "paraboloid"));
  CHECK(shows(run_process({program, "list", "--plugin", made.plugins + "/paraboloid.so"}), "paraboloid"));
  const ProcessOptions variable{
      "", {{"RONDURE_PLUGIN_PATH", made.plugins + "/pair.so:" + made.plugins + "/silhouette.so"}}, ""};
  const ProcessResult from_variable = run_process({program, "list"}, variable);
  CHECK(shows(from_variable, "left"));
  CHECK(shows(from_variable, "silhouette"));
  std::filesystem::copy_file(made.plugins + "/paraboloid.so", installed);
  CHECK(shows(run_process({program, "list"}), "paraboloid"));
  CHECK(shows(run_process({program, "list", "--plugin", made.plugins + "/paraboloid.so"}), "paraboloid"));
  std::filesystem::remove(installed);
  CHECK(shows(run_process({program, "list", "--plugin", made.plugins + "/paraboloid.so", "--plugin",
                           made.plugins + "/paraboloid.so"}),
              "paraboloid"));

  const ProcessResult refused = run_process({program, "list", "--plugin", made.plugins + "/no_entry.so"});
  CHECK(refused.exit_code == 1);
  CHECK(refused.err.find("it has no entry point rondure_plugin_abi") != std::string::npos);
}

// A scene of the plugin's family under the plugin's integrator, with the installed program.
void check_scene(const ThirdParty& made) {
  const std::string folder = fresh_folder("third_party/scene");
  write_text_file(folder + "/scene.json", R"({
    "camera": { "type": "orthographic", "origin": [0, 0, 5], "target": [0, 0, 0], "up": [0, 1, 0], "height": 4 },
    "film": { "resolution": [8, 8], "filter": "box" },
    "sampling": { "spp": 4 },
    "integrator": { "type": "silhouette", "value": 0.25 },
    "objects": [ { "type": "paraboloid", "height": 0.5 } ]
  })");
  write_text_file(folder + "/rays.csv", "ox,oy,oz,dx,dy,dz\n0.25,0.5,2,0,0,-1\n3,0,2,0,0,-1\n");
  const std::string program = made.prefix + "/bin/rondure";
  const ProcessOptions in{folder, {{"RONDURE_PLUGIN_PATH", made.plugins + "/paraboloid.so"}}, ""};
  const std::string silhouette = made.plugins + "/silhouette.so";

  // z = 0.5 (0.25^2 + 0.5^2) = 0.15625, so t = 1.84375: every number here has few bits, so that the hit is
  // exact.
  const ProcessResult traced =
      run_process({program, "trace", "scene.json", "--rays", "rays.csv", "--plugin", silhouette}, in);
  INFO(traced.out << traced.err);
  REQUIRE(traced.exit_code == 0);
  CHECK(traced.out.find("\n0,1,1.84375") != std::string::npos);
  CHECK(traced.out.find("\n1,0,") != std::string::npos);

  const ProcessResult rendered =
      run_process({program, "render", "scene.json", "-o", "out.exr", "--plugin", silhouette, "--quiet"}, in);
  INFO(rendered.err);
  REQUIRE(rendered.exit_code == 0);
  Imf::RgbaInputFile file((folder + "/out.exr").c_str());
  Imf::Array2D<Imf::Rgba> pixels(8, 8);
  file.setFrameBuffer(&pixels[0][0], 1, 8);
  file.readPixels(0, 7);
  // The square [-1, 1]^2 covers the middle 4 x 4 pixels exactly.
  int wrong = 0;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const bool inside = x >= 2 && x < 6 && y >= 2 && y < 6;
      wrong += pixels[y][x].g != (inside ? 0.25f : 0.0f);
    }
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("plugins built out of tree against the installed package", "[plugin]") {
  const ThirdParty made = install_and_build();
  check_loading(made);
  check_search_order(made);
  check_scene(made);
}

}  // namespace rondure
