// Runs a program and keeps what it said: for tests of the command line.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace rondure {

struct ProcessResult {
  int exit_code = -1;  // 128 + n when signal n ended the process
  std::string out;
  std::string err;
};

struct ProcessOptions {
  std::string folder;                              // working folder; empty: the present one
  std::map<std::string, std::string> environment;  // added to the present one
  std::string input;                               // standard input
};

// `arguments[0]` is the program, searched in PATH when it has no slash. Throws std::runtime_error when it
// cannot be started. Nothing passes through a shell.
ProcessResult run_process(const std::vector<std::string>& arguments, const ProcessOptions& options = {});

// The built `rondure` with these arguments.
ProcessResult run_rondure(std::vector<std::string> arguments, const ProcessOptions& options = {});

// A fresh empty folder under the build tree; a left-over from an earlier run is removed.
std::string fresh_folder(const std::string& name);

std::string read_text_file(const std::string& path);  // throws when it cannot
void write_text_file(const std::string& path, const std::string& text);

}  // namespace rondure
