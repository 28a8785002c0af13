// Input that is meant to hurt: one clear message and exit code 1, nothing left behind, in bounded time and
// memory.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>

#include "renderer/scene/json_reader.h"
#include "tests/catch.h"
#include "tests/commands/command_files.h"
#include "tests/paths.h"
#include "tests/process.h"

namespace rondure {
namespace {

// The first line is "rondure: error: " and `message` (or begins so), nothing else is said, and no file
// appears.
void check_refused(const std::string& folder, const std::vector<std::string>& arguments,
                   const std::string& message) {
  const std::vector<std::string> before = names_in(folder);
  const ProcessResult result = run_in(folder, arguments);
  CAPTURE(arguments, result.err, message);
  CHECK(result.err.starts_with("rondure: error: " + message));
  CHECK(result.err.find("rondure: error: ", 1) == std::string::npos);
  // What follows the first line is the file's, indented.
  for (std::size_t at = result.err.find('\n'); at + 1 < result.err.size(); at = result.err.find('\n', at + 1))
    CHECK(result.err[at + 1] == ' ');
  CHECK(result.err.size() < 4000);
  CHECK(result.exit_code == 1);
  CHECK(names_in(folder) == before);
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int k = 0; k < times; ++k) result += text;
  return result;
}

std::string bilinear(const std::string& degree, const std::string& net) {
  return R"({ "objects": [ { "type": "bezier", "patches": [ { "degree": )" + degree + R"(, "net": )" + net +
         " } ] } ] }";
}

TEST_CASE("hostile scenes are refused where they are hostile", "[commands][hostile]") {
  struct Row {
    std::string scene, message;
  };
  const std::string square = "[[[0,0,0,1],[0,1,0,1]],[[1,0,0,1],[1,1,0,1]]]";
  const std::string not_positive = "1:16: objects[0]: patch 0: a weight is not positive near (u, v) = (";
  const std::string no_area =
      "1:16: objects[0]: patch 0: has no area; its control points lie on a curve or in a point";
  const std::string range = "the scene is too large: its radius must be between 1e-60 and 1e+60";
  const std::string composed =
      R"({ "objects": [ { "type": "composed_patch", "of": { "type": "sphere_tiling" },)"
      "\n"
      R"("domain": { "degree": [1, 1], "net":)"
      "\n";
  const Row table[] = {
      {repeated("[", 1000000), "1:257: nested deeper than 256 levels"},
      {repeated("{\"objects\":", 100000), "1:2817: nested deeper than 256 levels"},
      {"[1e999]", "1:2: 1e999 is beyond the range of a double"},
      {"[-NaN]", "1:2: -NaN is not allowed: every number must be finite"},
      {"[" + repeated("9", 400) + "]", "1:2: "},
      {std::string("{\0}", 3), "1:2: byte 0x00 is not UTF-8 text"},
      {"\xed\xa0\x80", "1:1: byte 0xED is not UTF-8 text"},
      {"\xef\xbb\xbf[]", "1:4: the scene must be an object, { ... }, found an array of 0"},
      {bilinear("[0, 1]", square), "1:62: a degree must be an integer from 1 to 24"},
      {bilinear("[1, 1000]", square), "1:65: a degree must be an integer from 1 to 24"},
      {bilinear("[1, 1000000000]", square), "1:65: a degree must be an integer from 1 to 24"},
      {bilinear("[1, 1]", "[[[0,0,0,1],[0,-1,0,-1]],[[1,0,0,1],[1,1,0,1]]]"), not_positive},
      {bilinear("[1, 1]", "[[[0,0,0,1],[0,1,0,0]],[[1,0,0,1],[1,1,0,1]]]"), not_positive},
      {bilinear("[1, 1]", "[[[0,0,0,0],[0,0,0,0]],[[0,0,0,0],[0,0,0,0]]]"), "1:76: every weight is zero"},
      {bilinear("[1, 1]", "[[[0,0,0,1],[0,1,0,1]],[[1,0,0,1],[1e300,1e300,0,1e300]]]"),
       "1:16: objects[0]: patch 0: the weight of a corner is 1e-300 of the largest, and less than 1e-16"},
      {bilinear("[1, 1]", "[[[1,2,3,1],[1,2,3,1]],[[1,2,3,1],[1,2,3,1]]]"), no_area},
      {bilinear("[1, 1]", "[[[0,0,0,1],[0,1e300,0,1]],[[1e300,0,0,1],[1e300,1e300,0,1]]]"), "1:14: " + range},
      {R"({ "objects": [ { "type": "sphere_tiling", "radius": 1e300 } ] })", "1:14: " + range},
      {R"({ "objects": [ { "type": "sphere_tiling", "transform": [ { "scale": 1e300 }, { "scale": 1e300 } ] } ] })",
       "1:56: \"sphere_tiling\": its radius and transform multiply to a size that no number has"},
      {R"({ "objects": [ { "type": "iss", "patches": [ { "u": { "200": [1,0,0], "020": [0,1,0], "002": [0,0,1],)"
       R"("110": [0,0,1], "101": [0,1,0], "011": [1,0,0] } } ], "degree": 2 } ] })",
       "1:53: the directions form no spherical partition: "},
      {R"({ "objects": [ { "type": "gc_complex", "complex": { "polygons": [ [0,1,2], [0,1,2], [0,1,2] ] } } ] })",
       "1:85: the edge between vertices 0 and 1 belongs to more than two polygons"},
      {composed + "[[[0,0],[0,2]],[[1,0],[1,1]]] } } ] }", "3:1: \"domain\" reaches (0, 2), outside"},
      {composed + "[[[0,0],[1,1]],[[1,0],[0,1]]] } } ] }",
       "3:1: \"domain\" folds over: it keeps the orientation"},
      {R"({ "objects": [ { "type": "sphere_tiling", "show": ["isolines"], "isolines": 1000000000 } ] })",
       "1:77: \"isolines\" must be an integer in [1, 100], found 1000000000"},
      {R"({ "objects": [ { "type": "iss", "modify": [)" + repeated(R"({ "quarter": {} },)", 40) +
           R"({ "elevate": 4 } ] } ] })",
       "1:201: objects[0].modify[8].quarter: this makes more than 100000 patches"},
      {R"({ "integrator": { "type": "path", "max_depth": 1000000000 }, "objects": [ { "type": "sphere" } ] })",
       "1:48: \"max_depth\" must be an integer in [0, 100000], found 1000000000"},
      {R"({ "lights": [ { "type": "environment", "file": "a\u0000b" } ], "objects": [ { "type": "sphere" } ] })",
       "1:48: \"file\" must be a path"},
      {R"({ "lights": [ { "type": "environment", "file": ")" + repeated("x", 10000) +
           R"(" } ], "objects": [ { "type": "sphere" } ] })",
       "1:48: xxx"},
      {R"({ "objects": [ { "type": "bezier", "file": "scene.json" } ] })",
       "1:1: the file: \"patches\" is missing"},
      {R"({ "objects": [ { "type": "sphere", "material": ")" + repeated("x", 10000) + "\" } ] }",
       "1:48: unknown material \"xxx"},
  };
  for (const Row& row : table)
    check_refused(folder_with("hostile_scene", row.scene), {"validate", "scene.json"},
                  "scene.json:" + row.message);
}

