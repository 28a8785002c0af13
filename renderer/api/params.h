// Typed access to one JSON object of a scene, for plugins that know nothing of JSON.
//
// Every reader call marks its key as read; `finish` then refuses the keys that nobody asked for. All errors
// are SceneErrors that point at file, line and column.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

class Registry;

// A scene file's text, kept so that messages can show the line.
struct SourceText {
  std::string name;  // path as the user gave it
  std::string text;
};

struct SourcePosition {
  int line = 0;    // 1-based; 0 when there is none (a value set from the command line)
  int column = 0;  // 1-based, in bytes
};

// The message is complete: "file:line:column: text", an excerpt of the line, and a caret.
class SceneError : public std::runtime_error {
 public:
  SceneError(const SourceText* source, SourcePosition where, const std::string& text);
  SourcePosition where() const { return where_; }

 private:
  SourcePosition where_;
};

// A JSON value with its place in the file.
struct Value {
  enum class Kind { null, boolean, number, string, array, object };
  struct Member;

  Kind kind = Kind::null;
  bool boolean = false;
  double number = 0.0;
  bool integral = false;  // a whole number of at most 2^53, however written
  std::string string;
  std::vector<Value> items;
  std::vector<Member> members;  // in file order, keys unique
  SourcePosition where;

  const Value* find(std::string_view key) const;
};

struct Value::Member {
  std::string key;
  SourcePosition where;  // of the key
  Value value;
};

// Closed or open interval that a number must lie in. NaN and infinities never pass.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open_low = false;
  bool open_high = false;

  static Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true, false}; }
  static Range not_negative() { return {0.0, std::numeric_limits<double>::infinity(), false, false}; }
  static Range open(double low, double high) { return {low, high, true, true}; }
  static Range closed(double low, double high) { return {low, high, false, false}; }
};

class Params {
 public:
  // `what` names the object in messages: "camera", "objects[2]". `source` may be null and must outlive
  // Params.
  Params(const Value& object, const SourceText* source, std::string what);

  // Whether the key is there. That makes its name known to `finish`, but does not count as reading it.
  bool has(std::string_view key) const;
  // A required value, then the same with a default.
  double number(std::string_view key, Range range = {});
  double number(std::string_view key, double fallback, Range range);
  std::int64_t integer(std::string_view key, std::int64_t low, std::int64_t high);
  std::int64_t integer(std::string_view key, std::int64_t fallback, std::int64_t low, std::int64_t high);
  bool boolean(std::string_view key, bool fallback);
  std::string text(std::string_view key);
  std::string text(std::string_view key, std::string_view fallback);
  // One of `names`; anything else is an error that lists them and names the nearest.
  std::string choice(std::string_view key, std::initializer_list<std::string_view> names,
                     std::string_view fallback);
  dvec2 vec2(std::string_view key, dvec2 fallback, Range range = {});
  dvec3 vec3(std::string_view key, Range range = {});
  dvec3 vec3(std::string_view key, dvec3 fallback, Range range = {});
  // A colour: three numbers, or one for grey.
  dvec3 color(std::string_view key, dvec3 fallback, Range range = Range::not_negative());
  std::vector<double> numbers(std::string_view key);  // array of numbers, any length
  std::vector<std::int64_t> integers(std::string_view key, std::int64_t low, std::int64_t high);
  Params object(std::string_view key);                // required object; finish() it yourself
  std::vector<Params> objects(std::string_view key);  // required array of objects, may be empty
  // The raw value, marked as read; null when absent. For forms that the calls above do not cover.
  const Value* raw(std::string_view key);
  // A path given in the scene, resolved against the scene file's folder.
  std::string path(std::string_view key);

  // Throws for the first key that was not read, and names the nearest key that was asked for.
  void finish() const;

  [[noreturn]] void fail(const std::string& message) const;                        // at the object
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;  // at the key's value
  [[noreturn]] void fail(const Value& at, const std::string& message) const;       // at any value inside

  const std::string& what() const { return what_; }
  SourcePosition where() const { return value_->where; }
  const SourceText* source() const { return source_; }

  // The families that an object inside may name (nested_surface in renderer/api/registry.h); null where none
  // can be named. Objects read from this one inherit it.
  const Registry* registry() const { return registry_; }
  void set_registry(const Registry& registry) { registry_ = &registry; }

 private:
  const Value* value_;
  const SourceText* source_;
  const Registry* registry_ = nullptr;
  std::string what_;
  // Names asked for, and whether they were read. Shared by copies, so that a Params passed by value still
  // counts.
  std::shared_ptr<std::map<std::string, bool, std::less<>>> asked_;

  const Value& required(std::string_view key, Value::Kind kind, const char* expected);
  const Value* optional(std::string_view key, Value::Kind kind, const char* expected);
  std::string remedy(const std::string& key) const;  // for an unknown key
};

// The candidate nearest to `word` by edit distance, or empty when none is near enough to be meant.
std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace rondure
