#include "renderer/sampling/piecewise_constant.h"

#include <algorithm>
#include <utility>

namespace rondure {
namespace {

struct Cell {
  std::size_t index;
  double position;  // cell and place inside, over the count
};

// Inverts a running sum cumulative[0..count], from 0 to 1.
Cell invert(const double* cumulative, std::size_t count, double u) {
  const double* end = cumulative + count + 1;
  const double* above = std::upper_bound(cumulative + 1, end - 1, u);
  std::size_t i = static_cast<std::size_t>(above - cumulative) - 1;
  const double width = cumulative[i + 1] - cumulative[i];
  const double inside = width > 0.0 ? std::clamp((u - cumulative[i]) / width, 0.0, 1.0) : 0.5;
  return {i, (static_cast<double>(i) + inside) / static_cast<double>(count)};
}

std::size_t cell_of(double x, int count) {
  return static_cast<std::size_t>(std::clamp(static_cast<int>(x * count), 0, count - 1));
}

}  // namespace

PiecewiseConstant2d::PiecewiseConstant2d(int width, int height, std::vector<double> values)
    : width_(width), height_(height), values_(std::move(values)) {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  if (std::all_of(values_.begin(), values_.end(), [](double v) { return v == 0.0; })) {
    std::fill(values_.begin(), values_.end(), 1.0);
  }
  rows_.assign((w + 1) * h, 0.0);
  columns_.assign(h + 1, 0.0);
  for (std::size_t y = 0; y < h; ++y) {
    double* row = &rows_[y * (w + 1)];
    for (std::size_t x = 0; x < w; ++x) row[x + 1] = row[x] + values_[y * w + x];
    const double total = row[w];
    columns_[y + 1] = columns_[y] + total;
    if (total > 0.0) {
      for (std::size_t x = 1; x <= w; ++x) row[x] /= total;
    }
  }
  const double total = columns_[h];
  mean_ = total / static_cast<double>(w * h);
  for (double& c : columns_) c /= total;
}

PiecewiseConstant2d::Sample PiecewiseConstant2d::sample(dvec2 uv) const {
  const Cell row = invert(columns_.data(), static_cast<std::size_t>(height_), uv.y);
  const auto w = static_cast<std::size_t>(width_);
  const Cell column = invert(&rows_[row.index * (w + 1)], w, uv.x);
  return {{column.position, row.position}, values_[row.index * w + column.index] / mean_};
}

double PiecewiseConstant2d::density(dvec2 position) const {
  const std::size_t x = cell_of(position.x, width_), y = cell_of(position.y, height_);
  return values_[y * static_cast<std::size_t>(width_) + x] / mean_;
}

}  // namespace rondure
