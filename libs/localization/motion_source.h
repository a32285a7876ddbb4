// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <deque>

#include "localization/sensors/imu.h"
#include "localization/sensors/odometry_model.h"

namespace sidestep {

/// Motion from wheels and, where there is one, the gyro: how far by the wheels, how much of a turn by the gyro.
class MotionSource {
 public:
  MotionSource(const OdometryParams& odometry, const ImuParams& imu, bool zero_velocity);

  struct Step {
    double from_s = 0, to_s = 0;
    MotionStep motion;
    mrpt::math::TPose2D T_from_to;       ///< what the odometry alone says
    std::optional<double> resting_rate;  ///< mean of the gyro over a stretch of standing still [rad/s]
  };

  void addYawRate(double time_s, double rate);
  std::optional<Step> addOdometry(double time_s, const mrpt::obs::CObservationOdometry& o);

 private:
  /// Integral of the yaw rate over [from, to], trapezoids between samples; nothing if the samples leave holes.
  std::optional<double> turn(double from_s, double to_s) const;
  void forget(double before_s);

  struct Sample {
    double time_s, rate;
  };
  OdometryModel odometry_;
  ImuParams imu_;
  bool zero_velocity_;
  std::deque<Sample> rates_;
};

}  // namespace sidestep
