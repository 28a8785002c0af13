#include "renderer/plugin/trial.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

namespace rondure {
namespace {

constexpr int came_back = 113;     // no exit code that a plugin is likely to choose
constexpr unsigned patience = 20;  // seconds

[[noreturn]] void try_out(const std::function<void()>& call) {
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, descriptor);
  std::signal(SIGALRM, SIG_DFL);
  alarm(patience);
  try {
    call();
  } catch (...) {  // the caller's own attempt will tell
  }
  _exit(came_back);
}

}  // namespace

std::string end_of_trial(const std::function<void()>& call) {
  const pid_t child = fork();
  if (child < 0)
    throw std::runtime_error(std::string("no process to try a plugin in: ") + std::strerror(errno));
  if (child == 0) try_out(call);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR)
      throw std::runtime_error(std::string("waiting for a trial failed: ") + std::strerror(errno));
  }
  if (WIFSIGNALED(status)) return strsignal(WTERMSIG(status));
  const int code = WEXITSTATUS(status);
  return code == came_back ? "" : "exit code " + std::to_string(code);
}

}  // namespace rondure
