#include "renderer/bezier/triangle_keys.h"

#include <fmt/format.h>

#include "renderer/api/patch.h"

namespace rondure {

std::optional<std::size_t> triangle_key(int n, const std::string& key) {
  const bool separated = key.find(',') != std::string::npos;
  int part = 0, digits = 0;
  int index[3] = {0, 0, 0};
  for (const char c : key) {
    if (c == ',') {
      if (digits == 0 || ++part > 2) return std::nullopt;
      digits = 0;
      continue;
    }
    if (c < '0' || c > '9') return std::nullopt;
    if (!separated && digits == 1) {
      if (++part > 2) return std::nullopt;
      digits = 0;
    }
    if (++digits > 2) return std::nullopt;
    index[part] = index[part] * 10 + (c - '0');
  }
  if (part != 2 || digits == 0 || index[0] + index[1] + index[2] != n) return std::nullopt;
  return static_cast<std::size_t>(triangle_index(n, index[0], index[1]));
}

std::string triangle_key_name(int n, int i, int j) {
  return n < 10 ? fmt::format("{}{}{}", i, j, n - i - j) : fmt::format("{},{},{}", i, j, n - i - j);
}

}  // namespace rondure
