// Calls into families and integrators, which may come from anywhere.
#pragma once

#include <fmt/format.h>

#include <new>
#include <string>

#include "renderer/api/params.h"

namespace rondure {

// What `call()` returns. What it throws, other than a SceneError or for want of memory, becomes a SceneError
// at `params`; `who` opens its message: "the family \"x\"".
template <class Call>
auto call_plugin(const Params& params, const std::string& who, const Call& call) -> decltype(call()) {
  try {
    return call();
  } catch (const SceneError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    params.fail(fmt::format("{} failed: {}", who, error.what()));
  } catch (...) {
    params.fail(who + " failed with an exception of unknown type");
  }
}

}  // namespace rondure
