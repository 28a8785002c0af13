// Loops over all threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

#include "renderer/parallel/handover.h"

namespace rondure {

// What TBB copies from task to task: ThreadSanitizer must not look before the handover is taken.
template <class Part>
struct Task {
  Handover* there;
  const Part* part;

  __attribute__((no_sanitize_thread)) void operator()(const tbb::blocked_range<std::size_t>& range) const {
    there->take();
    (*part)(range.begin(), range.end());
  }
};

// body(k) for every k below `count`, in any order. An exception of a body ends the loop and comes out of it.
template <class Body, class Partitioner = tbb::auto_partitioner>
void parallel_for(std::size_t count, const Body& body, const Partitioner& partitioner = {}) {
  Handover there, back;
  // Also when a body throws.
  struct Giver {
    Handover& handover;
    ~Giver() { handover.give(); }
  };
  struct Taker {
    Handover& handover;
    ~Taker() { handover.take(); }
  };
  const auto part = [&](std::size_t begin, std::size_t end) {
    const Giver giver{back};
    for (std::size_t k = begin; k < end; ++k) body(k);
  };
  const Taker taker{back};
  there.give();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), Task<decltype(part)>{&there, &part},
                    partitioner);
}

}  // namespace rondure
