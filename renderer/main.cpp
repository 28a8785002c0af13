// The program: one sub-command a run. The only place that catches.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include "renderer/api/utf8.h"
#include "renderer/commands/command_line.h"
#include "renderer/film/atomic_file.h"
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
  // Who no longer reads is an error like a full disk, and no sudden end; and so is a file that may not grow.
  std::signal(SIGPIPE, SIG_IGN), std::signal(SIGXFSZ, SIG_IGN);
  delete_unfinished_on_signals();
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

// Names come from anywhere: nothing in them steers a terminal, and none fills a screen.
std::string for_terminal(std::string_view message) {
  constexpr std::size_t longest = 800, tail = 200;  // characters of a line, and of its end where it is cut
  std::string text;
  for (std::size_t at = 0; at <= message.size();) {
    const std::size_t end = std::min(message.find('\n', at), message.size());
    std::string line = printable(message.substr(at, end - at), std::string::npos);
    if (line.size() > longest) {
      const auto whole = [&](std::size_t byte) {  // the start of a character
        while ((static_cast<unsigned char>(line[byte]) & 0xC0) == 0x80) --byte;
        return byte;
      };
      line = line.substr(0, whole(longest - tail)) + "..." + line.substr(whole(line.size() - tail));
    }
    text += line + "\n";
    at = end + 1;
  }
  return text;
}

int fail(const char* message) {
  // Nothing is left to do where even this cannot be written; fmt::print would throw.
  for (const std::string& text : {std::string("rondure: error: "), for_terminal(message)})
    std::fputs(text.c_str(), stderr);
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
  } catch (...) {  // of a plugin
    return rondure::fail("an exception of unknown type");
  }
}
