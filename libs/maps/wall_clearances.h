// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include "core/obstacles.h"
#include "maps/distance_field.h"

namespace sidestep {

/// Exact clearances around walls and discs, at the centres of cells: a wall has no thickness, and lies where it lies.
class WallClearances {
 public:
  /// A raster around all walls and the points `also`, 1 m more on each side, free outside of what is put in.
  /// @param resolution_m  side of a cell; grown where there would be more than four million cells
  /// @param cap_m         farther obstacles count as being this far; costs grow with its square
  WallClearances(std::span<const Segment> walls, std::span<const mrpt::math::TPoint2D> also, double resolution_m,
                 double cap_m);
  void addDisc(const mrpt::math::TPoint2D& centre, double radius_m);
  DistanceField field() const;

 private:
  int column(double x) const { return cell(x - frame_.T_map_grid.x, frame_.width); }
  int row(double y) const { return cell(y - frame_.T_map_grid.y, frame_.height); }
  int cell(double off_m, int count) const;
  template <class Distance>
  void lower(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b, double radius_m, const Distance& distance);

  double cap_m_;
  GridFrame frame_;
  std::vector<float> values_;
};

}  // namespace sidestep
