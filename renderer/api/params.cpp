#include "renderer/api/params.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "renderer/api/utf8.h"

namespace rondure {
namespace {

std::string describe(const Value& value) {
  switch (value.kind) {
    case Value::Kind::null:
      return "null";
    case Value::Kind::boolean:
      return value.boolean ? "true" : "false";
    case Value::Kind::number:
      return fmt::format("{}", value.number);
    case Value::Kind::string:
      return fmt::format("\"{}\"", printable(value.string, 40));
    case Value::Kind::array:
      return fmt::format("an array of {}", value.items.size());
    case Value::Kind::object:
      return "an object";
  }
  return {};
}

std::string describe(const Range& range, const char* noun) {
  const bool low = std::isfinite(range.low), high = std::isfinite(range.high);
  if (low && high) {
    return fmt::format("{} in {}{}, {}{}", noun, range.open_low ? '(' : '[', range.low, range.high,
                       range.open_high ? ')' : ']');
  }
  if (low) return fmt::format("{} {} {}", noun, range.open_low ? "greater than" : "of at least", range.low);
  if (high) return fmt::format("{} {} {}", noun, range.open_high ? "less than" : "of at most", range.high);
  return noun;
}

bool inside(double x, const Range& range) {
  return std::isfinite(x) && (range.open_low ? x > range.low : x >= range.low) &&
         (range.open_high ? x < range.high : x <= range.high);
}

std::string quote(std::string_view name) { return fmt::format("\"{}\"", printable(name)); }

std::string quoted_list(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + quote(name);
  return list;
}

[[noreturn]] void wrong(const Params& params, const Value& at, const std::string& subject,
                        const std::string& wanted) {
  params.fail(at, fmt::format("{} must be {}, found {}", subject, wanted, describe(at)));
}

void check_number(const Params& params, const Value& value, const std::string& subject, const Range& range) {
  if (value.kind == Value::Kind::number && inside(value.number, range)) return;
  wrong(params, value, subject, describe(range, "a number"));
}

std::int64_t check_integer(const Params& params, const Value& value, const std::string& subject,
                           std::int64_t low, std::int64_t high) {
  if (value.kind != Value::Kind::number || !value.integral || value.number < static_cast<double>(low) ||
      value.number > static_cast<double>(high)) {
    const bool bounded = high < std::numeric_limits<std::int64_t>::max();
    wrong(params, value, subject,
          bounded ? fmt::format("an integer in [{}, {}]", low, high)
                  : fmt::format("an integer of at least {}", low));
  }
  return static_cast<std::int64_t>(value.number);
}

template <int N>
glm::vec<N, double> check_vector(const Params& params, const Value& value, const std::string& subject,
                                 const Range& range) {
  if (value.kind != Value::Kind::array || value.items.size() != N) {
    wrong(params, value, subject, fmt::format("an array of {} numbers", N));
  }
  glm::vec<N, double> result;
  for (int i = 0; i < N; ++i) {
    const Value& item = value.items[static_cast<std::size_t>(i)];
    check_number(params, item, fmt::format("{}[{}]", subject, i), range);
    result[i] = item.number;
  }
  return result;
}

}  // namespace

const Value* Value::find(std::string_view key) const {
  for (const Member& member : members) {
    if (member.key == key) return &member.value;
  }
  return nullptr;
}

Params::Params(const Value& object, const SourceText* source, std::string what)
    : value_(&object),
      source_(source),
      what_(std::move(what)),
      asked_(std::make_shared<std::map<std::string, bool, std::less<>>>()) {
  if (object.kind != Value::Kind::object) {
    wrong(*this, object, what_.empty() ? "the scene" : what_, "an object, { ... }");
  }
}

bool Params::has(std::string_view key) const {
  asked_->emplace(key, false);
  return value_->find(key) != nullptr;
}

const Value* Params::raw(std::string_view key) {
  asked_->insert_or_assign(std::string(key), true);
  return value_->find(key);
}

const Value* Params::optional(std::string_view key, Value::Kind kind, const char* expected) {
  const Value* value = raw(key);
  if (value && value->kind != kind) wrong(*this, *value, quote(key), expected);
  return value;
}

const Value& Params::required(std::string_view key, Value::Kind kind, const char* expected) {
  const Value* value = optional(key, kind, expected);
  if (!value) fail(fmt::format("{} is missing; it must be {}", quote(key), expected));
  return *value;
}

double Params::number(std::string_view key, Range range) {
  const Value* value = raw(key);
  if (!value) fail(fmt::format("{} is missing; it must be {}", quote(key), describe(range, "a number")));
  check_number(*this, *value, quote(key), range);
  return value->number;
}

double Params::number(std::string_view key, double fallback, Range range) {
  return raw(key) ? number(key, range) : fallback;
}

std::int64_t Params::integer(std::string_view key, std::int64_t low, std::int64_t high) {
  return check_integer(*this, required(key, Value::Kind::number, "an integer"), quote(key), low, high);
}

std::int64_t Params::integer(std::string_view key, std::int64_t fallback, std::int64_t low,
                             std::int64_t high) {
  const Value* value = raw(key);
  return value ? check_integer(*this, *value, quote(key), low, high) : fallback;
}

bool Params::boolean(std::string_view key, bool fallback) {
  const Value* value = optional(key, Value::Kind::boolean, "true or false");
  return value ? value->boolean : fallback;
}

std::string Params::text(std::string_view key) {
  return required(key, Value::Kind::string, "a string").string;
}

std::string Params::text(std::string_view key, std::string_view fallback) {
  const Value* value = optional(key, Value::Kind::string, "a string");
  return value ? value->string : std::string(fallback);
}

std::string Params::choice(std::string_view key, std::initializer_list<std::string_view> names,
                           std::string_view fallback) {
  const Value* value = raw(key);
  if (!value) return std::string(fallback);
  const std::vector<std::string> known(names.begin(), names.end());
  if (value->kind != Value::Kind::string) wrong(*this, *value, quote(key), "one of " + quoted_list(known));
  for (const std::string& name : known) {
    if (name == value->string) return name;
  }
  const std::string near = nearest_name(value->string, known);
  fail(*value,
       fmt::format("{} must be one of {}, found {}{}", quote(key), quoted_list(known), describe(*value),
                   near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
}

dvec2 Params::vec2(std::string_view key, dvec2 fallback, Range range) {
  const Value* value = raw(key);
  return value ? check_vector<2>(*this, *value, quote(key), range) : fallback;
}

dvec3 Params::vec3(std::string_view key, Range range) {
  return check_vector<3>(*this, required(key, Value::Kind::array, "an array of 3 numbers"), quote(key),
                         range);
}

dvec3 Params::vec3(std::string_view key, dvec3 fallback, Range range) {
  const Value* value = raw(key);
  return value ? check_vector<3>(*this, *value, quote(key), range) : fallback;
}

dvec3 Params::color(std::string_view key, dvec3 fallback, Range range) {
  const Value* value = raw(key);
  if (!value) return fallback;
  if (value->kind == Value::Kind::number) {
    check_number(*this, *value, quote(key), range);
    return dvec3(value->number);
  }
  if (value->kind != Value::Kind::array || value->items.size() != 3) {
    wrong(*this, *value, quote(key), "a colour: a number or an array of 3 numbers");
  }
  return check_vector<3>(*this, *value, quote(key), range);
}

std::vector<double> Params::numbers(std::string_view key) {
  const Value& value = required(key, Value::Kind::array, "an array of numbers");
  std::vector<double> result;
  for (const Value& item : value.items) {
    check_number(*this, item, fmt::format("{}[{}]", quote(key), result.size()), {});
    result.push_back(item.number);
  }
  return result;
}

std::vector<std::int64_t> Params::integers(std::string_view key, std::int64_t low, std::int64_t high) {
  const Value& value = required(key, Value::Kind::array, "an array of integers");
  std::vector<std::int64_t> result;
  for (const Value& item : value.items) {
    result.push_back(check_integer(*this, item, fmt::format("{}[{}]", quote(key), result.size()), low, high));
  }
  return result;
}

Params Params::object(std::string_view key) {
  const Value& value = required(key, Value::Kind::object, "an object, { ... }");
  Params inside(value, source_, what_.empty() ? std::string(key) : fmt::format("{}.{}", what_, key));
  inside.registry_ = registry_;
  return inside;
}

std::vector<Params> Params::objects(std::string_view key) {
  const Value& value = required(key, Value::Kind::array, "an array of objects");
  std::vector<Params> result;
  for (const Value& item : value.items) {
    const std::string parent = what_.empty() ? std::string(key) : fmt::format("{}.{}", what_, key);
    result.emplace_back(item, source_, fmt::format("{}[{}]", parent, result.size()));
    result.back().registry_ = registry_;
  }
  return result;
}

std::string Params::path(std::string_view key) {
  const Value& value = required(key, Value::Kind::string, "a path");
  if (value.string.empty() || value.string.find('\0') != std::string::npos)
    wrong(*this, value, quote(key), "a path");
  const std::filesystem::path given(value.string);
  if (given.is_absolute() || !source_) return value.string;
  return (std::filesystem::path(source_->name).parent_path() / given).string();
}

void Params::finish() const {
  for (const Value::Member& member : value_->members) {
    const auto asked = asked_->find(member.key);
    if (asked != asked_->end() && asked->second) continue;
    const std::string object = what_.empty() ? "the scene" : what_;
    std::string message =
        fmt::format("unknown key {} in {}; {}", quote(member.key), object, remedy(member.key));
    if (asked != asked_->end())
      message = fmt::format("{} has no meaning in {} as it stands", quote(member.key), object);
    if (member.where.line < 1) message += " (set on the command line)";
    throw SceneError(source_, member.where, message);
  }
}

std::string Params::remedy(const std::string& key) const {
  std::vector<std::string> known;
  for (const auto& [name, read] : *asked_) known.push_back(name);
  const std::string near = nearest_name(key, known);
  if (!near.empty()) return fmt::format("did you mean \"{}\"?", near);
  return known.empty() ? "it takes none" : "known keys: " + quoted_list(known);
}

void Params::fail(const std::string& message) const {
  const std::string object = what_.empty() ? "the scene" : what_;
  throw SceneError(source_, value_->where, fmt::format("{}: {}", object, message));
}

void Params::fail(std::string_view key, const std::string& message) const {
  const Value* value = value_->find(key);
  fail(value ? *value : *value_, message);
}

void Params::fail(const Value& at, const std::string& message) const {
  if (at.where.line > 0) throw SceneError(source_, at.where, message);
  const std::string object = what_.empty() ? "the scene" : what_;
  throw SceneError(source_, at.where, fmt::format("{}: {} (set on the command line)", object, message));
}

}  // namespace rondure