TEST_CASE("hostile arguments are refused", "[commands][hostile]") {
  const std::string folder = folder_with("hostile_arguments");
  const std::string long_name(10000, 'x');
  check_refused(folder, {"validate", "scene.json", "--set", repeated("/a", 50000) + "=1"}, "--set /a/a");
  check_refused(folder, {"validate", "scene.json", "--set", "/objects/0/name=\xff\xfe"},
                "--set:1:17: byte 0xFF is not UTF-8 text");
  check_refused(folder, {"validate", "scene.json", "--set", "/objects/0/x=" + repeated("[", 1000)},
                "--set:1:257: nested deeper than 256 levels");
  check_refused(folder, {"validate", long_name}, "cannot read xxx");
  check_refused(folder, {"validate", "a\x1b[2Jb"}, "cannot read a?[2Jb: No such file or directory");
  check_refused(folder, {"render", "scene.json", "-o", long_name}, "xxx");
  check_refused(folder, {"trace", "scene.json", "--rays", long_name}, "xxx");
  check_refused(folder, {"list", "--plugin", long_name}, "plugin xxx");
  check_refused(folder, {"describe", long_name}, "unknown type \"xxx");
  check_refused(folder, {"render", "scene.json", "--resolution", "65536x65536", "-o", "o.exr"},
                "a picture of 65536 x 65536 pixels takes 1134 GB of memory, and there are ");
}

