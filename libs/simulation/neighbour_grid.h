// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <cstdint>
#include <span>
#include <vector>

namespace sidestep {

/// Who is near whom: points in a grid of cells, built anew each step in time linear in their number.
class NeighbourGrid {
 public:
  /// @param cell_m of the grid; grown where the points lie so far apart that there would be many more cells than points
  void build(std::span<const mrpt::math::TPoint2D> points, double cell_m);
  /// Calls `use(i)` for each point within `radius_m` of p, in a fixed order.
  template <class Use>
  void visit(const mrpt::math::TPoint2D& p, double radius_m, const Use& use) const {
    if (points_.empty()) return;
    const int x0 = column(p.x - radius_m), x1 = column(p.x + radius_m);
    const int y0 = row(p.y - radius_m), y1 = row(p.y + radius_m);
    for (int y = y0; y <= y1; ++y) {
      const size_t line = static_cast<size_t>(y) * static_cast<size_t>(columns_);
      for (uint32_t k = first_[line + static_cast<size_t>(x0)]; k < first_[line + static_cast<size_t>(x1) + 1]; ++k) {
        const double dx = sorted_[k].x - p.x, dy = sorted_[k].y - p.y;
        if (dx * dx + dy * dy <= radius_m * radius_m) use(order_[k]);
      }
    }
  }

 private:
  int column(double x) const { return clamped((x - x_) / cell_m_, columns_); }
  int row(double y) const { return clamped((y - y_) / cell_m_, rows_); }
  static int clamped(double at, int count) { return at <= 0 ? 0 : at >= count - 1 ? count - 1 : static_cast<int>(at); }

  std::span<const mrpt::math::TPoint2D> points_;
  std::vector<mrpt::math::TPoint2D> sorted_;
  std::vector<uint32_t> first_, order_, cell_of_;
  double x_ = 0, y_ = 0, cell_m_ = 1;
  int columns_ = 1, rows_ = 1;
};

}  // namespace sidestep
