// Puts a scene to all its uses, in little time.
#pragma once

#include <stdexcept>

#include "renderer/api/registry.h"
#include "renderer/scene/scene.h"

namespace rondure {

// False for bytes that were refused in good order; throws what is a finding.
template <class Use>
bool accepted(const Use& use) {
  try {
    use();
    return true;
  } catch (const std::runtime_error&) {
    return false;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

const Registry& builtins();

// Compiles the scene, traces rays and renders four pixels. Scenes of many patches are left out: they differ
// from smaller ones in time alone. Throws std::logic_error where a number comes out that is none.
void exercise(Scene& scene);

// Throws std::logic_error unless the hit is finite, with a normal of length 1 or, where there is none, 0.
void check_hit(const Hit& hit);

}  // namespace rondure
