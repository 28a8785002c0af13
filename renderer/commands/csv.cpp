#include "renderer/commands/csv.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <system_error>

#include "renderer/film/atomic_file.h"

namespace rondure {
namespace {

constexpr std::size_t longest_line = 4096;  // no row of numbers comes near it
constexpr std::string_view blanks = " \t\r";

bool blank(const std::string& line) { return line.find_first_not_of(blanks) == std::string::npos; }

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(blanks);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(blanks) - from + 1);
}

// Reads a line without ever holding more than `longest_line` of it.
bool read_line(std::FILE* in, std::string& line) {
  line.clear();
  int c;
  while ((c = getc_unlocked(in)) != EOF) {
    if (c == '\n') return true;
    line.push_back(static_cast<char>(c));
    if (line.size() > longest_line) return true;
  }
  return !line.empty();
}

// Bytes that a terminal should not see as they are become '?'.
std::string plain_bytes(std::string_view text) {
  std::string out(text.substr(0, 120));
  for (char& c : out)
    if (c == '\t' || static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e)
      c = c == '\t' ? ' ' : '?';
  return out;
}

}  // namespace

CsvReader::CsvReader(const std::string& path, std::vector<std::string> columns, std::size_t required)
    : name_(path == "-" ? "standard input" : path),
      columns_(std::move(columns)),
      required_(required),
      file_(nullptr, &std::fclose),
      in_(stdin) {
  if (path == "-") return;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw std::runtime_error(fmt::format("{}: is a folder, not a file", path));
  file_.reset(std::fopen(path.c_str(), "rb"));
  if (!file_) throw std::runtime_error(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  in_ = file_.get();
}

void CsvReader::fail_at(std::size_t byte, const std::string& message) const {
  const std::string caret =
      byte < 120 ? "\n    " + plain_bytes(line_) + "\n    " + std::string(byte, ' ') + "^" : "";
  throw std::runtime_error(fmt::format("{}:{}:{}: {}{}", name_, line_number_, byte + 1, message, caret));
}

void CsvReader::fail(std::size_t column, const std::string& message) const {
  fail_at(column < starts_.size() ? starts_[column] : line_.size(), message);
}

std::size_t CsvReader::index(const std::vector<double>& row, std::size_t column, std::size_t count,
                             const char* what) const {
  const double x = row[column];
  if (!(x >= 0.0) || !(x < static_cast<double>(count)) || x != std::floor(x))
    fail(column, fmt::format("there is no {} {:g}: expected an index from 0 to {}", what, x, count - 1));
  return static_cast<std::size_t>(x);
}

bool CsvReader::is_header() const {
  std::string_view rest = line_;
  for (std::size_t k = 0;; ++k) {
    const std::size_t comma = rest.find(',');
    if (k >= columns_.size() || trimmed(rest.substr(0, comma)) != columns_[k]) return false;
    if (comma == std::string_view::npos) return k + 1 >= required_;
    rest = rest.substr(comma + 1);
  }
}

bool CsvReader::next(std::vector<double>& row, std::size_t& present) {
  for (;;) {
    errno = 0;
    const bool more = read_line(in_, line_);
    if (std::ferror(in_)) {
      throw std::runtime_error(
          fmt::format("{}: reading failed after line {}: {}", name_, line_number_, std::strerror(errno)));
    }
    if (!more) return false;
    ++line_number_;
    if (line_number_ == 1 && line_.starts_with("\xef\xbb\xbf")) line_.erase(0, 3);  // a byte order mark
    if (blank(line_)) continue;
    const bool may_be_header = first_;
    first_ = false;
    if (may_be_header && is_header()) continue;
    break;
  }
  if (line_.size() > longest_line) fail_at(0, fmt::format("the line is longer than {} bytes", longest_line));
  row.assign(columns_.size(), 0.0);
  starts_.clear();
  present = 0;
  std::size_t at = 0;
  for (;;) {
    const std::size_t comma = std::min(line_.find(',', at), line_.size());
    const std::string_view raw = std::string_view(line_).substr(at, comma - at);
    const std::size_t lead = raw.find_first_not_of(blanks);
    std::string_view field = trimmed(raw);
    starts_.push_back(at + (lead == std::string_view::npos ? 0 : lead));
    if (present == columns_.size())
      fail(present,
           fmt::format("expected {} columns at most ({})", columns_.size(), fmt::join(columns_, ",")));
    if (field.starts_with('+') && !field.starts_with("+-")) field.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    const bool whole = !field.empty() && end == field.data() + field.size();
    if (whole && error == std::errc::result_out_of_range)
      fail(present, fmt::format("\"{}\" is out of a double's range", columns_[present]));
    if (present == 0 && field == columns_[0])
      fail(0, fmt::format("a header must name the columns in this order: {}", fmt::join(columns_, ",")));
    if (!whole || error != std::errc() || std::isnan(value))
      fail(present,
           fmt::format("\"{}\" must be a number, found \"{}\"", columns_[present], plain_bytes(field)));
    row[present++] = value;
    if (comma == line_.size()) break;
    at = comma + 1;
  }
  if (present < required_)
    fail(present,
         fmt::format("expected {} columns{} ({}), found {}", required_,
                     required_ < columns_.size() ? " at least" : "", fmt::join(columns_, ","), present));
  return true;
}

TextOutput::TextOutput(const std::string& path) : path_(path), out_(&std::cout) {
  if (path == "-") return;
  file_ = std::make_unique<AtomicFile>(path);
  stream_.open(file_->temporary(), std::ios::binary);
  out_ = &stream_;
  check();
}

TextOutput::~TextOutput() = default;

void TextOutput::check() {
  if (!*out_)
    throw std::runtime_error(fmt::format("{}: writing failed", path_ == "-" ? "standard output" : path_));
}

void TextOutput::write(const std::string& text) {
  out_->write(text.data(), static_cast<std::streamsize>(text.size()));
  check();
}

void TextOutput::finish() {
  out_->flush();
  check();
  if (!file_) return;
  stream_.close();
  check();
  file_->commit();
}

}  // namespace rondure
