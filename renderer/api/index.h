// The place in a container of a number that is kept as an int, and is not negative.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rondure {

inline std::size_t index(std::int64_t k) { return static_cast<std::size_t>(k); }

}  // namespace rondure
