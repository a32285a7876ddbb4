// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/neighbour_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sidestep {

void NeighbourGrid::build(std::span<const mrpt::math::TPoint2D> points, double cell_m) {
  points_ = points;
  if (points.empty()) return;
  double x_max = -std::numeric_limits<double>::infinity(), y_max = x_max;
  x_ = y_ = -x_max;
  for (const auto& p : points) {
    x_ = std::min(x_, p.x), x_max = std::max(x_max, p.x);
    y_ = std::min(y_, p.y), y_max = std::max(y_max, p.y);
  }
  const double most = 4 * static_cast<double>(points.size()) + 64, width = x_max - x_, height = y_max - y_;
  cell_m_ = std::max({cell_m, std::sqrt(width * height / most), width / most, height / most});
  columns_ = static_cast<int>(width / cell_m_) + 1;
  rows_ = static_cast<int>(height / cell_m_) + 1;
  const size_t n = points.size();
  first_.assign(static_cast<size_t>(columns_) * static_cast<size_t>(rows_) + 1, 0);
  cell_of_.resize(n), order_.resize(n), sorted_.resize(n);
  for (size_t i = 0; i < n; ++i) {
    cell_of_[i] = static_cast<uint32_t>(row(points[i].y) * columns_ + column(points[i].x));
    ++first_[cell_of_[i] + 1];
  }
  for (size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  for (size_t i = n; i-- > 0;) {  // backwards, from the end of each cell: cells keep the order of the points
    const uint32_t at = --first_[cell_of_[i] + 1];
    order_[at] = static_cast<uint32_t>(i);
    sorted_[at] = points[i];
  }
  // first_[c + 1] is now where cell c begins.
  first_.erase(first_.begin());
  first_.push_back(static_cast<uint32_t>(n));
}

}  // namespace sidestep
