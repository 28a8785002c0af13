// The program: one sub-command a run. The only place that catches.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>

#include "renderer/commands/command_line.h"
#include "renderer/plugin/builtin.h"
#include "renderer/plugin/loader.h"

namespace rondure {
namespace {

// A standard descriptor that came closed would go to the next file that is opened, and messages would land in
// that file. It becomes /dev/null, opened the wrong way round: reading and writing still fail, as they
// should.
void hold_standard_descriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free descriptor is this one.
    if (open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY) != descriptor)
      throw std::runtime_error("a standard descriptor is closed, and /dev/null does not open");
  }
}

// A full disk shows only when the buffers are emptied.
void flush_output() {
  if (!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout))
    throw std::runtime_error("cannot write to standard output");
}

int run(int argc, char** argv) {
  hold_standard_descriptors();
  const CommandLine line = read_command_line(argc, argv);
  if (line.action) {
    Registry registry;
    register_builtins(registry);
    load_plugins(line.plugins, registry);
    line.action(registry);
  }
  flush_output();
  return 0;
}

int fail(const char* message) {
  // Nothing is left to do where even this cannot be written; fmt::print would throw.
  for (const char* text : {"rondure: error: ", message, "\n"}) std::fputs(text, stderr);
  return 1;
}

}  // namespace
}  // namespace rondure

int main(int argc, char** argv) {
  try {
    return rondure::run(argc, argv);
  } catch (const std::bad_alloc&) {
    return rondure::fail("out of memory");
  } catch (const std::exception& error) {
    return rondure::fail(error.what());
  }
}
