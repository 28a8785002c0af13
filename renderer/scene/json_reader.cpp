// nlohmann's parser decides what is JSON. It tells events, not places, so a cursor follows it through the
// text.
#include "renderer/scene/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "renderer/api/utf8.h"
#include "renderer/scene/text_cursor.h"
#include "renderer/scene/text_file.h"

namespace rondure {
namespace {

using Json = nlohmann::json;

// Receives the parser's events and grows the tree.
class TreeBuilder {
 public:
  TreeBuilder(const SourceText& source, Value& root) : source_(source), cursor_(source.text), root_(root) {}

  bool null() { return word(Value::Kind::null) != nullptr; }
  bool boolean(bool b) {
    word(Value::Kind::boolean)->boolean = b;
    return true;
  }
  bool number_integer(std::int64_t n) { return number(static_cast<double>(n), n >= -exact && n <= exact); }
  bool number_unsigned(std::uint64_t n) { return number(static_cast<double>(n), n <= std::uint64_t{exact}); }
  bool number_float(double x, const std::string&) {
    return number(x, x == std::floor(x) && std::fabs(x) <= static_cast<double>(exact));
  }
  bool string(std::string& s) {
    Value& value = place(Value::Kind::string);
    value.string = std::move(s);
    cursor_.pass_string();
    return true;
  }
  bool binary(Json::binary_t&) { return false; }  // text has none

  bool start_object(std::size_t) { return open(Value::Kind::object); }
  bool start_array(std::size_t) { return open(Value::Kind::array); }
  bool end_array() { return close(); }
  bool end_object() {
    refuse_duplicates(*open_.back());
    return close();
  }
  bool key(std::string& name) {
    cursor_.skip_to_token();
    open_.back()->members.push_back({std::move(name), cursor_.where(), {}});
    cursor_.pass_string();
    return true;
  }

  bool parse_error(std::size_t end, const std::string&, const Json::exception& error);

 private:
  static constexpr std::int64_t exact = std::int64_t{1} << 53;

  const SourceText& source_;
  TextCursor cursor_;
  Value& root_;
  std::size_t values_ = 0;
  std::vector<Value*> open_;    // innermost last; stable, since only the innermost grows
  SourcePosition word_;         // of the latest number or literal
  std::size_t word_start_ = 0;  // its offset

  [[noreturn]] void fail(SourcePosition where, const std::string& text) const {
    throw SceneError(&source_, where, text);
  }

  Value& place(Value::Kind kind) {
    cursor_.skip_to_token();
    if (++values_ > max_json_values)
      fail(cursor_.where(), fmt::format("more than {} values", max_json_values));
    Value* value = &root_;
    if (!open_.empty()) {
      Value& parent = *open_.back();
      value =
          parent.kind == Value::Kind::object ? &parent.members.back().value : &parent.items.emplace_back();
    }
    value->kind = kind;
    value->where = cursor_.where();
    return *value;
  }

  Value* word(Value::Kind kind) {
    Value& value = place(kind);
    word_ = value.where;
    word_start_ = cursor_.offset();
    cursor_.pass_word();
    return &value;
  }

  bool number(double x, bool integral) {
    Value* value = word(Value::Kind::number);
    value->number = x;
    value->integral = integral;
    return true;
  }

  bool open(Value::Kind kind) {
    Value& value = place(kind);
    open_.push_back(&value);
    if (open_.size() > static_cast<std::size_t>(max_json_depth)) {
      fail(value.where, fmt::format("nested deeper than {} levels", max_json_depth));
    }
    cursor_.pass_bracket();
    return true;
  }

  bool close() {
    cursor_.skip_to_token();
    cursor_.pass_bracket();
    open_.pop_back();
    return true;
  }

  void refuse_duplicates(const Value& object) const {
    std::vector<const Value::Member*> order;
    order.reserve(object.members.size());
    for (const Value::Member& member : object.members) order.push_back(&member);
    std::stable_sort(order.begin(), order.end(), [](auto* a, auto* b) { return a->key < b->key; });
    const Value::Member* first = nullptr;
    const Value::Member* again = nullptr;  // the earliest repetition in the file
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (order[i]->key != order[i - 1]->key || (again && order[i] > again)) continue;
      first = order[i - 1];
      again = order[i];
    }
    if (!again) return;
    fail(again->where,
         fmt::format("key \"{}\" stands twice in this object; the first is at line {}, column {}",
                     printable(again->key), first->where.line, first->where.column));
  }

