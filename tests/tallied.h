// What many blocks of a test find, over all threads.
#pragma once

#include <mutex>

#include "renderer/parallel/parallel_for.h"

namespace rondure {

// count(k, tally) for every block k below `blocks`, in any order, each with a tally of its own; all of them
// merged.
template <class Tally, class Count>
Tally tallied(std::size_t blocks, const Count& count) {
  Tally sum;
  std::mutex mutex;
  parallel_for(blocks, [&](std::size_t k) {
    Tally own;
    count(k, own);
    const std::lock_guard lock(mutex);
    sum.merge(own);
  });
  return sum;
}

}  // namespace rondure
