// What a call complains of.
#pragma once

#include <string>

#include "renderer/api/params.h"

namespace rondure {

// The text of the SceneError that `call` throws; "accepted" when it throws none.
template <class Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

// Without the excerpt.
inline std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace rondure
