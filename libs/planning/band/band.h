// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <span>
#include <vector>

#include "core/robot_limits.h"
#include "planning/band/interval.h"

namespace sidestep {

/// (2.31): poses from where the robot is to the goal, with their times. The first stands at t = 0.
using Band = std::vector<BandPose>;

/// Speeds that are known at the ends of a band.
struct BandEnds {
  double v = 0, w = 0;     ///< at the start [m/s], [rad/s]
  bool goal_stops = true;  ///< at the goal speed is 0; else it is free
};

/// Largest values along a band, as its intervals show them (2.35), (2.36), ends included.
struct BandExtremes {
  double v = 0, w = 0, a = 0, turn_accel = 0;
};
BandExtremes extremesOf(const Band& band, const BandEnds& ends);

struct TrajectorySpeed {
  double v = 0, w = 0;
};

/// Where the band is at time `t`, on the arc between its poses; beyond the ends it rests.
BandPose bandAt(const Band& band, double t);
/// Speed and turn rate at time `t`: linear between the middles of intervals, from `ends` at the start.
TrajectorySpeed speedAt(const Band& band, const BandEnds& ends, double t);

/// Poses at equal times, `intervals` of them, along the band from its time `from_s` on; times then start at 0.
void resample(const Band& band, double from_s, int intervals, Band& out);

enum class Retiming {
  kRepair,   ///< intervals only grow
  kQuickest  ///< they start from the least that the speed limits allow: the shortest time for these poses
};

/// Lengthens intervals until speeds and accelerations are inside the limits, the poses staying where they are. What
/// cannot be repaired so (the robot is too fast for the band's beginning) is left.
void retime(Band& band, const RobotLimits& limits, const BandEnds& ends, Retiming kind = Retiming::kRepair);

/// Fastest drive along a line of some length, from a given speed on; to rest or through.
struct SpeedProfile {
  SpeedProfile(double length_m, double v_start, const RobotLimits& limits, bool stops);
  double duration() const { return total_; }
  /// Way done at time t [m].
  double wayAt(double t) const;

 private:
  double length_, v0_, peak_, accel_, brake_, s_up_, s_flat_, t_up_, t_flat_, total_;
};

}  // namespace sidestep
