// Ctrl-C as a question that long work may ask.
#pragma once

#include <csignal>

namespace rondure {

// While it lives, the first Ctrl-C makes `interrupted` true; a second one ends the program as usual. One at a
// time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  struct sigaction before_ {};
};

bool interrupted() noexcept;

}  // namespace rondure
