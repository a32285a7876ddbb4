// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include "planning/local_planner.h"
#include "planning/velocity/hrvo.h"

namespace sidestep {

/// The velocity model in the hands of a planner: brings everything that `PlanInput` knows into it. Used by the HRVO
/// planner, and as the adviser of EDWA and PTEB.
///
/// Moving obstacles become discs and walls become walls. Static points and the map's obstacles are thinned first: of
/// each direction (5 deg wide) only the nearest counts, as a piece of wall across that direction.
class HrvoSight {
 public:
  explicit HrvoSight(const HrvoParams& params);
  /// (2.29), not faster than `speed`, with the preferred velocity (2.30) towards `target`: `eagerness` times that
  /// speed. The larger it is, the more the answer goes by the progress to the target, and the less by its likeness to
  /// the way there.
  HrvoAnswer velocity(const PlanInput& input, const mrpt::math::TPoint2D& target, double speed);
  Hrvo& model() { return hrvo_; }

 private:
  static constexpr int kDirections = 72;
  void addPoints(const PlanInput& input);
  void addField(const PlanInput& input);
  void addNearest();

  HrvoParams params_;
  Hrvo hrvo_;
  std::array<double, kDirections> nearest_m_{};
};

}  // namespace sidestep
