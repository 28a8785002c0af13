#include "renderer/study/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace rondure {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

std::string joined(const std::vector<std::string>& fields) {
  return fmt::format("{}\n", fmt::join(fields, ","));
}

}  // namespace

Table::Table(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  if (std::getline(lines, line)) columns_ = fields_of(line);
  while (std::getline(lines, line)) {
    rows_.push_back(fields_of(line));
    if (rows_.back().size() != columns_.size())
      throw std::runtime_error("a table's line has another count of fields");
  }
}

std::size_t Table::index(const std::string& column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) throw std::logic_error("no column " + column);
  return static_cast<std::size_t>(found - columns_.begin());
}

const std::string& Table::at(std::size_t row, const std::string& column) const {
  return rows_[row][index(column)];
}

double Table::number(std::size_t row, const std::string& column) const {
  const std::string& field = at(row, column);
  return field.empty() ? std::numeric_limits<double>::quiet_NaN() : std::strtod(field.c_str(), nullptr);
}

void Table::append(const Table& other) {
  if (columns_.empty()) columns_ = other.columns_;
  rows_.insert(rows_.end(), other.rows_.begin(), other.rows_.end());
}

std::string Table::text() const {
  std::string out = joined(columns_);
  for (const auto& row : rows_) out += joined(row);
  return out;
}

std::string csv_number(double x) { return std::isnan(x) ? "" : fmt::format("{:.17g}", x); }

}  // namespace rondure
