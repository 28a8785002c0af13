// Calls into families, integrators and layers, which may come from anywhere.
#pragma once

#include <fmt/format.h>

#include <new>
#include <string>

#include "renderer/api/params.h"

namespace rondure {

// For a catch (...) around such a call: what to say of the exception, behind who threw it. A SceneError and
// want of memory, which speak for themselves, are thrown on.
inline std::string plugin_failure() {
  try {
    throw;
  } catch (const SceneError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return fmt::format("failed: {}", error.what());
  } catch (...) {
    return "failed with an exception of unknown type";
  }
}

// What `call()` returns. What it throws, other than a SceneError or for want of memory, becomes a SceneError
// at `params`; `who` opens its message: "the family \"x\"".
template <class Call>
auto call_plugin(const Params& params, const std::string& who, const Call& call) -> decltype(call()) {
  try {
    return call();
  } catch (...) {
    params.fail(who + " " + plugin_failure());
  }
}

}  // namespace rondure
