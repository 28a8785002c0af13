#include "renderer/scene/unknown_name.h"

#include <fmt/format.h>

#include "renderer/api/params.h"
#include "renderer/api/utf8.h"

namespace rondure {

std::string unknown_name(const std::string& noun, const std::string& name,
                         const std::vector<std::string>& known) {
  std::string message = fmt::format("unknown {} \"{}\"; ", noun, printable(name));
  const std::string near = nearest_name(name, known);
  if (!near.empty()) return message + fmt::format("did you mean \"{}\"?", near);
  if (known.empty()) return message + "there are none";
  std::string list;
  for (const std::string& word : known) list += (list.empty() ? "\"" : ", \"") + printable(word) + "\"";
  return message + "known: " + list;
}

}  // namespace rondure
