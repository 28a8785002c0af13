// Rondure's version, in the one place that the build, the files it writes and the plugin check read it from.
#pragma once

namespace rondure {

inline constexpr const char version[] = "0.1.0";

}  // namespace rondure
