// Tables of numbers as comma-separated text, read and written a block at a time.
#pragma once

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace rondure {

// Rows of numbers. A first line of column names is optional, but must be `columns` if it is there; blank
// lines are skipped. Errors are std::runtime_errors with file, line, column, the line and a caret; a failure
// to read is one, and no end.
class CsvReader {
 public:
  // `path`: a file, or "-" for standard input. Rows have all `columns`, or the first `required` of them.
  CsvReader(const std::string& path, std::vector<std::string> columns, std::size_t required);

  // The next row, of `columns` size; `present` of them stand in the file. False at the end.
  bool next(std::vector<double>& row, std::size_t& present);
  // The number in `column` as an index below `count` of the things called `what`; refuses others.
  std::size_t index(const std::vector<double>& row, std::size_t column, std::size_t count,
                    const char* what) const;
  // Refuses the row last read. `column` is an index into the columns.
  [[noreturn]] void fail(std::size_t column, const std::string& message) const;

 private:
  std::string name_;
  std::vector<std::string> columns_;
  std::size_t required_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;  // none for standard input
  std::FILE* in_;
  std::string line_;
  std::int64_t line_number_ = 0;
  bool first_ = true;
  std::vector<std::size_t> starts_;  // of the last row's fields, in bytes from the start of the line

  [[noreturn]] void fail_at(std::size_t byte, const std::string& message) const;
  bool is_header() const;
};

class AtomicFile;

// Text to a file that appears whole or not at all, or to standard output for "-".
class TextOutput {
 public:
  explicit TextOutput(const std::string& path);
  ~TextOutput();

  void write(const std::string& text);
  // Throws when anything did not reach its place; without it a file is not created.
  void finish();

 private:
  std::string path_;
  std::unique_ptr<AtomicFile> file_;
  std::ofstream stream_;
  std::ostream* out_;

  void check();
};

}  // namespace rondure
