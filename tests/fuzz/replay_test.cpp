// What the fuzzers found once, and what they started from, without a fuzzer.
#include <filesystem>
#include <map>

#include "tests/catch.h"
#include "tests/fuzz/targets.h"
#include "tests/paths.h"
#include "tests/process.h"

namespace rondure {
namespace {

TEST_CASE("inputs that fuzzers came upon are taken or refused in good order", "[fuzz]") {
  const std::map<std::string, void (*)(std::string_view)> targets = {
      {"scene", fuzz_scene}, {"tables", fuzz_tables}, {"overrides", fuzz_overrides}, {"plugin", fuzz_plugin}};
  for (const auto& [name, target] : targets) {
    int replayed = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(source_folder() + "/tests/fuzz/corpus/" + name)) {
      CAPTURE(entry.path());
      CHECK_NOTHROW(target(read_text_file(entry.path().string())));
      ++replayed;
    }
    CAPTURE(name);
    CHECK(replayed > 0);
  }
}

}  // namespace
}  // namespace rondure
