// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>
#include <mrpt/math/TTwist2D.h>
#include <mrpt/obs/obs_frwds.h>

#include <optional>
#include <string>

#include "core/params.h"
#include "localization/motion.h"

namespace sidestep {

/// How a robot's odometry is read.
struct OdometryParams {
  std::string source = "auto";
  double ticks_left_m = 0;   // m per tick
  double ticks_right_m = 0;  // m per tick
  double track_m = 0;        // m
  double scale = 1;
  double gap_s = 2;
  double jump_speed = 60;          // m/s
  double still_speed = 0.005;      // m/s
  double still_turn_rate = 0.005;  // rad/s
  MotionNoiseParams noise;

  void visit(ParamVisitor& v);
  /// @throws ConfigError if ticks are asked for without wheel and track sizes.
  void check() const;
};

/// The motion between two odometry readings, as the odometry tells it.
struct OdometryIncrement {
  double from_s = 0, to_s = 0;    ///< stamps of the two readings [s]
  mrpt::math::TPose2D T_from_to;  ///< the displacement, in the frame of the first [m, rad]
  MotionStep step;                ///< the same as arc and turn, with noise
};

/// Dead reckoning from poses, velocities or encoder ticks (2.1)-(2.3): turns odometry observations into increments.
///
/// `auto` takes poses if they ever move, else ticks if there are any and the wheels are known, else velocities. A
/// reading that would mean a speed over `jump_speed` is a restarted odometry: it starts anew and gives no increment.
class OdometryModel {
 public:
  explicit OdometryModel(const OdometryParams& params);
  /// Nothing for the first reading, a stamp that does not advance, or a jump (which what is not finite is, too).
  std::optional<OdometryIncrement> advance(double time_s, const mrpt::obs::CObservationOdometry& reading);
  int jumps() const { return jumps_; }

 private:
  struct Reading {
    double time_s;
    mrpt::math::TPose2D pose;
    bool has_velocity, has_ticks;
    mrpt::math::TTwist2D velocity;
    double left_ticks, right_ticks;
  };
  enum class Source { kPose, kVelocity, kTicks };
  static Reading read(double time_s, const mrpt::obs::CObservationOdometry& o);
  Source pickSource(const Reading& now) const;
  mrpt::math::TPose2D displacement(const Reading& now, Source source) const;

  OdometryParams params_;
  std::optional<Reading> last_;
  bool poses_move_ = false;
  int jumps_ = 0;
};

}  // namespace sidestep