TEST_CASE("what is no file of text is no scene and no table", "[commands][hostile]") {
  const std::string folder = folder_with("hostile_files");
  std::filesystem::create_symlink("loop", folder + "/loop");
  write_text_file(folder + "/large.json", "{");
  std::filesystem::resize_file(folder + "/large.json",
                               std::uintmax_t{1} << 40);  // without taking up the disk
  check_refused(folder, {"validate", "loop"}, "cannot read loop: Too many levels of symbolic links");
  check_refused(folder, {"validate", "large.json"},
                fmt::format("cannot read large.json: it is larger than {} bytes", max_json_bytes));
  check_refused(folder, {"validate", "/dev/zero"},
                fmt::format("cannot read /dev/zero: it is larger than {} bytes", max_json_bytes));
  check_refused(folder, {"validate", "/dev/null"}, "/dev/null:1:1: the file is empty");
  check_refused(folder, {"trace", "scene.json", "--rays", "loop"},
                "loop: cannot be opened: Too many levels of symbolic links");
  check_refused(folder, {"trace", "scene.json", "--rays", "/dev/zero", "-o", "out.csv"},
                "/dev/zero:1:1: the line is longer than 4096 bytes");
  check_refused(folder, {"trace", "scene.json", "--rays", "large.json", "-o", "out.csv"}, "large.json:1:1: ");
}

TEST_CASE("an output goes where links lead, if they lead anywhere", "[commands][hostile]") {
  const std::string folder = folder_with("hostile_links");
  std::filesystem::create_symlink("loop", folder + "/loop");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"export", "scene.json", "-o", "loop"},
        {"render", "scene.json", "-o", "loop"},
        {"trace", "scene.json", "--rays", "scene.json", "-o", "loop"}}) {
    check_refused(folder, command, "loop: cannot write: Too many levels of symbolic links");
  }
  std::filesystem::create_directory(folder + "/elsewhere");
  std::filesystem::create_symlink("elsewhere/nets.json", folder + "/dangling");
  REQUIRE(run_in(folder, {"export", "scene.json", "-o", "dangling"}).exit_code == 0);
  CHECK(std::filesystem::is_symlink(folder + "/dangling"));
  CHECK(run_in(folder, {"validate", "elsewhere/nets.json"}).exit_code == 0);
}

