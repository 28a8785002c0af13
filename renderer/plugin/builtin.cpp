#include "renderer/plugin/builtin.h"

namespace rondure {

void register_builtins(Registry&) {}

}  // namespace rondure
