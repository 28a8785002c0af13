// How far a long task has come, on standard error.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace rondure {

enum class ProgressStyle { bar, lines, none };

// A bar with the time left on a terminal, a line every tenth of the way otherwise, nothing when quiet.
ProgressStyle progress_style(bool quiet);

class Progress {
 public:
  Progress(std::string label, std::size_t total, ProgressStyle style);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // From any thread.
  void advance(std::size_t units);
  // Takes the bar off the screen, to print something else or for good.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  std::size_t total_;
  ProgressStyle style_;
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::size_t tenths_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_{};
  bool shown_ = false;

  std::string status(Clock::time_point now) const;
};

// "4 s", "1:05", "2:00:07".
std::string duration_text(double seconds);

}  // namespace rondure