TEST_CASE("broken environment images are refused in bounded memory", "[commands][hostile]") {
  const std::string folder = fresh_folder("hostile_images");
  write_text_file(folder + "/good.json", R"({ "objects": [ { "type": "sphere" } ] })");
  REQUIRE(run_in(folder, {"render", "good.json", "--resolution", "16x8", "--spp", "1", "--quiet", "-o",
                          "good.exr", "--png", "good.png"})
              .exit_code == 0);
  const std::string exr = read_text_file(folder + "/good.exr"), png = read_text_file(folder + "/good.png");
  // Four integers little end first; a window's stand 10 bytes behind its name and a zero byte: "box2i", zero,
  // size.
  const auto with_window = [&](const std::string& name, const std::string& corner) {
    std::string changed = exr;
    return changed.replace(changed.find(name + '\0' + "box2i") + name.size() + 19, 8, corner);
  };
  const std::string wide("\x9f\x86\x01\x00\x9f\x86\x01\x00", 8);  // 99999, 99999
  struct Row {
    std::string name, bytes, message;
  };
  const std::string radiance = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  const Row table[] = {
      {"empty.exr", "", ""},
      {"magic.exr", "XXXX" + exr.substr(4), "\"magic.exr\" is not an OpenEXR file"},
      {"header.exr", exr.substr(0, 200), ""},
      {"pixels.exr", exr.substr(0, exr.size() - 7), ""},
      {"display.exr", with_window("displayWindow", wide), "it claims 100000 x 100000 pixels"},
      {"text.png", "no picture", ""},
      {"half.png", png.substr(0, png.size() / 2), ""},
      {"tail.png", png.substr(0, png.size() - 30), ""},
      {"none.hdr", radiance + "-Y 8 +X 16\n", ""},
      {"huge.hdr", radiance + "-Y 1000000 +X 1000000\n", "it claims 1000000 x 1000000 pixels"},
      {"negative.hdr", radiance + "-Y -8 +X -16\n", ""},
      {"huge.pfm", "PF\n1000000 1000000\n-1.0\n", "it claims 1000000 x 1000000 pixels"},
      {"nan.pfm", std::string("PF\n1 1\n-1.0\n\x00\x00\xc0\x7f\x00\x00\x00\x00\x00\x00\x00\x00", 24), ""},
      {"dot.gif",
       std::string(
           "GIF89a\x01\x00\x01\x00\x80\x00\x00\x00\x00\x00\xff\xff\xff,\x00\x00\x00\x00\x01\x00\x01\x00"
           "\x00\x02\x02\x44\x01\x00;",
           35),
       "its format is gif; known: OpenEXR"},
      {"huge.ppm", "P6\n60000 60000\n255\n", "it claims 60000 x 60000 pixels"},
  };
  const auto scene_with = [&](const std::string& file) {
    write_text_file(folder + "/scene.json", R"({ "lights": [ { "type": "environment", "file": ")" + file +
                                                R"(" } ], "objects": [ { "type": "sphere" } ] })");
  };
  for (const Row& row : table) {
    write_text_file(folder + "/" + row.name, row.bytes);
    scene_with(row.name);
    const std::string kind = row.name == "nan.pfm" ? "the image holds a value" : "cannot read the image: ";
    check_refused(folder, {"validate", "scene.json"},
                  "scene.json:1:48: " + row.name + ": " + kind + row.message);
  }
  REQUIRE(mkfifo((folder + "/pipe.exr").c_str(), 0600) == 0);
  std::filesystem::create_directory(folder + "/folder.exr");
  std::filesystem::create_symlink("loop.exr", folder + "/loop.exr");
  for (const auto& [file, message] : {std::pair("pipe.exr", "not a regular file: pipe.exr"),
                                      std::pair("/dev/zero", "not a regular file: /dev/zero"),
                                      std::pair("folder.exr", "a folder, not a file: folder.exr"),
                                      std::pair("none.exr", "no such file: none.exr"),
                                      std::pair("loop.exr", "loop.exr: Too many levels of symbolic links")}) {
    scene_with(file);
    check_refused(folder, {"validate", "scene.json"}, std::string("scene.json:1:48: ") + message);
  }
  for (const char* file : {"pipe.exr", "/dev/zero"}) {
    write_text_file(folder + "/scene.json",
                    fmt::format(R"({{ "objects": [ {{ "type": "bezier", "file": "{}" }} ] }})", file));
    check_refused(folder, {"validate", "scene.json"},
                  std::string("scene.json:1:44: not a regular file: ") + file);
  }
}

