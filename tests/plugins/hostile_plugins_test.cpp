// Shared objects that break every rule short of ending the process: refused with a message, and the host
// lives.
#include <fmt/format.h>

#include "renderer/plugin/builtin.h"
#include "renderer/plugin/loader.h"
#include "tests/catch.h"
#include "tests/commands/command_files.h"
#include "tests/paths.h"
#include "tests/process.h"

namespace rondure {
namespace {

std::string plugin_path(const std::string& name) {
  return build_folder() + "/hostile_plugins/" + name + ".so";
}

TEST_CASE("a shared object that is no proper plugin is refused with a reason", "[plugin][hostile]") {
  const std::string folder = fresh_folder("hostile_plugins");
  const std::string whole = read_text_file(plugin_path("half"));
  write_text_file(folder + "/truncated.so", whole.substr(0, whole.size() / 3));
  write_text_file(folder + "/header.so", whole.substr(0, 40));
  std::filesystem::create_directory(folder + "/folder.so");
  std::filesystem::create_symlink("loop.so", folder + "/loop.so");
  REQUIRE(run_process({"mkfifo", folder + "/fifo.so"}).exit_code == 0);
  struct Row {
    std::string path, reason;
  };
  const Row table[] = {
      {plugin_path("abi_null"), "it was built for another Rondure"},
      {plugin_path("abi_noise"), "it was built for another Rondure"},
      {plugin_path("abi_throws"), "telling its ABI failed: no ABI today"},
      {plugin_path("half"), "it has no entry point rondure_plugin_register; build it with"},
      {plugin_path("missing_symbol"), "it cannot be loaded: undefined symbol: rondure_no_such_function"},
      {plugin_path("load_throws"), "it ends the process that loads it: Aborted"},
      {plugin_path("bad_name"), "registration failed: the surface family \"?[2Jsphere\" has no proper name"},
      {folder + "/truncated.so", "it "} /* as the cut falls, the loader sees it or reads beyond the end */,
      {plugin_path("exits"), "it ends the process that loads it: exit code 3"},
      {plugin_path("crashes"), "it ends the process that loads it: Segmentation fault"},
      {folder + "/header.so", "it cannot be loaded: file too short"},
      {folder + "/loop.so", "it cannot be loaded: "},
      {folder + "/fifo.so", "it cannot be loaded: not a regular file"},
      {folder + "/folder.so/none.so", "there is no such file or folder"},
  };
  for (const Row& row : table) {
    const ProcessResult result = run_rondure({"list", "--plugin", row.path});
    CAPTURE(row.path, result.err);
    CHECK(result.err.starts_with("rondure: error: plugin " + row.path + ": " + row.reason));
    CHECK(result.err.size() < row.path.size() + 2000);
    CHECK(result.err.find('\x1b') == std::string::npos);
    CHECK(result.out.empty());
    CHECK(result.exit_code == 1);
  }
  CHECK(run_rondure({"list", "--plugin", folder + "/folder.so"}).exit_code == 0);  // a folder without plugins
}

TEST_CASE("a family that breaks its promises is refused at the object", "[plugin][hostile]") {
  struct Row {
    std::string as, message;
  };
  const Row table[] = {
      {"empty", "made a surface that has no patches"},
      {"nan", "made a surface that has a patch 0 that has a control point that is not finite"},
      {"infinite", "made a surface that has a patch 0 that has a control point that is not finite"},
      {"few_points", "made a surface that has a patch 0 that has 3 control points, not 4"},
      {"many_points", "made a surface that has a patch 0 that has 1000 control points, not 4"},
      {"no_points", "made a surface that has a patch 0 that has 0 control points, not 4"},
      {"negative_degree",
       "made a surface that has a patch 0 that has degree (-1, 1), and degrees are 1 to 24"},
      {"zero_degree", "made a surface that has a patch 0 that has degree (1, 0), and degrees are 1 to 24"},
      {"large_degree",
       "made a surface that has a patch 0 that has degree (1000, 1), and degrees are 1 to 24"},
      {"huge_degree",
       "made a surface that has a patch 0 that has degree (2147483647, 2147483647), and degrees are 1 to 24"},
      {"negative_triangle", "made a surface that has a patch 0 that has degree -1, and degrees are 1 to 24"},
      {"large_triangle", "made a surface that has a patch 0 that has degree 1000, and degrees are 1 to 24"},
      {"both", "made a surface that is an ellipsoid and patches at once"},
      {"nan_origin", "made a surface that has an origin that is not finite"},
      {"join_patch", "made a surface that has a join that is of a patch 99999999, and there are 1"},
      {"join_negative", "made a surface that has a join that is of a patch -5, and there are 1"},
      {"join_side", "made a surface that has a join that is of a side 77, and patch 0 has 4"},
      {"join_other_side", "made a surface that has a join that is of a side -3, and patch 0 has 4"},
      {"nan_guide",
       "made a surface that has a guide in \"ribs\" that has a control point that is not finite"},
      {"no_guide",
       "made a surface that has a guide in \"ribs\" that is a curve of less than two control points"},
      {"nan_ellipsoid", "made a surface that is an ellipsoid that is not finite"},
      {"flat_ellipsoid", "made a surface that is an ellipsoid of semi-axes in a ratio above 1e+08"},
      {"throws", "failed: no licence for surfaces"},
      {"throws_number", "failed with an exception of unknown type"},
  };
  const std::string folder = fresh_folder("hostile_families");
  for (const Row& row : table) {
    write_text_file(folder + "/scene.json",
                    fmt::format("{{\"objects\": [\n{{ \"type\": \"absurd\", \"as\": \"{}\" }} ] }}", row.as));
    for (const char* command : {"validate", "info", "export"}) {
      const ProcessResult result =
          run_rondure({command, "scene.json", "--plugin", plugin_path("absurd")}, {folder, {}, ""});
      CAPTURE(command, row.as);
      CHECK(lines_of(result.err).at(0) ==
            "rondure: error: scene.json:2:1: objects[0]: the family \"absurd\" " + row.message);
      CHECK(result.out.empty());
      CHECK(result.exit_code == 1);
    }
  }
  // What only the solvers can tell, and what no plugin is to blame for.
  const auto complaint = [&](const std::string& as) {
    return run_rondure(
        {"validate", "scene.json", "--plugin", plugin_path("absurd"), "--set", "/objects/0/as=" + as},
        {folder, {}, ""});
  };
  CHECK(complaint("zeros").err.starts_with(
      "rondure: error: scene.json:2:1: objects[0]: patch 0: a weight is not"));
  CHECK(complaint("no_memory").err == "rondure: error: out of memory\n");
  CHECK(complaint("well").exit_code == 0);
  // Inside another family's object too.
  write_text_file(folder + "/scene.json",
                  "{\"objects\": [ { \"type\": \"composed_patch\",\n\"of\": { \"type\": \"absurd\", \"as\": "
                  "\"nan\" } } ] }");
  CHECK(run_rondure({"validate", "scene.json", "--plugin", plugin_path("absurd")}, {folder, {}, ""})
            .err.starts_with(
                "rondure: error: scene.json:2:7: objects[0].of: the family \"absurd\" made a surface"));
}

struct Refusal {
  std::string as, message;
};

// A small render with the plugin of absurd things, one value of the scene set.
ProcessResult render_absurd(const std::string& folder, const std::string& setting,
                            const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {
      "render",  "scene.json", "--resolution",        "8x8",   "--spp", "2", "--quiet", "-o",
      "out.exr", "--plugin",   plugin_path("absurd"), "--set", setting};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_rondure(arguments, {folder, {}, ""});
}

// Renders each in turn: `render(as)` must fail with its message, and leave nothing behind.
template <class Render>
void check_refusals(const std::string& folder, const std::vector<Refusal>& table, const Render& render) {
  for (const Refusal& row : table) {
    const ProcessResult result = render(row.as);
    CAPTURE(row.as);
    CHECK(result.err == "rondure: error: " + row.message + "\n");
    CHECK(result.exit_code == 1);
    CHECK(names_in(folder) == std::vector<std::string>{"scene.json"});
  }
}

TEST_CASE("an integrator that breaks its promises ends the render with a message", "[plugin][hostile]") {
  const std::vector<Refusal> table = {
      {"null", "scene.json: integrator: the integrator \"absurd\" made nothing"},
      {"throws", "scene.json: integrator: the integrator \"absurd\" failed: no licence for integrators"},
      {"throws_number",
       "scene.json: integrator: the integrator \"absurd\" failed with an exception of unknown type"},
      {"throws_late", "the integrator \"absurd\" failed: no licence for light"},
      {"throws_number_late", "the integrator \"absurd\" failed with an exception of unknown type"},
  };
  const std::string folder = folder_with("hostile_integrators");
  const auto render = [&](const std::string& as) {
    return render_absurd(folder, "/integrator={\"type\": \"absurd\", \"as\": \"" + as + "\"}");
  };
  check_refusals(folder, table, render);
  CHECK(render("nan").err.starts_with(
      "rondure: error: 128 of the picture's samples were negative, not finite"));
  CHECK(render("well").exit_code == 0);
}

TEST_CASE("a legend that cannot be drawn is refused before the render", "[plugin][hostile]") {
  const std::string who = "the integrator \"absurd\" ",
                    no_range = who +
                               "made a legend that has no range of numbers from low to high, positive "
                               "where logarithmic",
                    no_title = who + "made a legend that has a title that is no short line of text";
  const std::vector<Refusal> table = {
      {"throws_legend", who + "failed: no licence for words"},
      {"throws_number_legend", who + "failed with an exception of unknown type"},
      {"no_colors", who + "made a legend that has no colours"},
      {"nan_color", who + "made a legend that has a colour that is not finite"},
      {"log_zero", no_range},
      {"log_negative", no_range},
      {"nan_scale", no_range},
      {"empty_scale", no_range},
      {"wide_scale", no_range},
      {"bad_title", no_title},
      {"long_title", no_title},
  };
  const std::string folder = folder_with("hostile_legends");
  const auto render = [&](const std::string& as) {
    return render_absurd(folder, "/integrator={\"type\": \"absurd\", \"as\": \"" + as + "\"}",
                         {"--png", "out.png"});
  };
  check_refusals(folder, table, render);
  CHECK(render("well").exit_code == 0);
  CHECK(names_in(folder) == std::vector<std::string>{"out.exr", "out.png", "scene.json"});
}

TEST_CASE("a layer that breaks its promises ends the render with a message", "[plugin][hostile]") {
  const std::vector<Refusal> table = {
      {"null", "scene.json: layers[0]: the layer \"absurd\" made nothing"},
      {"throws", "scene.json: layers[0]: the layer \"absurd\" failed: no licence for layers"},
      {"throws_number",
       "scene.json: layers[0]: the layer \"absurd\" failed with an exception of unknown type"},
      {"throws_late", "the layer \"absurd\" failed: no licence for numbers"},
      {"throws_number_late", "the layer \"absurd\" failed with an exception of unknown type"},
      {"nan", "the layer \"Absurd.x\" gave no number for a pixel"},
  };
  const std::string folder = folder_with("hostile_layers");
  const auto render = [&](const std::string& as) {
    return render_absurd(folder, "/film/layers=[{\"type\": \"absurd\", \"does\": \"" + as + "\"}]");
  };
  check_refusals(folder, table, render);
  CHECK(render("well").exit_code == 0);  // an infinity is a large number
}

}  // namespace
}  // namespace rondure
