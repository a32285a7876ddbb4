// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "maps/distance_field.h"
#include "planning/global/global_planner.h"

namespace sidestep {

/// The eight moves on a grid, counter-clockwise from +x; even ones are straight.
enum Move : int { kEast = 0, kNorthEast, kNorth, kNorthWest, kWest, kSouthWest, kSouth, kSouthEast };

/// A map as the planners on cells see it, for one clearance: built once, then shared by any number of queries.
///
/// A cell is free if its centre has the clearance. Between neighbouring centres lies what is interpolated from the
/// cells at the corners, so a straight move between free cells keeps the clearance, and a diagonal one does if the two
/// cells it passes are free as well.
class PlanningGrid {
 public:
  /// @param field  shared, and not updated while this grid is in use
  /// @param clearance_m  to keep between the robot's centre and all obstacles [m], > 0, at most the field's cap
  /// @throws ConfigError for a clearance out of range.
  PlanningGrid(std::shared_ptr<const DistanceField> field, double clearance_m);

  const DistanceField& field() const { return *field_; }
  double clearance() const { return clearance_m_; }
  /// Cells are numbered row by row with a ring of blocked ones around them.
  int stride() const { return stride_; }
  size_t size() const { return moves_.size(); }
  /// Which of the moves are allowed, bit k for move k; 0 for a blocked cell.
  uint8_t moves(uint32_t cell) const { return moves_[cell]; }
  const uint8_t* allMoves() const { return moves_.data(); }
  /// Cells with the same positive number can reach each other; 0 = blocked.
  int32_t component(uint32_t cell) const { return components_[cell]; }
  bool isFree(uint32_t cell) const { return components_[cell] != 0; }
  /// How far a move goes in cell numbers.
  int step(int move) const { return steps_[static_cast<size_t>(move)]; }
  mrpt::math::TPoint2D centre(uint32_t cell) const;
  double distanceAt(uint32_t cell) const;

  /// Cells around a position, nearest first, whose centres can be reached from it in a straight line; at most four.
  struct Entries {
    std::array<uint32_t, 4> cells{};
    size_t count = 0;
  };
  Entries entries(const mrpt::math::TPoint2D& p) const;

  /// The cells at which a query enters the grid; if there are none, the status and reason that `plan` answers with.
  struct Ends {
    GlobalPath refusal;
    uint32_t start = 0, goal = 0;
    bool ok = false;
  };
  Ends ends(const mrpt::math::TPose2D& start, const mrpt::math::TPose2D& goal) const;

  /// Status and reason if start or goal is no place for the robot.
  std::optional<GlobalPath> refusal(const mrpt::math::TPose2D& start, const mrpt::math::TPose2D& goal) const;

 private:
  std::shared_ptr<const DistanceField> field_;
  double clearance_m_;
  int stride_;
  std::array<int, 8> steps_{};
  std::vector<uint8_t> moves_;
  std::vector<int32_t> components_;
};

/// Polyline through points as poses: headings along the way, at the end that of the goal. Points that lie on top of the
/// one before, or on the straight line between their neighbours, are left out.
std::vector<mrpt::math::TPose2D> posesAlong(const std::vector<mrpt::math::TPoint2D>& points, double goal_heading);

double pathLength(const std::vector<mrpt::math::TPose2D>& poses);

}  // namespace sidestep
