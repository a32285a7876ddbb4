// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "core/params.h"
#include "planning/band/obstacle_view.h"
#include "planning/local_planner.h"

namespace sidestep {

struct EvasionParams {
  double before_s = 2.5;  ///< if the chosen band touches something that moves within this time, evading is looked at
  double ahead_s = 4;     ///< for how long a manoeuvre is looked at
  double clearance_m = 0.45;  ///< more than this is no better
  double step_s = 0.1;

  void visit(ParamVisitor& v);
};

/// What a robot can do when no band is clear and standing is not safe either, since somebody comes: arcs, and turns
/// followed by straight drives, each within the limits and against where everybody will be.
class Evasion {
 public:
  struct Answer {
    mrpt::math::TTwist2D command;  ///< to order now, before it is clamped
    double contact_s = 0;          ///< when it touches something; infinity: not in `ahead_s`
    double least_m = 0;            ///< least clearance on the way, at most `clearance_m`
    bool clear() const;
  };

  explicit Evasion(const EvasionParams& params) : params_(params) {}

  /// Stops, and stands.
  Answer stand(const PlanInput& input, const ObstacleView& obstacles);
  /// The manoeuvre that touches nothing, or that as late as possible; among those that touch nothing, the one that
  /// keeps clearest, then the one that gets nearest to `target`.
  Answer best(const PlanInput& input, const ObstacleView& obstacles, const mrpt::math::TPoint2D& target);
  /// Of the last `best`.
  const std::vector<TrajectoryPoint>& trajectory() const { return best_; }

 private:
  /// Turn by an angle, then go at these speeds.
  struct Manoeuvre {
    double turn = 0, v = 0, w = 0;
  };
  Answer drive(const PlanInput& input, const ObstacleView& obstacles, const Manoeuvre& m);

  EvasionParams params_;
  std::vector<TrajectoryPoint> driven_, best_;
};

}  // namespace sidestep
