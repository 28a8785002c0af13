// Ctrl-C, and what batch systems say instead, as a question that long work may ask.
#pragma once

namespace rondure {

// While it lives, the first of the signals that ask the program to end (ending_signals.h) makes `interrupted`
// true; the same a second time does what it did before, which is to end the program. Those that were ignored
// stay ignored. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

bool interrupted() noexcept;

}  // namespace rondure
