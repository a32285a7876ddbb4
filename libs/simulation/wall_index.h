// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <cstdint>
#include <span>
#include <vector>

#include "core/obstacles.h"

namespace sidestep {

/// Walls in a grid of cells, so that what is near costs by what is near.
class WallIndex {
 public:
  WallIndex() = default;
  /// @param cell_m of the grid; grown if the walls stretch so far that there would be over a million cells
  explicit WallIndex(std::vector<Segment> walls, double cell_m = 2);

  std::span<const Segment> walls() const { return walls_; }
  /// Numbers of the walls that may come within `radius_m` of `p`, each once, in order. `out` keeps its memory.
  void near(const mrpt::math::TPoint2D& p, double radius_m, std::vector<uint32_t>& out) const;
  /// Whether a wall crosses the line from a to b.
  bool blocks(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b, std::vector<uint32_t>& scratch) const;

 private:
  struct Cells {
    int x0, x1, y0, y1;
  };
  Cells cells(double x_min, double x_max, double y_min, double y_max) const;
  size_t cell(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(columns_) + static_cast<size_t>(x);
  }
  void box(double x_min, double x_max, double y_min, double y_max, std::vector<uint32_t>& out) const;

  std::vector<Segment> walls_;
  std::vector<uint32_t> first_, of_cell_;  // of_cell_[first_[c] .. first_[c + 1]) are the walls of cell c
  double x_ = 0, y_ = 0, cell_m_ = 2;
  int columns_ = 0, rows_ = 0;
};

}  // namespace sidestep
