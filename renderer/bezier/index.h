// The place in a container of what is counted by a signed integer that is not negative.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rondure {

inline std::size_t index(std::int64_t k) { return static_cast<std::size_t>(k); }

}  // namespace rondure
