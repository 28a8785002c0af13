#include "renderer/render/interrupt.h"

#include <atomic>

namespace rondure {
namespace {

std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch no other variable");
std::array<struct sigaction, interrupting.size()> before;

// A limit of CPU time is told again each second, which is no second wish.
void note(int signal) {
  asked = true;
  for (std::size_t k = 0; k < interrupting.size(); ++k)
    if (interrupting[k] == signal && signal != SIGXCPU) sigaction(signal, &before[k], nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  asked = false;
  for (std::size_t k = 0; k < interrupting.size(); ++k) {
    sigaction(interrupting[k], nullptr, &before[k]);
    if (before[k].sa_handler == SIG_IGN) continue;  // as behind nohup
    struct sigaction action {};
    action.sa_handler = note;
    sigaction(interrupting[k], &action, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t k = 0; k < interrupting.size(); ++k) sigaction(interrupting[k], &before[k], nullptr);
}

bool interrupted() noexcept { return asked.load(std::memory_order_relaxed); }

}  // namespace rondure
