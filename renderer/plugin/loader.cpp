#include "renderer/plugin/loader.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "renderer/api/abi.h"
#include "renderer/api/utf8.h"
#include "renderer/plugin/trial.h"

namespace rondure {
namespace {

namespace fs = std::filesystem;

constexpr AbiString host_abi = abi_string();

using AbiEntry = const char* (*)();
using RegisterEntry = void (*)(Registry*);

template <class Entry>
Entry entry_point(void* library, const char* name, const std::string& path) {
  void* symbol = dlsym(library, name);
  if (!symbol)
    throw std::runtime_error("plugin " + path + ": it has no entry point " + name +
                             "; build it with rondure_add_plugin of Rondure's CMake package");
  return reinterpret_cast<Entry>(symbol);
}

// dlerror's text opens with the path as it was opened; the caller's message names it already.
std::string load_error(const std::string& opened) {
  const char* error = dlerror();
  std::string text = error ? error : "unknown error";
  if (text.starts_with(opened + ": ")) text.erase(0, opened.size() + 2);
  return text;
}

// Calls into the plugin; what it throws becomes an error that names it.
template <class Call>
auto guarded(const std::string& path, const char* doing, const Call& call) {
  try {
    return call();
  } catch (const std::exception& error) {
    throw std::runtime_error("plugin " + path + ": " + doing + " failed: " + error.what());
  } catch (...) {
    throw std::runtime_error("plugin " + path + ": " + doing + " failed with an exception of unknown type");
  }
}

void load_now(const std::string& path, const std::string& opened, Registry& registry) {
  void* library = dlopen(opened.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) throw std::runtime_error("plugin " + path + ": it cannot be loaded: " + load_error(opened));
  const auto abi = entry_point<AbiEntry>(library, "rondure_plugin_abi", path);
  const auto register_all = entry_point<RegisterEntry>(library, "rondure_plugin_register", path);
  check_abi(path, guarded(path, "telling its ABI", abi));
  Registry extended = registry;  // so that a plugin that fails half-way leaves nothing behind
  guarded(path, "registration", [&] { register_all(&extended); });
  registry = std::move(extended);
}

void load_file(const std::string& path, Registry& registry) {
  // A name without a slash would be searched for in the system's library folders.
  const std::string opened = fs::absolute(path).string();
  std::error_code error;
  const fs::file_status status = fs::status(opened, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw std::runtime_error("plugin " + path + ": it cannot be loaded: not a regular file");
  // The loader reads what a cut-off file lacks, and nobody can catch what a constructor throws.
  const std::string end = end_of_trial([&] {
    Registry scratch = registry;
    load_now(path, opened, scratch);
  });
  if (!end.empty())
    throw std::runtime_error("plugin " + path + ": it ends the process that loads it: " + end);
  load_now(path, opened, registry);
  registry.add_plugin(opened);
}

// The shared objects that `path` stands for: itself, or a folder's *.so.
std::vector<std::string> files_of(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
    throw std::runtime_error("plugin " + path + ": there is no such file or folder");
  if (status.type() != fs::file_type::directory) return {path};
  std::vector<std::string> files;
  fs::directory_iterator folder(path, error);
  if (error) throw std::runtime_error("plugin folder " + path + ": it cannot be read: " + error.message());
  for (const fs::directory_entry& entry : folder)
    if (entry.path().extension() == ".so") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

void check_abi(const std::string& path, const char* reported) {
  const std::string_view found = reported ? reported : "";
  if (found == host_abi.text) return;
  throw std::runtime_error(
      "plugin " + path + ": it was built for another Rondure; rebuild it against this one\n" +
      "  this program: " + host_abi.text + "\n  the plugin:   " + printable(found, sizeof host_abi.text));
}

void load_plugin(const std::string& path, Registry& registry) {
  for (const std::string& file : files_of(path)) load_file(file, registry);
}

std::string installed_plugin_folder() {
  Dl_info info{};
  if (!dladdr(&host_abi, &info) || !info.dli_fname) return {};
  std::error_code error;
  const fs::path library = fs::canonical(info.dli_fname, error);
  return error ? std::string() : (library.parent_path() / "rondure" / "plugins").string();
}

void load_plugins(const std::vector<std::string>& paths, Registry& registry) {
  std::set<std::string> loaded;  // names of files
  const auto load_place = [&](const std::vector<std::string>& place) {
    for (const std::string& path : place) {
      for (const std::string& file : files_of(path)) {
        const std::string name = fs::path(file).filename().string();
        if (!loaded.insert(name).second) continue;
        load_file(file, registry);
      }
    }
  };

  load_place(paths);
  if (const char* variable = std::getenv("RONDURE_PLUGIN_PATH")) {
    std::vector<std::string> place;
    std::istringstream stream{std::string(variable)};
    for (std::string path; std::getline(stream, path, ':');)
      if (!path.empty()) place.push_back(path);
    try {
      load_place(place);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{} (named in RONDURE_PLUGIN_PATH)", error.what()));
    }
  }
  const std::string installed = installed_plugin_folder();
  if (!installed.empty() && fs::is_directory(installed)) load_place({installed});
}

}  // namespace rondure
