// What foreign code does to a process, found out on a copy of it.
#pragma once

#include <functional>
#include <string>

namespace rondure {

// Runs `call` in a child process, mute and for 20 seconds at most. Empty when it came to its end, by return
// or by exception; otherwise what ended the child ("Segmentation fault", "exit code 3"), and would have ended
// this process.
std::string end_of_trial(const std::function<void()>& call);

}  // namespace rondure
