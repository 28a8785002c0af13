// The signals by which a program is asked to end.
#pragma once

#include <array>
#include <csignal>

namespace rondure {

// Ctrl-C, a request to end, a terminal that closes, and a limit of CPU time that is reached.
inline constexpr std::array ending_signals{SIGINT, SIGTERM, SIGHUP, SIGXCPU};

}  // namespace rondure
