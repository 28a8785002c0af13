#include "renderer/scene/json_reader.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <random>

#include "renderer/scene/text_file.h"
#include "tests/catch.h"
#include "tests/process.h"
#include "tests/scene/messages.h"

namespace rondure {
namespace {

std::string json_complaint(const std::string& text) {
  return message_of([&] { read_json_text("s.json", text); });
}

std::string place(const SourcePosition& where) { return fmt::format("{}:{}", where.line, where.column); }

TEST_CASE("JSON values and keys know their places", "[scene]") {
  const Document document =
      read_json_text("s.json",
                     "\xEF\xBB\xBF{ // one\n"
                     "  \"a\\\"b\" /* two\n"
                     "  */: [1, -2.5e3 , true],\n"
                     "\t\"c\":{\"d\":null,\"e\":{}, \"f\":[]}, \"\":\"x\\u00e9\"} // end");
  const Value& root = document.root;
  REQUIRE(root.kind == Value::Kind::object);
  REQUIRE(root.members.size() == 3);
  CHECK(place(root.where) == "1:4");  // columns count bytes, the byte order mark's three too
  CHECK(root.members[0].key == "a\"b");
  CHECK(place(root.members[0].where) == "2:3");
  const Value& array = root.members[0].value;
  REQUIRE(array.items.size() == 3);
  CHECK(place(array.where) == "3:7");
  CHECK(place(array.items[0].where) == "3:8");
  CHECK(place(array.items[1].where) == "3:11");
  CHECK(place(array.items[2].where) == "3:20");
  CHECK(array.items[0].integral);
  CHECK(array.items[1].integral);
  CHECK(array.items[1].number == -2500.0);
  CHECK(array.items[2].boolean);
  const Value* c = root.find("c");
  REQUIRE(c != nullptr);
  CHECK(place(root.members[1].where) == "4:2");
  CHECK(place(c->where) == "4:6");
  CHECK(place(c->members[0].value.where) == "4:11");
  CHECK(place(c->members[1].value.where) == "4:20");
  CHECK(place(c->members[2].where) == "4:24");
  CHECK(root.find("")->string == "x\u00e9");
  CHECK(root.find("nothing") == nullptr);
}

TEST_CASE("integers are exact or are none", "[scene]") {
  const Value root =
      read_json_text("s",
                     "[9007199254740992, 9007199254740993, -9007199254740992, 1.0, 1e2, 1e16, 2.5, "
                     "18446744073709551615]")
          .root;
  const bool integral[] = {true, false, true, true, true, false, false, false};
  for (std::size_t i = 0; i < 8; ++i) {
    CAPTURE(i);
    CHECK(root.items[i].integral == integral[i]);
  }
}

TEST_CASE("text that is no JSON is refused with its place", "[scene]") {
  const std::pair<const char*, const char*> table[] = {
      {"", "s.json:1:1: the file is empty; a scene is an object, { ... }"},
      {" // nothing\n", "s.json:2:1: the file is empty; a scene is an object, { ... }"},
      {"{", "s.json:1:1: this object is never closed"},
      {"{\n \"a\": [1, 2", "s.json:2:7: this array is never closed"},
      {"{\"a\" // why\n", "s.json:1:1: this object is never closed"},
      {"{\"a\":1,}", "s.json:1:8: unexpected }; expected a key in double quotes"},
      {"[1,]", "s.json:1:4: unexpected ]; expected a value"},
      {"[1,,2]", "s.json:1:4: unexpected ,; expected a value"},
      {"[1 2]", "s.json:1:4: unexpected 2; expected \",\" or \"]\""},
      {"{\"a\" 1}", "s.json:1:6: unexpected 1; expected \":\" after the key"},
      {"{\"a\":}", "s.json:1:6: unexpected }; expected a value"},
      {"{\"a\":1 \"b\":2}", "s.json:1:8: unexpected string; expected \",\" or \"}\""},
      {"{\"a\":1]", "s.json:1:7: unexpected ]; expected \",\" or \"}\""},
      {"]", "s.json:1:1: unexpected ]; expected a value"},
      {"/", "s.json:1:1: unexpected /; expected a value"},
      {"{'a':1}", "s.json:1:2: unexpected '; expected a key in double quotes"},
      {"{a:1}", "s.json:1:2: unexpected word a; strings stand in double quotes"},
      {"{\"a\":nul}", "s.json:1:6: unexpected word nul; strings stand in double quotes"},
      {"{\"a\":truefalse}", "s.json:1:6: unexpected word truefalse; strings stand in double quotes"},
      {"{\"a\":NaN}", "s.json:1:6: NaN is not allowed: every number must be finite"},
      {"{\"a\":nan}", "s.json:1:6: nan is not allowed: every number must be finite"},
      {"{\"a\":-Infinity}", "s.json:1:6: -Infinity is not allowed: every number must be finite"},
      {"{\"a\":inf}", "s.json:1:6: inf is not allowed: every number must be finite"},
      {"{\"a\":1e999}", "s.json:1:6: 1e999 is beyond the range of a double"},
      {"{\"a\":-1e999}", "s.json:1:6: -1e999 is beyond the range of a double"},
      {"{\"a\":01}", "s.json:1:6: 01 is not a JSON number"},
      {"{\"a\":+1}", "s.json:1:6: +1 is not a JSON number"},
      {"{\"a\":.5}", "s.json:1:6: .5 is not a JSON number"},
      {"{\"a\":1.}", "s.json:1:6: 1. is not a JSON number"},
      {"{\"a\":-}", "s.json:1:6: - is not a JSON number"},
      {"{\"a\":1x}", "s.json:1:6: 1x is not a JSON number"},
      {"{\"a\":\"x", "s.json:1:6: this string is never closed"},
      {"{\"a\":\"x\n\"}", "s.json:1:6: this string is not closed on its line"},
      {"{\"a\":\"\\x\"}", "s.json:1:8: bad string: forbidden character after backslash"},
      {"{\"a\":\"\t\"}",
       "s.json:1:7: bad string: control character U+0009 (HT) must be escaped to \\u0009 or \\t"},
      {"{ /* x", "s.json:1:3: this comment is never closed"},
      {"{} {}", "s.json:1:4: nothing may follow the end of the scene"},
      {"{} x", "s.json:1:4: nothing may follow the end of the scene"},
      {"{}}", "s.json:1:3: nothing may follow the end of the scene"},
      {"{\"a\":\"\xff\"}", "s.json:1:7: byte 0xFF is not UTF-8 text"},
      {"{} // \xE9t\xE9", "s.json:1:7: byte 0xE9 is not UTF-8 text"},
      {"[\"\xC0\x80\"]", "s.json:1:3: byte 0xC0 is not UTF-8 text"},          // overlong
      {"[\"\xED\xA0\x80\"]", "s.json:1:3: byte 0xED is not UTF-8 text"},      // surrogate
      {"[\"\xF4\x90\x80\x80\"]", "s.json:1:3: byte 0xF4 is not UTF-8 text"},  // beyond U+10FFFF
      {"{\"a\":1,\n \"b\":2,\n \"a\":3, \"b\":4}",
       "s.json:3:2: key \"a\" stands twice in this object; the first is at line 1, column 2"},
      {"{\"\\u0061\":1, \"a\":2}",
       "s.json:1:14: key \"a\" stands twice in this object; the first is at line 1, column 2"},
  };
  for (const auto& [text, message] : table) {
    CAPTURE(text);
    CHECK(first_line(json_complaint(text)) == message);
  }
  CHECK(first_line(json_complaint(std::string("{}\0x", 4))) == "s.json:1:3: byte 0x00 is not UTF-8 text");
}

TEST_CASE("nesting is refused where it gets too deep", "[scene]") {
  const auto nested = [](int depth) {
    return std::string(static_cast<std::size_t>(depth), '[') +
           std::string(static_cast<std::size_t>(depth), ']');
  };
  CHECK(json_complaint(nested(max_json_depth)) == "accepted");
  CHECK(first_line(json_complaint(nested(max_json_depth + 1))) ==
        "s.json:1:257: nested deeper than 256 levels");
  CHECK(first_line(json_complaint(std::string(1000000, '['))) ==
        "s.json:1:257: nested deeper than 256 levels");
}

TEST_CASE("messages show the line and a caret", "[scene]") {
  CHECK(json_complaint("{\n  \"a\": nul\n}") ==
        "s.json:2:8: unexpected word nul; strings stand in double quotes\n"
        "  2 |   \"a\": nul\n"
        "    |        ^");
  // A tab takes one column, so does a character of several bytes; a carriage return is no part of the line.
  CHECK(json_complaint("{\r\n\t\"\u00e9\u20ac\": nul\r\n}") ==
        "s.json:2:11: unexpected word nul; strings stand in double quotes\n"
        "  2 |  \"\u00e9\u20ac\": nul\n"
        "    |        ^");
  CHECK(json_complaint("[\"\x1b[31m\"]").find('\x1b') == std::string::npos);
  const std::string far = json_complaint(fmt::format("[{0:5000}nul{0:5000}]", ""));
  const std::string excerpt = far.substr(far.find('\n') + 1);
  const std::size_t line_end = excerpt.find('\n');
  CHECK(excerpt.size() < 250);
  CHECK(excerpt.substr(line_end + 1).find('^') == excerpt.find("nul"));
}

TEST_CASE("files that cannot be read say why", "[scene]") {
  const std::string folder = fresh_folder("json_reader");
  CHECK(message_of([&] { read_json_file(folder); }) == fmt::format("cannot read {}: it is a folder", folder));
  const std::string missing = folder + "/missing.json";
  CHECK(message_of([&] { read_json_file(missing); }) ==
        fmt::format("cannot read {}: No such file or directory", missing));
  const std::string empty = folder + "/empty.json";
  write_text_file(empty, "");
  CHECK(first_line(message_of([&] { read_json_file(empty); })) ==
        empty + ":1:1: the file is empty; a scene is an object, { ... }");
}

TEST_CASE("a file beyond the limit is refused", "[scene]") {
  const std::string file = fresh_folder("text_file") + "/long.json";
  write_text_file(file, std::string(100, ' '));
  CHECK(read_text_file(file, 100).size() == 100);
  CHECK(message_of([&] { read_text_file(file, 99); }) ==
        fmt::format("cannot read {}: it is larger than 99 bytes", file));
  // A device has no size to ask for beforehand, and this one never ends.
  CHECK(message_of([&] { read_text_file("/dev/zero", 1000); }) ==
        "cannot read /dev/zero: it is larger than 1000 bytes");
}

// Against the library's own tree parser: the same texts are accepted, broken or not, but for what is stricter
// here.
TEST_CASE("random damage never passes unseen nor crashes", "[scene]") {
  const std::string whole =
      "{\"a\": [1, -2.5e3, true, null, {\"b\": \"x\\n\\u00e9\"}], /* c */ \"d\": {}, // e\n \"f\": [[]]}";
  std::mt19937 random(7);
  const std::string alphabet = "{}[],:\"\\/*-+.0eEtnu1 \n\tx";
  int wrong = 0, accepted = 0;
  std::string worst;
  for (int i = 0; i < 20000; ++i) {
    std::string text = whole;
    for (unsigned k = 0; k <= random() % 3; ++k) {
      const std::size_t at = random() % text.size();
      const char c = alphabet[random() % alphabet.size()];
      if (random() % 3 == 0) {
        text.erase(at, 1 + random() % 4);
      } else if (random() % 2 == 0) {
        text.insert(at, 1, c);
      } else {
        text[at] = c;
      }
    }
    const bool here = json_complaint(text) == "accepted";
    bool there = nlohmann::json::accept(text, true);
    if (there && !here && json_complaint(text).find("stands twice") != std::string::npos) there = false;
    accepted += here;
    if (here == there) continue;
    ++wrong;
    worst = text;
  }
  CAPTURE(worst);
  CHECK(wrong == 0);
  CHECK(accepted > 500);
  CHECK(accepted < 15000);
}

}  // namespace
}  // namespace rondure
