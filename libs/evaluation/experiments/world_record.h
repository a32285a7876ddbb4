// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>
#include <vector>

#include "figures/timeline_figure.h"
#include "figures/world_figure.h"
#include "simulation/world.h"

namespace sidestep {

/// Notes what a figure or a metric of a run wants to know, step by step.
class WorldRecorder {
 public:
  /// Notes the start. The world must outlive it.
  explicit WorldRecorder(const World& world);
  /// To be called after each step.
  void note();

  const WorldFigure& figure() const { return figure_; }
  WorldFigure& figure() { return figure_; }
  /// Every `figure().period_s`.
  const std::vector<TimelineFigure::Sample>& timeline() const { return timeline_; }
  /// Largest collision index (4.11) so far, over people and other robots, at each step.
  double largestCollisionIndex() const { return largest_index_; }
  /// Time for which it was above the threshold. [s]
  double timeAboveThreshold() const { return above_s_; }
  /// Time for which the robot stood (below 1 cm/s). [s]
  double timeStanding() const { return standing_s_; }

 private:
  void notePlaces();
  double collisionIndexNow() const;

  const World& world_;
  WorldFigure figure_;
  std::vector<TimelineFigure::Sample> timeline_;
  double next_s_ = 0, clearance_m_ = std::numeric_limits<double>::infinity();
  double largest_index_ = 0, index_ = 0, above_s_ = 0, standing_s_ = 0;
};

}  // namespace sidestep
