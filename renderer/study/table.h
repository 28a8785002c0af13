// Tables of comma-separated values, as the studies write them and read them again.
#pragma once

#include <string>
#include <vector>

namespace rondure {

class Table {
 public:
  Table() = default;
  // Takes apart what `text` gave. Fields hold no commas, quotes or line breaks.
  explicit Table(const std::string& text);

  std::size_t size() const { return rows_.size(); }
  const std::string& at(std::size_t row, const std::string& column) const;
  double number(std::size_t row, const std::string& column) const;  // NaN for an empty field
  // Adds the rows of a table with the same columns.
  void append(const Table& other);
  std::string text() const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;

  std::size_t index(const std::string& column) const;
};

// 17 significant digits; empty for NaN.
std::string csv_number(double x);

}  // namespace rondure
