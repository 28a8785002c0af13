#include "renderer/render/interrupt.h"

#include <atomic>

namespace rondure {
namespace {

std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch no other variable");
std::array<struct sigaction, interrupting.size()> before;

void restore() {
  for (std::size_t k = 0; k < interrupting.size(); ++k) sigaction(interrupting[k], &before[k], nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  asked = false;
  for (std::size_t k = 0; k < interrupting.size(); ++k) {
    sigaction(interrupting[k], nullptr, &before[k]);
    if (before[k].sa_handler == SIG_IGN) continue;  // as behind nohup
    struct sigaction action {};
    action.sa_handler = [](int) {
      asked = true;
      restore();
    };
    sigaction(interrupting[k], &action, nullptr);
  }
}

InterruptGuard::~InterruptGuard() { restore(); }

bool interrupted() noexcept { return asked.load(std::memory_order_relaxed); }

}  // namespace rondure
