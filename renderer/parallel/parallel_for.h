// Loops over all threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

#include "renderer/parallel/handover.h"

namespace rondure {

// body(k) for every k below `count`, in any order. An exception of a body ends the loop and comes out of it.
template <class Body, class Partitioner = tbb::auto_partitioner>
void parallel_for(std::size_t count, const Body& body, const Partitioner& partitioner = {}) {
  Handover there, back;
  struct Giver {  // also when a body throws
    Handover& handover;
    ~Giver() { handover.give(); }
  };
  there.give();
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count),
      [&](const tbb::blocked_range<std::size_t>& range) {
        there.take();
        const Giver giver{back};
        for (std::size_t k = range.begin(); k < range.end(); ++k) body(k);
      },
      partitioner);
  back.take();
}

}  // namespace rondure
