// What the fuzzers call with bytes that they make up, and the ordinary tests with the bytes of
// tests/fuzz/corpus.
//
// Bytes are refused by a std::runtime_error or std::invalid_argument, or they are taken; then everything that
// follows from them must be finite. Anything else is a finding, and leaves the function as a std::logic_error
// or as whatever was thrown.
#pragma once

#include <string_view>

namespace rondure {

void fuzz_scene(std::string_view bytes);      // a scene: read, compiled, traced, rendered
void fuzz_tables(std::string_view bytes);     // one byte that chooses the columns, then a table
void fuzz_overrides(std::string_view bytes);  // one --set a line, for a small scene
void fuzz_plugin(std::string_view bytes);     // ABI string, NUL, name, NUL, summary, NUL, a surface in binary

}  // namespace rondure
