#include <filesystem>

#include "tests/catch.h"
#include "tests/commands/command_files.h"
#include "tests/paths.h"
#include "tests/process.h"

namespace rondure {
namespace {

const char* const small_ball = R"({ "film": { "resolution": [40, 30] }, "sampling": { "spp": 8 },
  "materials": { "m": { "albedo": 0.7 } }, "lights": [ { "type": "constant" } ],
  "objects": [ { "type": "sphere_tiling", "topology": "cube", "material": "m" } ] })";

// A fresh folder that holds ball.json.
std::string stage(const std::string& name) {
  const std::string folder = fresh_folder(name);
  write_text_file(folder + "/ball.json", small_ball);
  return folder;
}

TEST_CASE("render writes the scene's name and says so", "[commands]") {
  const std::string folder = stage("render_default");
  const ProcessResult r = run_in(folder, {"render", "ball.json"});
  INFO(r.err);
  CHECK(r.exit_code == 0);
  CHECK(r.out.empty());
  CHECK(r.err.find("ball.exr: 40 x 30, 8 spp, ") != std::string::npos);
  CHECK(r.err.find("8 spp: 100%") != std::string::npos);
  CHECK(std::count(r.err.begin(), r.err.end(), '\n') <= 11);  // ten tenths at most, and the note
  CHECK(r.err.find('\r') == std::string::npos);               // no bar: this is no terminal
  CHECK(names_in(folder) == std::vector<std::string>{"ball.exr", "ball.json"});
}

TEST_CASE("the file's header names what found the hits", "[commands]") {
  const std::pair<std::string, std::string> table[] = {
      {R"({ "type": "sphere" })", "closed form"},
      {R"({ "type": "sphere", "solver": "clipping" })", "closed form"},
      {R"({ "type": "sphere_octant" })", "quadric"},
      {R"({ "type": "sphere_octant", "solver": "newton" })", "newton"},
      {R"({ "type": "sphere_octant", "solver": "quadric" })", "quadric"},
      {R"({ "type": "iss", "solver": "quadric" })", "newton"},
      {R"({ "type": "sphere_octant", "solver": "clipping" })", "clipping"},
      {R"({ "type": "sphere_octant", "solver": "radial" })", "newton"},
      {R"({ "type": "iss" })", "radial"},
      {R"({ "type": "iss", "solver": "newton" })", "newton"},
      {R"({ "type": "iss", "form": "degenerate" })", "newton"},
      {R"({ "type": "sphere_octant" }, { "type": "sphere" }, { "type": "sphere_cap", "solver": "newton" })",
       "closed form, newton, quadric"},
  };
  const std::string folder = fresh_folder("render_solver");
  for (const auto& [objects, solver] : table) {
    write_text_file(folder + "/s.json", R"({ "objects": [ )" + objects + " ] }");
    const ProcessResult r =
        run_in(folder, {"render", "s.json", "--resolution", "2x2", "--spp", "1", "--quiet", "-o", "a.exr"});
    INFO(r.err);
    REQUIRE(r.exit_code == 0);
    // Name, type, four bytes of length, value; the next attribute's name follows.
    const std::string bytes = read_text_file(folder + "/a.exr");
    const std::string attribute("rondure:solver\0string\0", 22);
    const std::size_t at = bytes.find(attribute);
    REQUIRE(at != std::string::npos);
    const auto length = static_cast<std::size_t>(static_cast<unsigned char>(bytes[at + attribute.size()]));
    CHECK(bytes.substr(at + attribute.size() + 4, length) == solver);
  }
}

TEST_CASE("rendered files do not depend on threads, and quiet is quiet", "[commands]") {
  const std::string folder = stage("render_threads");
  std::string first;
  for (const char* threads : {"1", "2", "3"}) {
    const std::string name = std::string("a") + threads + ".exr";
    const ProcessResult r =
        run_in(folder, {"render", "ball.json", "--threads", threads, "-o", name, "--quiet"});
    CHECK(r.exit_code == 0);
    CHECK(r.err.empty());
    const std::string bytes = read_text_file(folder + "/" + name);
    if (first.empty()) first = bytes;
    CHECK(bytes == first);
  }
  CHECK(first.size() > 10000);
  const ProcessResult other =
      run_in(folder, {"render", "ball.json", "--seed", "2", "-o", "b.exr", "--quiet"});
  CHECK(other.exit_code == 0);
  CHECK(read_text_file(folder + "/b.exr") != first);
}

