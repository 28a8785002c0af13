// From one thread to others, as ThreadSanitizer sees it.
//
// The libraries that start threads here (TBB, and Embree through it) are not instrumented: TSan sees neither
// that a task starts after what its starter wrote nor that the starter goes on after what the task wrote, and
// would report both. A Handover says so; what tasks do to one another stays checked. Without TSan nothing is
// left of it.
#pragma once

#if defined(__SANITIZE_THREAD__)
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace rondure {

class Handover {
 public:
  void give() noexcept {
#if defined(__SANITIZE_THREAD__)
    __tsan_release(this);
#endif
  }
  void take() noexcept {
#if defined(__SANITIZE_THREAD__)
    __tsan_acquire(this);
#endif
  }
};

}  // namespace rondure