  [[noreturn]] void refuse_word(SourcePosition where, std::size_t start, const std::string& what) const;
  std::string syntax_message(char found, const std::string& what) const;
};

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

// `end` is just behind the offending token; `error` says what the parser was about.
bool TreeBuilder::parse_error(std::size_t end, const std::string&, const Json::exception& error) {
  const std::string what = error.what();
  const std::string& text = source_.text;
  if (!cursor_.skip_to_token(end > 0 && end <= text.size() ? end - 1 : text.size())) {
    fail(cursor_.where(), "this comment is never closed");
  }
  if (cursor_.at_end()) {
    if (open_.empty()) fail(cursor_.where(), "the file is empty; a scene is an object, { ... }");
    const Value& inner = *open_.back();
    fail(inner.where,
         inner.kind == Value::Kind::object ? "this object is never closed" : "this array is never closed");
  }
  const SourcePosition where = cursor_.where();
  const char found = text[cursor_.offset()];
  if (found == '"' && has(what, "invalid string")) {
    if (has(what, "missing closing quote")) fail(where, "this string is never closed");
    if (has(what, "U+000A") || has(what, "U+000D")) fail(where, "this string is not closed on its line");
    cursor_.advance_to(std::min(end, text.size()) - 1);
    const std::size_t tail = what.find("invalid string: ") + 16;
    fail(cursor_.where(), "bad string: " + what.substr(tail, what.find("; last read") - tail));
  }
  if (has(what, "expected end of input")) fail(where, "nothing may follow the end of the scene");
  // Two tokens that stand together, as in 01 or truefalse: the cursor has passed the second with the first.
  if (cursor_.offset() >= end && end > word_start_) refuse_word(word_, word_start_, what);
  const std::size_t start = cursor_.offset();
  cursor_.pass_word();
  if (cursor_.offset() > start && (has(what, "last read") || has(what, "number overflow")))
    refuse_word(where, start, what);
  fail(where, syntax_message(found, what));
}

// Something made of letters, digits and signs that is no JSON; the cursor stands behind it.
void TreeBuilder::refuse_word(SourcePosition where, std::size_t start, const std::string& what) const {
  const std::string word = source_.text.substr(start, std::min<std::size_t>(cursor_.offset() - start, 40));
  if (has(what, "number overflow")) fail(where, fmt::format("{} is beyond the range of a double", word));
  std::string bare = word.substr(std::min(word.size(), word.find_first_not_of("+-")));
  for (char& c : bare) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  if (bare == "nan" || bare == "inf" || bare == "infinity") {
    fail(where, fmt::format("{} is not allowed: every number must be finite", word));
  }
  const bool numeric = std::string_view("+-.0123456789").find(word[0]) != std::string_view::npos;
  fail(where, numeric ? fmt::format("{} is not a JSON number", word)
                      : fmt::format("unexpected word {}; strings stand in double quotes", word));
}

std::string TreeBuilder::syntax_message(char found, const std::string& what) const {
  const char* expected = "a value";
  if (has(what, "parsing object key")) {
    expected = "a key in double quotes";
  } else if (has(what, "parsing object separator")) {
    expected = "\":\" after the key";
  } else if (has(what, "parsing array")) {
    expected = "\",\" or \"]\"";
  } else if (has(what, "parsing object")) {
    expected = "\",\" or \"}\"";
  }
  if (found == '"') return fmt::format("unexpected string; expected {}", expected);
  return fmt::format("unexpected {}; expected {}", printable(std::string(1, found)), expected);
}

}  // namespace

Document read_json_text(std::string name, std::string text) {
  Document document{std::make_shared<SourceText>(SourceText{std::move(name), std::move(text)}), {}};
  refuse_bad_text(*document.source);
  TreeBuilder builder(*document.source, document.root);
  const std::string& bytes = document.source->text;
  Json::sax_parse(bytes.begin(), bytes.end(), &builder, Json::input_format_t::json, true, true);
  return document;
}

Document read_json_file(const std::string& path) {
  return read_json_text(path, read_text_file(path, max_json_bytes));
}

}  // namespace rondure
