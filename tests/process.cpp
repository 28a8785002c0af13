#include "tests/process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/paths.h"

namespace rondure {
namespace {

// Standard streams go through files: pipes would need a poll loop to be free of deadlock.
void redirect(const std::string& path, int flags, int target) {
  const int file = open(path.c_str(), flags, 0600);
  if (file < 0 || dup2(file, target) < 0) _exit(127);
  close(file);
}

}  // namespace

std::string read_text_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_text_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

std::string fresh_folder(const std::string& name) {
  const std::string path = scratch_folder() + "/" + name;
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path;
}

ProcessResult run_process(const std::vector<std::string>& arguments, const ProcessOptions& options) {
  std::string streams = scratch_folder() + "/process_XXXXXX";
  if (!mkdtemp(streams.data())) throw std::runtime_error("cannot make a folder like " + streams);
  write_text_file(streams + "/in", options.input);

  // Everything that allocates happens before fork: another thread may hold the allocator's lock.
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const std::string in = streams + "/in", out = streams + "/out", err = streams + "/err";
  std::vector<std::string> variables;
  for (const auto& [name, value] : options.environment) variables.push_back(name + "=" + value);

  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) {
    redirect(in, O_RDONLY, STDIN_FILENO);
    redirect(out, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(err, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) _exit(127);
    for (std::string& variable : variables) putenv(variable.data());
    execvp(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw std::runtime_error("lost " + arguments.front());

  ProcessResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (result.exit_code == 127) throw std::runtime_error("cannot start " + arguments.front());
  result.out = read_text_file(out);
  result.err = read_text_file(err);
  std::filesystem::remove_all(streams);
  return result;
}

ProcessResult run_rondure(std::vector<std::string> arguments, const ProcessOptions& options) {
  arguments.insert(arguments.begin(), program_path());
  return run_process(arguments, options);
}

}  // namespace rondure
