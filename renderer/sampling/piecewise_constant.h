// A piecewise-constant distribution over the unit square, for image environments.
#pragma once

#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

class PiecewiseConstant2d {
 public:
  struct Sample {
    dvec2 position;
    double density;
  };

  // Non-negative values, values[y * width + x] over [x, x+1]/width * [y, y+1]/height. Values that are all
  // zero give the uniform distribution.
  PiecewiseConstant2d(int width, int height, std::vector<double> values);

  Sample sample(dvec2 uv) const;
  // Per unit of the square's area.
  double density(dvec2 position) const;
  double mean() const { return mean_; }

 private:
  int width_, height_;
  std::vector<double> values_;
  std::vector<double> rows_;     // (width + 1) running sums a row, each row ending at 1 (or all zero)
  std::vector<double> columns_;  // height + 1 running sums of the rows' totals, ending at 1
  double mean_ = 0.0;
};

}  // namespace rondure