TEST_CASE("a resumed render is the file of one run", "[commands]") {
  const std::string folder = stage("render_resume");
  const auto render = [&](std::vector<std::string> extra) {
    std::vector<std::string> all = {"render", "ball.json", "--quiet"};
    all.insert(all.end(), extra.begin(), extra.end());
    return run_in(folder, all);
  };
  CHECK(render({"--spp", "150", "-o", "straight.exr"}).exit_code == 0);
  for (const char* spp : {"10", "70", "150"})
    CHECK(render({"--spp", spp, "-o", "a.exr", "--resume"}).exit_code == 0);
  CHECK(read_text_file(folder + "/a.exr") == read_text_file(folder + "/straight.exr"));
  CHECK(names_in(folder) == std::vector<std::string>{"a.exr", "a.exr.state", "ball.json", "straight.exr"});

  const ProcessResult fewer = render({"--spp", "20", "-o", "a.exr", "--resume"});
  CHECK(fewer.exit_code == 1);
  CHECK(fewer.err ==
        "rondure: error: a.exr.state: already holds 144 samples a pixel, more than the 20 asked for; raise "
        "--spp\n");
  for (const std::vector<std::string>& change : {std::vector<std::string>{"--seed", "9"},
                                                 {"--crop", "0,0,20,20"},
                                                 {"--set", "/materials/m/albedo=0.6"}}) {
    std::vector<std::string> all = {"--spp", "200", "-o", "a.exr", "--resume"};
    all.insert(all.end(), change.begin(), change.end());
    const ProcessResult r = render(all);
    INFO(r.err);
    CHECK(r.exit_code == 1);
    CHECK(r.err.find("a.exr.state: holds another render; delete it or choose another output") !=
          std::string::npos);
  }
}

