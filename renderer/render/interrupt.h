// Ctrl-C, and what batch systems say instead, as a question that long work may ask.
#pragma once

#include <array>
#include <csignal>

namespace rondure {

// Ctrl-C, a request to end, a terminal that closes, and a limit of CPU time that is reached.
inline constexpr std::array interrupting{SIGINT, SIGTERM, SIGHUP, SIGXCPU};

// While it lives, the first of these signals makes `interrupted` true; the same a second time does what it
// did before, which is to end the program. Those that were ignored stay ignored. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

bool interrupted() noexcept;

}  // namespace rondure
