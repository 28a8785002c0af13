#include "tests/surfaces/build_family.h"

#include "renderer/plugin/builtin.h"
#include "renderer/scene/json_reader.h"
#include "tests/paths.h"

namespace rondure {

Surface build_family(const std::string& text) {
  Registry registry;
  register_builtins(registry);
  // Named as a file of the data folder, so that relative paths start there.
  const Document document = read_json_text(source_folder() + "/tests/data/object.json", text);
  Params params(document.root, document.source.get(), "the object");
  params.set_registry(registry);
  Surface surface = family_of(params, registry).build(params);
  params.finish();
  return surface;
}

std::string family_error(const std::string& text) {
  try {
    build_family(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

std::string complaint(const std::string& text) {
  const std::string message = family_error(text);
  const std::string mark = "object.json:1:";
  const std::size_t at = message.find(mark);
  if (at == std::string::npos) return message;
  const std::size_t colon = message.find(": ", at + mark.size());
  return message.substr(colon + 2, message.find('\n', colon) - colon - 2);
}

}  // namespace rondure
