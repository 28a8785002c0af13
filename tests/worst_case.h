// The worst of many comparisons: count the failures, assert once, print the case that was furthest out.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace rondure {

class WorstCase {
 public:
  // One comparison; `describe()` gives the text for the case when it is the worst so far.
  template <class Describe>
  void add(double error, double tolerance, Describe describe) {
    ++count_;
    // A NaN must count as the worst failure, not compare false and pass.
    const double ratio = std::isfinite(error) ? error / tolerance : std::numeric_limits<double>::infinity();
    if (!(ratio <= 1.0)) ++failures_;
    if (ratio > ratio_ || count_ == 1) {
      ratio_ = ratio;
      error_ = error;
      text_ = describe();
    }
  }

  void merge(const WorstCase& other) {
    const bool worse = other.count_ > 0 && (count_ == 0 || other.ratio_ > ratio_);
    count_ += other.count_, failures_ += other.failures_;
    if (worse) ratio_ = other.ratio_, error_ = other.error_, text_ = other.text_;
  }

  long count() const { return count_; }
  long failures() const { return failures_; }
  double error() const { return error_; }
  double ratio() const { return ratio_; }
  std::string text() const {
    return std::to_string(failures_) + " of " + std::to_string(count_) + " failed; the worst has " +
           std::to_string(ratio_) + " of its tolerance: " + text_;
  }

 private:
  long count_ = 0, failures_ = 0;
  double ratio_ = 0.0, error_ = 0.0;
  std::string text_ = "none";
};

}  // namespace rondure
