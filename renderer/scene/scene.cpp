#include "renderer/scene/scene.h"

namespace rondure {

void Scene::fail(SourcePosition where, const std::string& message) const {
  throw SceneError(source.get(), where, where.line > 0 ? message : message + " (set on the command line)");
}

}  // namespace rondure
