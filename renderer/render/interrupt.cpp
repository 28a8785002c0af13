#include "renderer/render/interrupt.h"

#include <array>
#include <atomic>

#include "renderer/film/ending_signals.h"

namespace rondure {
namespace {

std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch no other variable");
std::array<struct sigaction, ending_signals.size()> before;

// A limit of CPU time is told again each second, which is no second wish.
void note(int signal) {
  asked = true;
  for (std::size_t k = 0; k < ending_signals.size(); ++k)
    if (ending_signals[k] == signal && signal != SIGXCPU) sigaction(signal, &before[k], nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  asked = false;
  for (std::size_t k = 0; k < ending_signals.size(); ++k) {
    sigaction(ending_signals[k], nullptr, &before[k]);
    if (before[k].sa_handler == SIG_IGN) continue;  // as behind nohup
    struct sigaction action {};
    action.sa_handler = note;
    sigaction(ending_signals[k], &action, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t k = 0; k < ending_signals.size(); ++k) sigaction(ending_signals[k], &before[k], nullptr);
}

bool interrupted() noexcept { return asked.load(std::memory_order_relaxed); }

}  // namespace rondure
