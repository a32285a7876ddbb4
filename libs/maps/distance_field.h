// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/params.h"

namespace sidestep {

/// How a raster of square cells lies in the map frame. Cell (0, 0) is the one at the raster's corner, ix grows along
/// the raster's x axis, iy along its y axis; cell (ix, iy) is number iy * width + ix.
struct GridFrame {
  int width = 0, height = 0;
  double resolution_m = 0.05;      ///< side of a cell [m], > 0
  mrpt::math::TPose2D T_map_grid;  ///< of the outer corner of cell (0, 0)

  /// Centre of a cell, in the map frame [m].
  mrpt::math::TPoint2D centre(int ix, int iy) const;
};

struct DistanceFieldParams {
  double cap_m = 5;              ///< farther obstacles count as being this far [m]
  bool negative_inside = false;  ///< inside of obstacles: minus the way out, instead of 0

  void visit(ParamVisitor& v);
};

/// A rectangle of cells, both corners included.
struct CellWindow {
  int ix_min = 0, iy_min = 0, ix_max = -1, iy_max = -1;
};

/// Distance to the nearest static obstacle, everywhere: exact Euclidean at the centres of cells, bilinear in between.
///
/// An obstacle is the centre of a blocked cell; whatever lies outside of the raster is blocked as well. At the rim the
/// field goes on continuously: a position outside of the raster has minus its distance to the raster, plus what the
/// rim has there (at most half a cell), so that a gradient always leads back. Queries are const, allocate nothing and
/// may run in many threads at once. All positions are in the map frame [m].
class DistanceField {
 public:
  /// @param blocked  one byte a cell, 0 = free; width * height of them
  /// @throws ConfigError if the frame has no cells or no positive resolution, or the count does not fit.
  DistanceField(const GridFrame& frame, std::span<const uint8_t> blocked, const DistanceFieldParams& params = {});
  /// From the clearance at each cell's centre [m], where that is known better than by cells, for example of walls; cut
  /// to the cap. `update` knows nothing of such obstacles: around its window it would lose those that block no cell.
  /// @throws ConfigError as above.
  DistanceField(const GridFrame& frame, std::span<const float> clearances, const DistanceFieldParams& params = {});

  /// [m], at most the cap; minus infinity for a position that is not finite.
  double clearance(double x, double y) const;
  /// The same with its derivative by x and y (dimensionless, map frame); on the lines between centres, where it has a
  /// kink, that of one side. Zero where the field is flat: at the cap, inside of obstacles unless `negative_inside`.
  double clearance(double x, double y, mrpt::math::TPoint2D& gradient) const;
  /// Value at the centre of a cell of the raster [m]; <= 0 means blocked.
  float atCell(int ix, int iy) const { return values_[index(ix, iy)]; }
  bool isInside(double x, double y) const;

  /// Whether a disc keeps all obstacles at its rim or outside.
  bool discFits(const mrpt::math::TPoint2D& centre, double radius_m) const {
    return clearance(centre.x, centre.y) >= radius_m;
  }
  /// Whether no obstacle is closer than `margin_m` to a simple polygon (corners in the base frame, in either sense,
  /// convex or not); inside counts as 0. A polygon that leaves the raster does not fit.
  bool polygonFits(std::span<const mrpt::math::TPoint2D> footprint, const mrpt::math::TPose2D& T_map_base,
                   double margin_m = 0) const;

  /// The position itself if its clearance is enough, else the nearest centre of a cell that has it, at most
  /// `max_distance_m` away; of equally near ones the one with the lowest cell number.
  std::optional<mrpt::math::TPoint2D> nearestFree(const mrpt::math::TPoint2D& from, double clearance_m,
                                                  double max_distance_m) const;

  /// Smallest clearance on the segment from a to b, exact for the interpolated field, or `at_most` if that is smaller;
  /// stretches that cannot be below it are skipped, so that a small `at_most` makes it fast. [m] If an end is outside
  /// of the raster, the ends alone count.
  double lowestAlong(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b, double at_most) const;
  /// Whether a disc of that radius can slide straight from a to b. Looking from a is looking from b.
  bool visible(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b, double radius_m) const;

  /// Obstacles appeared or went within `window` (it is cut to the raster); the field is then exactly that of building
  /// it anew. Costs the area of the window grown by the cap, or by twice the cap if any cell became free or
  /// `negative_inside` is set.
  /// @param blocked  one byte a cell of the window as given, row by row, 0 = free
  /// @throws ConfigError if the count does not fit the window.
  void update(const CellWindow& window, std::span<const uint8_t> blocked);

  const GridFrame& frame() const { return frame_; }
  double cap() const { return params_.cap_m; }

 private:
  struct GridPoint {
    double u, v;  ///< in cells; whole numbers are centres of the padded raster, whose own cells start at 1
  };
  DistanceField(const GridFrame& frame, size_t cells, const DistanceFieldParams& params);
  size_t index(int ix, int iy) const { return static_cast<size_t>(iy + 1) * stride_ + static_cast<size_t>(ix + 1); }
  GridPoint toGrid(double x, double y) const;
  double lowestAlong(const GridPoint& a, const GridPoint& b, double at_most, bool stop_below) const;
  double lowestInSquare(size_t at, double u, double v, double du, double dv, double length) const;
  bool rowFits(int iy, int from, int to, std::span<const mrpt::math::TPoint2D> footprint,
               const mrpt::math::TPose2D& T_map_base, double margin_m) const;
  int reach() const;
  void compute(const CellWindow& padded);
  void lower(const CellWindow& padded);

  GridFrame frame_;
  DistanceFieldParams params_;
  double cos_ = 1, sin_ = 0, cells_per_m_ = 1;
  size_t stride_ = 0;
  std::vector<float> values_;  ///< [m], with a ring of blocked cells around the raster
  std::vector<uint8_t> free_;  ///< 0 blocked, 255 free; padded alike
};

}  // namespace sidestep
