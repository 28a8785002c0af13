#include "renderer/render/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace rondure {
namespace {

constexpr int bar_width = 30;

void print(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

ProgressStyle progress_style(bool quiet) {
  if (quiet) return ProgressStyle::none;
  return isatty(STDERR_FILENO) != 0 ? ProgressStyle::bar : ProgressStyle::lines;
}

std::string duration_text(double seconds) {
  const auto s = static_cast<long long>(std::max(0.0, seconds) + 0.5);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

Progress::Progress(std::string label, std::size_t total, ProgressStyle style)
    : label_(std::move(label)), total_(std::max<std::size_t>(total, 1)), style_(style) {}

Progress::~Progress() { clear(); }

void Progress::clear() {
  const std::lock_guard lock(mutex_);
  if (shown_) print("\r\033[K");
  shown_ = false;
}

std::string Progress::status(Clock::time_point now) const {
  const double share = static_cast<double>(done_) / static_cast<double>(total_);
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string left = share > 0.0 ? duration_text(elapsed * (1.0 - share) / share) : "?";
  return fmt::format("{:3.0f}%  {} elapsed, {} left", 100.0 * share, duration_text(elapsed), left);
}

void Progress::advance(std::size_t units) {
  if (style_ == ProgressStyle::none) return;
  const std::lock_guard lock(mutex_);
  done_ = std::min(done_ + units, total_);
  const Clock::time_point now = Clock::now();
  if (style_ == ProgressStyle::lines) {
    const std::size_t tenths = done_ * 10 / total_;
    if (tenths > tenths_) print(fmt::format("{}: {}\n", label_, status(now)));
    tenths_ = tenths;
    return;
  }
  if (shown_ && done_ < total_ && now - drawn_ < std::chrono::milliseconds(100)) return;
  const auto filled = static_cast<std::size_t>(bar_width) * done_ / total_;
  print(fmt::format("\r\033[K{} [{:-<{}}] {}", label_, std::string(filled, '#'), bar_width, status(now)));
  shown_ = true;
  drawn_ = now;
}

}  // namespace rondure
