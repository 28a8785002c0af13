// Shared objects that are no plugins. Real plugins are in out_of_tree_test.cpp.
#include "renderer/plugin/loader.h"

#include <cstdlib>
#include <filesystem>

#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/process.h"

namespace rondure {
namespace {

std::string message_of(const std::string& path) {
  Registry registry;
  try {
    load_plugin(path, registry);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("a file that is no plugin is refused by name and reason", "[plugin]") {
  const std::string folder = fresh_folder("loader");
  write_text_file(folder + "/text.so",
                  "this is no shared object, only a text of some length, to be read as one");
  write_text_file(folder + "/empty.so", "");
  CHECK(message_of(folder + "/nowhere.so") ==
        "plugin " + folder + "/nowhere.so: there is no such file or folder");
  CHECK(message_of(folder + "/text.so") ==
        "plugin " + folder + "/text.so: it cannot be loaded: invalid ELF header");
  CHECK(message_of(folder + "/empty.so") ==
        "plugin " + folder + "/empty.so: it cannot be loaded: file too short");
  // A folder stands for its *.so, in order of name: the empty one comes first.
  CHECK(message_of(folder) == "plugin " + folder + "/empty.so: it cannot be loaded: file too short");
}

TEST_CASE("a folder without shared objects holds no plugins", "[plugin]") {
  const std::string folder = fresh_folder("loader_folder");
  write_text_file(folder + "/readme.txt", "nothing to load");
  CHECK(message_of(folder) == "no error");
}

TEST_CASE("the plugin folder lies beside the core library", "[plugin]") {
  CHECK(installed_plugin_folder() ==
        std::filesystem::canonical(build_folder()).string() + "/lib/rondure/plugins");
}

}  // namespace rondure
