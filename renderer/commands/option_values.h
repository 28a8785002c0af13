// What options of the command line take: checks for CLI11, whose complaint is the text behind the option's
// name, and readers.
#pragma once

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <charconv>
#include <cstdint>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace rondure {

// For options whose empty value CLI11 takes for none.
inline CLI::Validator not_empty(const char* complaint) {
  return CLI::Validator([complaint](const std::string& value) { return value.empty() ? complaint : ""; }, "");
}

// Names separated by commas, none of them empty.
inline CLI::Validator are_names() {
  return CLI::Validator(
      [](const std::string& value) {
        return ("," + value + ",").find(",,") != std::string::npos ? "has an empty name" : "";
      },
      "");
}

// The names of every time that the option stands.
inline std::vector<std::string> split_names(const std::vector<std::string>& lists) {
  std::vector<std::string> names;
  for (const std::string& list : lists) {
    std::istringstream text(list);
    for (std::string name; std::getline(text, name, ',');) names.push_back(name);
  }
  return names;
}

// Whole numbers. Of larger ones than 64 bits hold CLI11 takes the largest that they do.
inline CLI::Validator is_integer() {
  return CLI::Validator(
      [](const std::string& value) -> std::string {
        std::int64_t number;
        const char* end = value.data() + value.size();
        const auto [stop, error] = std::from_chars(value.data(), end, number);
        if (error == std::errc::result_out_of_range)
          return fmt::format("takes a number up to {}, found {}", INT64_MAX, value);
        return error == std::errc{} && stop == end ? ""
                                                   : fmt::format("takes an integer, found \"{}\"", value);
      },
      "");
}

// Two positive integers around an x.
inline bool parse_resolution(const std::string& text, std::pair<std::int64_t, std::int64_t>& size) {
  const char* end = text.data() + text.size();
  const auto [middle, error] = std::from_chars(text.data(), end, size.first);
  if (error != std::errc{} || middle == end || (*middle != 'x' && *middle != 'X')) return false;
  const auto [stop, error2] = std::from_chars(middle + 1, end, size.second);
  return error2 == std::errc{} && stop == end && size.first > 0 && size.second > 0;
}

}  // namespace rondure
