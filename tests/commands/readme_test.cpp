// What the README shows must be true.
#include "tests/catch.h"
#include "tests/commands/command_files.h"
#include "tests/paths.h"

namespace rondure {

TEST_CASE("the README's scenes are valid", "[command]") {
  // A scene there is an indented block that opens and closes with a brace, on one line or on lines of their
  // own.
  std::vector<std::string> scenes;
  bool within = false;
  for (const std::string& line : lines_of(read_text_file(source_folder() + "/README.md"))) {
    const bool one_line = line.starts_with("    { \"objects\"");
    if (line == "    {" || one_line) {
      scenes.emplace_back();
      within = true;
    }
    if (within) scenes.back() += line + "\n";
    if (line == "    }" || one_line) within = false;
  }
  CHECK(scenes.size() == 2);
  for (const std::string& scene : scenes) {
    ProcessOptions in;
    in.folder = folder_with("readme", scene);
    const ProcessResult result = run_rondure({"validate", "scene.json"}, in);
    CHECK(result.err.empty());
    CHECK(result.exit_code == 0);
  }
}

}  // namespace rondure
