// Names of coefficients of triangular nets: "ijk" for u^i v^j w^k, "i,j,k" from degree 10 on.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace rondure {

// The place (triangle_index) that a key names in a net of degree n, in either form; empty when it names none.
std::optional<std::size_t> triangle_key(int n, const std::string& key);

std::string triangle_key_name(int n, int i, int j);

}  // namespace rondure
