// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <string>
#include <vector>

namespace sidestep {

/// What a global planner found, or why it found nothing.
struct GlobalPath {
  enum class Status { kFound, kStartOutside, kGoalOutside, kStartBlocked, kGoalBlocked, kUnreachable, kTimeOver };
  Status status = Status::kUnreachable;
  std::string reason;                      ///< "" if found
  std::vector<mrpt::math::TPose2D> poses;  ///< map frame, start to goal, straight in between; headings along the way
  uint64_t expanded = 0;                   ///< nodes looked at
  double cost = 0;  ///< what the planner minimized, in its own unit ([m] unless clearance has a price)

  bool found() const { return status == Status::kFound; }
};

/// A planner of whole paths on a map that stands still.
///
/// Each piece of a path keeps the clearance that the planner was made with, by `DistanceField::visible`. The same
/// queries give the same paths, in whatever order. A planner keeps its working memory between queries: it is not for
/// two threads at once.
class GlobalPlanner {
 public:
  virtual ~GlobalPlanner() = default;
  /// @param start, goal  in the map frame; planners without headings keep that of the goal at the end only
  virtual GlobalPath plan(const mrpt::math::TPose2D& start, const mrpt::math::TPose2D& goal) = 0;
};

}  // namespace sidestep
