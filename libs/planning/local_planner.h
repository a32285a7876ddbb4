// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>
#include <mrpt/math/TTwist2D.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/obstacles.h"
#include "core/robot_limits.h"

namespace sidestep {

class DistanceField;  // maps/distance_field.h

/// All that a local planner may know, at one instant. All poses and points are in the map frame.
struct PlanInput {
  double time_s = 0;
  mrpt::math::TPose2D pose;
  mrpt::math::TTwist2D twist;  ///< in the base frame: vx [m/s], omega [rad/s]
  mrpt::math::TPose2D goal;
  bool goal_heading_matters = false;
  std::span<const mrpt::math::TPose2D> path;  ///< the global path, may be empty: then straight to the goal
  std::span<const Segment> walls;
  std::span<const mrpt::math::TPoint2D> points;  ///< static points, for example of a laser scan
  const DistanceField* field = nullptr;          ///< static obstacles of a map; null: none
  std::span<const MovingObstacle> moving;
  RobotLimits limits;
  double period_s = 0.1;  ///< until the next call
  /// Says that the time allowed is over; empty: take all that is needed. A planner reads no clock of its own.
  std::function<bool()> out_of_time;
};

/// A pose of the intended trajectory.
struct TrajectoryPoint {
  double after_s = 0;
  mrpt::math::TPose2D pose;
  double v = 0, w = 0;
};

/// One considered alternative, and what each term thought of it.
struct PlanCandidate {
  std::vector<TrajectoryPoint> trajectory;
  std::vector<std::pair<std::string, double>> costs;  ///< term, weighted share; the sum is what was compared
  double total = 0;
  std::string rejected;  ///< why it lost, "" for the chosen one
};

/// What a local planner orders, and why.
struct PlanOutput {
  enum class Status { kMoving, kGoalReached, kBraking, kNoPlan };
  Status status = Status::kNoPlan;
  mrpt::math::TTwist2D command;  ///< in the base frame, inside the limits and reachable within `period_s`
  std::vector<TrajectoryPoint> trajectory;
  std::vector<std::pair<std::string, double>> costs;
  std::vector<PlanCandidate> candidates;  ///< filled if asked for (`LocalPlanner::explain`)
  std::string reason;                     ///< why it brakes or has no plan; "" on a good day
};

/// A planner of the next seconds.
///
/// `plan` is called once a period with what is known; it may keep state between calls (a warm start), which `reset`
/// forgets. The same sequence of inputs gives the same outputs. Its command is always finite and inside the limits;
/// when it does not know what is safe it brakes, and says why. After the first calls it allocates nothing, unless it
/// explains.
class LocalPlanner {
 public:
  virtual ~LocalPlanner() = default;
  /// `out` keeps its memory between calls.
  virtual void plan(const PlanInput& input, PlanOutput& out) = 0;
  virtual void reset() = 0;
  /// Whether `candidates` is to be filled, at the cost of copying them.
  void explain(bool on) { explain_ = on; }

 protected:
  bool explain_ = false;
};

}  // namespace sidestep