TEST_CASE("the preview is a PNG, and the crop its size", "[commands]") {
  const std::string folder = stage("render_png");
  const ProcessResult r = run_in(folder, {"render", "ball.json", "--png", "ball.png", "--crop", "3,4,24,15"});
  INFO(r.err);
  CHECK(r.exit_code == 0);
  CHECK(r.err.find("ball.exr: 21 x 11, 8 spp") != std::string::npos);
  const std::string png = read_text_file(folder + "/ball.png");
  CHECK(png.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  CHECK(png.substr(16, 8) == std::string("\0\0\0\x15\0\0\0\x0b", 8));  // width and height of the header chunk
  CHECK(names_in(folder) == std::vector<std::string>{"ball.exr", "ball.json", "ball.png"});
}

TEST_CASE("render's errors name the cause and leave nothing", "[commands]") {
  const std::string folder = stage("render_errors");
  const auto error_of = [&](std::vector<std::string> extra) {
    std::vector<std::string> all = {"render", "ball.json"};
    all.insert(all.end(), extra.begin(), extra.end());
    const ProcessResult r = run_in(folder, all);
    CHECK(r.exit_code == 1);
    CHECK(r.out.empty());
    return r.err;
  };
  CHECK(error_of({"-o", "no/a.exr"}) ==
        "rondure: error: no/a.exr: cannot write: No such file or directory\n");
  CHECK(error_of({"--png", "no/a.png"}) ==
        "rondure: error: no/a.png: cannot write: No such file or directory\n");
  CHECK(error_of({"-o", folder}) == "rondure: error: " + folder + ": cannot write: Is a directory\n");
  CHECK(error_of({"--crop", "1,2,3"}) ==
        "rondure: error: --crop wants x0,y0,x1,y1, four integers, not \"1,2,3\"\n");
  for (const char* crop : {"0,0,4294967297,1", "0,0,9,9,", "0,,9,9", "0;0,9,9", "0,0,9,9x", ",0,0,9"}) {
    CHECK(error_of({"--crop", crop}) ==
          std::string("rondure: error: --crop wants x0,y0,x1,y1, four integers, not \"") + crop + "\"\n");
  }
  for (const char* stops : {"nan", "inf", "101", "-1e9"}) {
    CHECK(error_of({"--png", "a.png", std::string("--exposure=") + stops})
              .find("--exposure must be in [-100, 100], not ") != std::string::npos);
  }
  CHECK(error_of({"--crop", "0,0,50,20"}) ==
        "rondure: error: the crop 0,0,50,20 must be a window of 0,0,40,30: x0,y0 "
        "within, x1,y1 just beyond\n");
  CHECK(error_of({"--spp", "0"}).find("--spp must be in [1, 1073741824], not 0") != std::string::npos);
  CHECK(names_in(folder) == std::vector<std::string>{"ball.json"});
}

TEST_CASE("render refuses to write over its own files", "[commands]") {
  const std::string folder = stage("render_equal_paths");
  std::filesystem::create_symlink("ball.json", folder + "/link.json");
  struct Row {
    std::vector<std::string> arguments;
    std::string message;
  };
  const Row table[] = {
      {{"-o", "ball.json"}, "ball.json: is the scene and the output (-o) at once"},
      {{"-o", "./link.json"}, "./link.json: is the scene and the output (-o) at once"},
      {{"--png", "../render_equal_paths/ball.json"},
       "../render_equal_paths/ball.json: is the scene and the preview (--png) at once"},
      {{"-o", "a.exr", "--png", "./a.exr"}, "./a.exr: is the output (-o) and the preview (--png) at once"},
      {{"-o", "a.exr", "--png", "a.exr.state", "--resume"},
       "a.exr.state: is the preview (--png) and the state to resume from (--resume) at once"},
  };
  for (const Row& row : table) {
    std::vector<std::string> all = {"render", "ball.json"};
    all.insert(all.end(), row.arguments.begin(), row.arguments.end());
    const ProcessResult r = run_in(folder, all);
    CHECK(r.exit_code == 1);
    CHECK(r.err == "rondure: error: " + row.message + "\n");
  }
  CHECK(read_text_file(folder + "/ball.json") == small_ball);
  CHECK(names_in(folder) == std::vector<std::string>{"ball.json", "link.json"});
}

TEST_CASE("render refuses to write over what the scene reads, and to standard output", "[commands]") {
  const std::string folder = stage("render_inputs");
  const std::string net =
      R"({ "patches": [ { "degree": [1, 1], "net": [[[0,0,0,1],[0,1,0,1]],[[1,0,0,1],[1,1,0,1]]] } ] })";
  write_text_file(folder + "/net.json", net);
  write_text_file(folder + "/scene.json", R"({ "objects": [ { "type": "bezier", "file": "net.json" } ] })");
  const auto error_of = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> all = {"render", "scene.json", "--resolution", "2x2", "--quiet"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const ProcessResult r = run_in(folder, all);
    CHECK(r.exit_code == 1);
    return r.err;
  };
  CHECK(error_of({"-o", "./net.json"}) ==
        "rondure: error: ./net.json: is a file that the scene reads and the output (-o) at once\n");
  CHECK(error_of({"-o", "-"}) ==
        "rondure: error: a picture does not go to standard output; name a file, or ./-\n");
  CHECK(error_of({"-o", ""}).find("names no file") != std::string::npos);
  CHECK(error_of({"-o", "a.JPG"}) == "rondure: error: a.JPG: -o writes OpenEXR; for a PNG there is --png\n");
  CHECK(error_of({"--png", "a.exr"}) == "rondure: error: a.exr: --png writes PNG; for OpenEXR there is -o\n");
  CHECK(read_text_file(folder + "/net.json") == net);
}

TEST_CASE("a render needs nobody to read its notes", "[commands]") {
  const std::string folder = stage("render_deaf");
  ProcessOptions options;
  options.folder = folder;
  CHECK(run_process({"/bin/sh", "-c", "exec \"$0\" render ball.json 2> /dev/full", program_path()}, options)
            .exit_code == 0);
  CHECK(names_in(folder) == std::vector<std::string>{"ball.exr", "ball.json"});
}

TEST_CASE("an interrupted render writes nothing, or with --resume what it has", "[commands]") {
  const std::string folder = stage("render_interrupt");
  // Once it has taken more time than it takes to begin, three seconds by the clock of its threads (100 a
  // second), however long the machine lets it wait for that.
  const std::string script =
      "env --default-signal=INT \"$0\" render ball.json --spp 100000000 --quiet $2 &\n"
      "n=0\n"
      "until awk '{ exit !($14 + $15 >= 300) }' /proc/$!/stat || [ $((n += 1)) -gt 600 ]; do sleep 0.1; "
      "done\n"
      "kill -$1 $!; wait $!";
  const auto interrupt = [&](const std::string& extra, const std::string& signal = "INT") {
    ProcessOptions options;
    options.folder = folder;
    return run_process({"/bin/sh", "-c", script, program_path(), signal, extra}, options);
  };
  const ProcessResult plain = interrupt("");
  CHECK(plain.exit_code == 1);
  CHECK(plain.err == "rondure: error: interrupted; nothing was written\n");
  CHECK(names_in(folder) == std::vector<std::string>{"ball.json"});
  CHECK(interrupt("", "TERM").err == plain.err);
  const ProcessResult kept = interrupt("--resume", "XCPU");
  INFO(kept.err);
  CHECK(kept.exit_code == 1);
  CHECK(kept.err.find("samples a pixel are kept in ball.exr.state") != std::string::npos);
  CHECK(names_in(folder) == std::vector<std::string>{"ball.exr.state", "ball.json"});
}

TEST_CASE("without the image module a preview is refused before the work", "[commands]") {
  const std::string folder = stage("render_no_module");
  // The module is looked for beside the library: here is a copy of the library alone.
  const std::string library = folder + "/library";
  std::filesystem::create_directory(library);
  const std::filesystem::path built =
      std::filesystem::path(program_path()).parent_path().parent_path() / "lib";
  std::filesystem::copy_file(built / "librondure.so", library + "/librondure.so");
  ProcessOptions options;
  options.folder = folder;
  options.environment["LD_LIBRARY_PATH"] = library;
  const ProcessResult r = run_rondure({"render", "ball.json", "--png", "a.png", "--quiet"}, options);
  INFO(r.err);
  CHECK(r.exit_code == 1);
  CHECK(r.err.find(
            "rondure: error: picture files other than OpenEXR need the module librondure_images.so (with "
            "OpenImageIO): ") == 0);
  CHECK(names_in(folder) == std::vector<std::string>{"ball.json", "library"});
  // What needs no picture files works without it.
  CHECK(run_rondure({"render", "ball.json", "--quiet"}, options).exit_code == 0);
}

}  // namespace
}  // namespace rondure
