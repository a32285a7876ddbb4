// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "core/params.h"
#include "planning/band/band.h"
#include "planning/band/footprint.h"
#include "planning/band/obstacle_view.h"
#include "planning/local_planner.h"

namespace sidestep {

struct CheckParams {
  double ahead_s = 1.0;  ///< what is checked of a trajectory before its first command leaves; then braking to rest
  double step_s = 0.05;  ///< between the poses that are checked

  void visit(ParamVisitor& v);
};

/// What a check says: whether the robot stays clear, and if not, of what and when.
struct CheckResult {
  bool clear = true;
  double contact_s = 0;  ///< when it would touch
  int obstacle = -1;     ///< what: MovingObstacle::id, or -1 for something static
  double least_m = 1e9;  ///< least clearance on the way [m]
};

/// Drives a band for a while from where the robot really is, then brakes on its curve, and looks whether it touches
/// anything: what moves counts while driving, what stands until the robot does. A robot that touches something already
/// may only get away from it.
CheckResult checkStart(const Band& band, const BandEnds& ends, const RobotLimits& limits, const Footprint& robot,
                       const ObstacleView& obstacles, const CheckParams& params, std::vector<TrajectoryPoint>& driven);

/// Clearance of a whole band, between its poses too.
CheckResult checkWhole(const Band& band, const Footprint& robot, const ObstacleView& obstacles);

}  // namespace sidestep
