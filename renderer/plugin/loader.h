// Families and integrators from shared objects.
//
// A plugin has two C entry points: `const char* rondure_plugin_abi()` and
// `void rondure_plugin_register(rondure::Registry*)`. The first is called before anything else, and a plugin
// whose answer differs from the host's is refused. All of this is tried in a child process before, so that a
// file that ends the process that loads it is refused too. A plugin is never unloaded: what it registered
// lives in it.
#pragma once

#include <string>
#include <vector>

#include "renderer/api/registry.h"

namespace rondure {

// Loads one shared object, or every *.so of a folder in order of name. On an error, a std::runtime_error that
// names the file, `registry` is as it was before that file.
void load_plugin(const std::string& path, Registry& registry);

// Loads `paths` (from --plugin), then the entries of RONDURE_PLUGIN_PATH (files or folders, separated by
// colons), then the install's plugin folder if there is one. As with PATH, a file is skipped when one of the
// same name came before it.
void load_plugins(const std::vector<std::string>& paths, Registry& registry);

// Throws std::runtime_error, naming the plugin and both strings, unless `reported` (null counts as empty) is
// the host's ABI string.
void check_abi(const std::string& path, const char* reported);

// rondure/plugins beside the core library, wherever that is installed.
std::string installed_plugin_folder();

}  // namespace rondure
