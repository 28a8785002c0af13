// Points and vectors of a scene that are not themselves values of a key.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "renderer/api/params.h"

namespace rondure {

// N finite numbers; anything else is an error: "`subject` must be `form`".
template <std::size_t N>
std::array<double, N> read_numbers(const Params& params, const Value& value, const std::string& subject,
                                   const char* form) {
  std::array<double, N> numbers{};
  bool good = value.kind == Value::Kind::array && value.items.size() == N;
  for (std::size_t k = 0; good && k < N; ++k) {
    numbers[k] = value.items[k].number;
    good = value.items[k].kind == Value::Kind::number && std::isfinite(numbers[k]);
  }
  if (!good) params.fail(value, fmt::format("{} must be {}", subject, form));
  return numbers;
}

}  // namespace rondure
