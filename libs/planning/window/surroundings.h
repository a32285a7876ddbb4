// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include "planning/local_planner.h"
#include "planning/window/rollout.h"

namespace sidestep {

/// Everything that rollouts may touch, in the robot's frame at the start, with moving obstacles laid out over time.
///
/// Rollouts are followed in steps of `step_s`; a step is skipped when nothing can be reached until the next: the gap at
/// one step, over the speed at which it can shrink, tells how many. A touch between two steps is therefore found one
/// step late at most, and a graze of less than (speed step)^2 / (8 radius) not at all (8 mm at 2 m/s and 0.1 s).
class Surroundings {
 public:
  /// What a rollout of this horizon can meet; the rest is left out.
  /// @param margin_m  kept around everything; where the robot is nearer than that already, what there is
  /// @param predict   moving obstacles move (as predicted, or straight on); else they stand, as in the dissertation
  /// @param sigmas    they grow by this many sd of their position at that time
  void look(const PlanInput& input, double look_ahead_s, double step_s, double margin_m, bool predict, double sigmas);

  int steps() const { return steps_; }
  double step() const { return step_s_; }
  /// Follows the rollout and fills `free_s`, `touched` and `gap_m`. `unit_x`, `unit_y`: the arc of that w for v = 1, at
  /// each step.
  void follow(std::span<const double> unit_x, std::span<const double> unit_y, Rollout& rollout) const;
  /// Whether the robot, having driven the rollout for a period, could brake along its arc and then stand until the end
  /// of the look-ahead without being touched.
  bool canStop(std::span<const double> unit_x, std::span<const double> unit_y, const Rollout& rollout, double period_s,
               double brake) const;

 private:
  struct Gap {
    double m;
    int index;
  };
  void addMoving(const PlanInput& input, double margin_m, bool predict, double sigmas);
  void addStatic(const PlanInput& input, double margin_m);
  mrpt::math::TPoint2D local(const mrpt::math::TPoint2D& map) const;
  Gap movingGap(int k, double x, double y) const;
  bool isPassed(double x, double y) const;
  double staticGap(double x, double y) const;

  int steps_ = 0, movers_ = 0;
  double step_s_ = 0.1, reach_m_ = 0, fastest_ = 0, cos_ = 1, sin_ = 0;
  mrpt::math::TPose2D pose_;
  std::vector<float> mover_x_, mover_y_, mover_r_;  ///< [step * movers + mover]; r with the robot's radius
  std::vector<int> mover_id_;
  std::vector<float> point_x_, point_y_, point_r_;
  std::vector<Segment> walls_;
  std::vector<double> wall_r_;
  const DistanceField* field_ = nullptr;
  double field_r_ = 0;
};

}  // namespace sidestep
