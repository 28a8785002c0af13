// What the program says and returns, whatever it is asked.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "renderer/plugin/builtin.h"
#include "renderer/scene/scene_docs.h"
#include "tests/catch.h"
#include "tests/commands/command_files.h"
#include "tests/paths.h"
#include "tests/process.h"

namespace rondure {
namespace {

const std::string ball = R"({ "objects": [ { "type": "sphere_tiling" } ] })";

TEST_CASE("a command line that makes no sense gets one message and exit code 1", "[commands]") {
  struct Row {
    std::vector<std::string> arguments;
    std::string message;
  };
  const Row table[] = {
      {{}, "A subcommand is required; see rondure --help"},
      {{"rendr"}, "unknown command \"rendr\"; did you mean \"render\"?"},
      {{"frobnicate", "x.json"},
       "unknown command \"frobnicate\"; known: \"render\", \"trace\", \"eval\", \"info\", \"export\", "
       "\"study\", \"validate\", "
       "\"list\", "
       "\"describe\""},
      {{"--plugn", "x"}, "unknown option \"--plugn\"; did you mean \"--plugin\"?"},
      {{"validate"}, "scene is required; see rondure validate --help"},
      {{"validate", "a", "b"}, "unexpected argument \"b\"; see rondure validate --help"},
      {{"validate", "a", "--solvr", "newton"}, "unknown option \"--solvr\"; did you mean \"--solver\"?"},
      {{"render", "a", "--spp", "many"},
       "--spp: takes an integer, found \"many\"; see rondure render --help"},
      {{"render", "a", "--spp", "1e3"}, "--spp: takes an integer, found \"1e3\"; see rondure render --help"},
      {{"--spp", "1"},
       "\"--spp\" is an option of a command: it stands after the command's name, and before any --; see "
       "rondure --help"},
      {{"--spp", "1", "render", "a"},
       "\"--spp\" is an option of a command: it stands after the command's name, and before any --; see "
       "rondure render --help"},
      {{"--quiet", "render", "a"},
       "\"--quiet\" is an option of a command: it stands after the command's name, and before any --; see "
       "rondure render --help"},
      {{"render", "a", "--", "--spp=2"},
       "\"--spp\" is an option of a command: it stands after the command's name, and before any --; see "
       "rondure render --help"},
      {{"render", "a", "--exposure", "3"}, "--exposure requires --png; see rondure render --help"},
      {{"render", "--layers", "nonesuch", "scene.json"},
       "scene.json: layers[0]: unknown layer \"nonesuch\"; known: \"certificate\", \"curvature\", "
       "\"highlight_lines\", \"isophotes\", \"jacobian\", \"normal_error\", \"reflection_lines\", "
       "\"residual\", \"work\" (set on the command line)"},
      {{"render", "a", "-o="}, "-o: has no value; see rondure --help"},
      {{"render", "a", "--layers=", "-o", "b.exr"}, "--layers: has no value; see rondure --help"},
      {{"render", "a", "--layers", ",", "-o", "b.exr"},
       "--layers: has an empty name; see rondure render --help"},
      {{"render", "a", "--layers", "work,,residual"},
       "--layers: has an empty name; see rondure render --help"},
      {{"study", "precision", "--families", "cube,"},
       "--families: has an empty name; see rondure study --help"},
      {{"study", "corner-normals", "--scene", ""}, "--scene: names no file; see rondure study --help"},
      {{"trace", "a", "--rays", ""}, "--rays: names no file; - is standard input; see rondure trace --help"},
      {{"render", "a", "--spp", ""}, "--spp: has no value; see rondure render --help"},
      {{"render", "a", "--seed", "18446744073709551616"},
       "--seed: takes a number up to 9223372036854775807, found 18446744073709551616; see rondure render "
       "--help"},
      {{"trace", "a", "-o", ""}, "--output: names no file; - is standard output; see rondure trace --help"},
      {{"render", "a", "--seed", ""}, "--seed: has no value; see rondure render --help"},
      {{"render", "a", "--crop", ""}, "--crop: has no value; see rondure render --help"},
      {{"render", "a", "--exposure", ""}, "--exposure: has no value; see rondure render --help"},
      {{"study", "precision", "-o", ""}, "--output: names no folder; see rondure study --help"},
      {{"render", "a", "--resolution", "640"},
       "--resolution: takes WIDTHxHEIGHT, such as 640x480, found \"640\"; see rondure render --help"},
      {{"render", "a", "--resolution", "0x480"},
       "--resolution: takes WIDTHxHEIGHT, such as 640x480, found \"0x480\"; see rondure render --help"},
      {{"render", "a", "--resolution", "64x48x3"},
       "--resolution: takes WIDTHxHEIGHT, such as 640x480, found \"64x48x3\"; see rondure render --help"},
      {{"describe", "sphre"}, "unknown type \"sphre\"; did you mean \"sphere\"?"},
      {{"validate", "missing.json"}, "cannot read missing.json: No such file or directory"},
      {{"validate", "."}, "cannot read .: it is a folder"},
      {{"--plugin"}, "--plugin: 1 required PATH missing; see rondure --help"},
      {{"describe"}, "type is required; see rondure describe --help"},
      {{"trace", "scene.json"}, "--rays is required; see rondure trace --help"},
      {{"eval", "scene.json"}, "one of --at and --direction is required; see rondure eval --help"},
      {{"eval", "scene.json", "--at", "-", "--direction", "-"},
       "--at excludes --direction; see rondure eval --help"},
      {{"eval", "scene.json", "--at", ""},
       "--at: names no file; - is standard input; see rondure eval --help"},
      {{"export", "scene.json", "-o", "/dev/stdout"},
       "/dev/stdout: cannot write: it is a stream that is open already; - is standard output, where that can "
       "be written to"},
      {{"render", "scene.json", "--resolution", "4"},
       "--resolution: takes WIDTHxHEIGHT, such as 640x480, found \"4\"; see rondure render --help"},
      {{"render", "scene.json", "--crop", "1,2,3"}, "--crop wants x0,y0,x1,y1, four integers, not \"1,2,3\""},
      {{"render", "scene.json", "--resolution", "4x4", "--crop", "1,1,9,9"},
       "the crop 1,1,9,9 must be a window of 0,0,4,4: x0,y0 within, x1,y1 just beyond"},
      {{"render", "scene.json", "--spp", "0"}, "--spp must be in [1, 1073741824], not 0"},
      {{"render", "scene.json", "-o", "nowhere/out.exr"},
       "nowhere/out.exr: cannot write: No such file or directory"},
      {{"render", "scene.json", "--integrator", "paht"},
       "scene.json: integrator: unknown integrator \"paht\"; did you mean \"path\"? (set on the command "
       "line)"},
      {{"info", "scene.json", "--solver", "bisection"},
       "scene.json: objects[0]: \"solver\" must be one of \"auto\", \"newton\", \"clipping\", \"radial\", "
       "\"quadric\", found "
       "\"bisection\" (set "
       "on the "
       "command line)"},
      {{"list", "--plugin", "missing.so"}, "plugin missing.so: there is no such file or folder"},
  };
  for (const Row& row : table) {
    const std::string folder = folder_with("command_line", ball);
    const ProcessResult result = run_in(folder, row.arguments);
    CAPTURE(row.message);
    CHECK(result.err == "rondure: error: " + row.message + "\n");
    CHECK(result.out.empty());
    CHECK(result.exit_code == 1);
    CHECK(names_in(folder) == std::vector<std::string>{"scene.json"});  // nothing was left behind
  }
}

TEST_CASE("help and version go to standard output", "[commands]") {
  const ProcessResult help = run_rondure({"--help"});
  CHECK(help.exit_code == 0);
  CHECK(help.err.empty());
  for (const char* command : {"render", "trace", "eval", "info", "export", "validate", "list", "describe"}) {
    CAPTURE(command);
    CHECK(help.out.find(fmt::format("\n  {} ", command)) != std::string::npos);
    const ProcessResult one = run_rondure({command, "--help"});
    CHECK(one.exit_code == 0);
    CHECK(one.out.find(fmt::format("Usage: rondure {}", command)) != std::string::npos);
  }
  CHECK(run_rondure({"--version"}).out.starts_with("rondure "));
}

TEST_CASE("validate counts what it read, or points at the fault", "[commands]") {
  const std::string folder = fresh_folder("validate");
  write_text_file(folder + "/good.json", ball);
  write_text_file(folder + "/bad.json",
                  "{\n  \"objects\": [ { \"type\": \"sphere\", \"radius\": -1 } ]\n}\n");
  const ProcessResult good = run_in(folder, {"validate", "good.json"});
  CHECK(good.out == "good.json: valid, 1 object, 6 patches, 1 light, 1 material\n");
  CHECK(good.err.empty());
  CHECK(good.exit_code == 0);
  const ProcessResult bad = run_in(folder, {"validate", "bad.json"});
  CHECK(bad.err ==
        "rondure: error: bad.json:2:46: \"radius\" must be a number greater than 0, found -1\n"
        "  2 |   \"objects\": [ { \"type\": \"sphere\", \"radius\": -1 } ]\n"
        "    |                                              ^\n");
  CHECK(bad.out.empty());
  CHECK(bad.exit_code == 1);
}

TEST_CASE("options of the scene may stand anywhere and more than once", "[commands]") {
  const std::string folder = fresh_folder("scene_options");
  write_text_file(folder + "/s.json", ball);
  const auto says = [&](std::vector<std::string> arguments) {
    const ProcessResult result = run_in(folder, arguments);
    return result.out + result.err;
  };
  const std::string valid = "s.json: valid, 1 object, 8 patches, 1 light, 1 material\n";
  CHECK(says({"validate", "--set", "/objects/0/type=sphere_octant", "s.json"}) == valid);
  CHECK(says({"validate", "s.json", "--solver", "clipping", "--set", "/objects/0/type=sphere_octant", "--set",
              "/objects/0/radius=2"}) == valid);
  CHECK(says({"validate", "s.json", "--solver", "fast"}) ==
        "rondure: error: s.json: objects[0]: \"solver\" must be one of \"auto\", \"newton\", \"clipping\", "
        "\"radial\", \"quadric\", "
        "found "
        "\"fast\" (set on "
        "the command line)\n");
  CHECK(says({"validate", "s.json", "--set", "/objects/3/radius=2"}) ==
        "rondure: error: --set /objects/3/radius: \"3\" is not an element of the array, which has 1\n");
}

TEST_CASE("a full disk is an error", "[commands]") {
  // The shell is needed for the redirection alone.
  const ProcessResult result = run_process({"/bin/sh", "-c", "exec \"$0\" list > /dev/full", program_path()});
  CHECK(result.exit_code == 1);
  CHECK(result.err == "rondure: error: cannot write to standard output\n");
  for (const char* option : {"--help", "--version"}) {
    CAPTURE(option);
    const ProcessResult told =
        run_process({"/bin/sh", "-c", "exec \"$0\" \"$1\" > /dev/full", program_path(), option});
    CHECK(told.exit_code == 1);
    CHECK(told.err == "rondure: error: cannot write to standard output\n");
  }
}

TEST_CASE("an error that cannot be told is exit code 1 all the same", "[commands]") {
  for (const char* place : {"2> /dev/full", "2>&-"}) {
    CAPTURE(place);
    const std::string command = std::string("exec \"$0\" validate nowhere.json ") + place;
    CHECK(run_process({"/bin/sh", "-c", command, program_path()}).exit_code == 1);
  }
}

// The program under a shell, for redirections that run_process does not make: "$0" is the program.
ProcessResult run_redirected(const std::string& folder, const std::string& command) {
  ProcessOptions options;
  options.folder = folder;
  return run_process({"/bin/sh", "-c", "exec \"$0\" " + command, program_path()}, options);
}

TEST_CASE("a closed standard output is an error", "[commands]") {
  const std::string folder = folder_with("closed_output", ball);
  for (const char* command : {"list", "--help", "validate scene.json"}) {
    CAPTURE(command);
    const ProcessResult result = run_redirected(folder, std::string(command) + " >&-");
    CHECK(result.exit_code == 1);
    CHECK(result.err == "rondure: error: cannot write to standard output\n");
  }
  CHECK(run_redirected(folder, "info scene.json >&-").err ==
        "rondure: error: standard output: writing failed\n");
  const ProcessResult input = run_redirected(folder, "trace scene.json --rays - -o hits.csv <&-");
  CHECK(input.exit_code == 1);
  CHECK(input.err == "rondure: error: standard input: reading failed after line 0: Bad file descriptor\n");
  CHECK(names_in(folder) == std::vector<std::string>{"scene.json"});
}

TEST_CASE("files do not land on closed standard descriptors", "[commands]") {
  const std::string folder = folder_with("closed_descriptors", ball);
  const std::string render = "render scene.json --resolution 8x8 --spp 2 -o ";
  REQUIRE(run_redirected(folder, render + "plain.exr").exit_code == 0);
  CHECK(run_redirected(folder, render + "closed.exr <&- >&- 2>&-").exit_code == 0);
  CHECK(read_text_file(folder + "/closed.exr") == read_text_file(folder + "/plain.exr"));
  // The kernel tells that each descriptor is taken: what it stands for is empty, not missing.
  for (const char* descriptor : {"0", "1", "2"}) {
    CAPTURE(descriptor);
    const std::string rays = std::string("/dev/fd/") + descriptor;
    const ProcessResult result =
        run_redirected(folder, "trace scene.json --rays " + rays + " -o hits.csv <&- >&- 2>&-");
    CHECK(result.exit_code == 0);
    CHECK(read_text_file(folder + "/hits.csv") == "ray,hit,t,x,y,z,nx,ny,nz,surface,patch,u,v\n");
  }
}

TEST_CASE("list and describe know every type and parameter", "[commands]") {
  Registry registry;
  register_builtins(registry);
  const std::string list = run_rondure({"list"}).out;
  std::size_t types = 0;
  for (const TypeGroup& group : all_types(registry)) {
    CHECK(list.find(group.kind + ":\n") != std::string::npos);
    for (const TypeDoc& type : group.types) {
      CAPTURE(type.name);
      CHECK(list.find("\n  " + type.name + " ") != std::string::npos);
      const ProcessResult described = run_rondure({"describe", type.name});
      CHECK(described.exit_code == 0);
      CHECK(described.out.find(fmt::format("{} ({})\n{}\n", type.name, group.kind, type.summary)) !=
            std::string::npos);
      for (const ParameterDoc& parameter : type.parameters) {
        CAPTURE(parameter.name);
        CHECK(described.out.find(fmt::format("\n  {}: {}\n", parameter.name, parameter.type)) !=
              std::string::npos);
        CHECK(described.out.find(parameter.meaning) != std::string::npos);
      }
      ++types;
    }
  }
  CHECK(types >= 22);
}

}  // namespace
}  // namespace rondure