TEST_CASE("samples are resumed from regular files alone", "[commands][hostile]") {
  const std::string folder = folder_with("hostile_state");
  REQUIRE(mkfifo((folder + "/o.exr.state").c_str(), 0600) == 0);
  check_refused(folder, {"render", "scene.json", "--resolution", "8x8", "--resume", "--quiet", "-o", "o.exr"},
                "o.exr.state: cannot hold samples: not a regular file");
  // One that is there and cannot be read, be it for want of rights, is not written over.
  std::filesystem::remove(folder + "/o.exr.state");
  std::filesystem::create_symlink("o.exr.state", folder + "/o.exr.state");
  check_refused(folder, {"render", "scene.json", "--resolution", "8x8", "--resume", "--quiet", "-o", "o.exr"},
                "o.exr.state: cannot read the samples to resume from: Too many levels of symbolic links");
}

// A pipe whose reader is gone before anything is written.
TEST_CASE("a reader that leaves is an error like a full disk", "[commands][hostile]") {
  const std::string folder = folder_with("hostile_pipe");
  write_text_file(folder + "/rays.csv", repeated("0,0,5,0,0,-1\n", 5000));
  for (const char* command : {"list", "info scene.json", "export scene.json", "validate scene.json",
                              "trace scene.json --rays rays.csv", "describe iss"}) {
    CAPTURE(command);
    const std::string shell =
        std::string("(sleep 0.2; \"$0\" ") + command + "; echo $? > code) 2> err | true";
    REQUIRE(run_process({"/bin/sh", "-c", shell, program_path()}, {folder, {}, ""}).exit_code == 0);
    CHECK(read_text_file(folder + "/code") == "1\n");
    CHECK(read_text_file(folder + "/err").starts_with("rondure: error: "));
  }
}

// Each file of the program meets a disk that is full at some byte: /dev/full refuses links, so a small file
// size limit stands in for it; a tmpfs needs rights that tests have not.
TEST_CASE("a disk that fills up leaves nothing behind", "[commands][hostile]") {
  const std::string folder = folder_with("hostile_disk");
  write_text_file(folder + "/rays.csv", repeated("0,0,5,0,0,-1\n", 5000));
  const std::vector<std::string> before = names_in(folder);
  for (const char* command :
       {"render scene.json --resolution 64x64 --spp 1 --quiet -o o.exr",
        "render scene.json --resolution 64x64 --spp 16 --quiet --resume -o o.exr",
        "trace scene.json --rays rays.csv -o o.csv", "export scene.json -o nets.json"}) {
    CAPTURE(command);
    const std::string shell = std::string("ulimit -f 8; exec \"$0\" ") + command;
    const ProcessResult result = run_process({"/bin/sh", "-c", shell, program_path()}, {folder, {}, ""});
    CAPTURE(result.err);
    CHECK(result.err.starts_with("rondure: error: "));
    CHECK(result.exit_code == 1);
    CHECK(names_in(folder) == before);
  }
}

// A table that is being written while its rays are still to come.
TEST_CASE("a program that is told to end leaves nothing behind", "[commands][hostile]") {
  const std::string folder = folder_with("hostile_signal");
  const std::vector<std::string> before = names_in(folder);
  for (const char* signal : {"INT", "TERM", "HUP", "XCPU"}) {
    CAPTURE(signal);
    // The pipe that is never written to keeps the program waiting; a shell's background would ignore Ctrl-C.
    const std::string shell =
        "mkfifo pipe; env --default-signal=INT \"$0\" trace scene.json --rays pipe -o o.csv & exec 3> pipe; "
        "n=0\n"
        "until ls | grep -q part || [ $((n += 1)) -gt 600 ]; do sleep 0.1; done\n"
        "ls > names; kill -$1 $!; wait $!; echo $? >> names; rm pipe";
    const ProcessResult result =
        run_process({"/bin/sh", "-c", shell, program_path(), signal}, {folder, {}, ""});
    CAPTURE(result.err);
    const std::string names = read_text_file(folder + "/names");
    CHECK(names.find("o.csv.part-") != std::string::npos);
    CHECK(names.find("\n1") != std::string::npos);  // 128 and the signal
    std::filesystem::remove(folder + "/names");
    CHECK(names_in(folder) == before);
  }
}

}  // namespace
}  // namespace rondure
