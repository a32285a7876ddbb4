// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/params.h"
#include "simulation/sensor_errors.h"
#include "simulation/trajectory.h"

namespace sidestep {

/// What the wheels said of the time since the step before, by the *nominal* wheels and track.
struct OdometrySample {
  double dt_s = 0;         ///< [s]; 0 at the start
  double distance_m = 0;   ///< [m]
  double turn_rad = 0;     ///< [rad]
  double v = 0, w = 0;     ///< the same by time [m/s, rad/s]; 0 at the start
  int64_t left_ticks = 0;  ///< counted since the start; 0 where encoders.tick_m is 0
  int64_t right_ticks = 0;
  mrpt::math::TPose2D pose;  ///< dead reckoned from (0, 0, 0) by (2.1)-(2.4) [m, rad]
};

/// What the IMU said, at the base.
struct ImuSample {
  bool has_yaw = false;  ///< false in a stretch without heading
  double yaw = 0;        ///< in [-pi, pi) [rad]
  double yaw_rate = 0;   ///< [rad/s]
};

/// A fix in the map frame, at the antenna, which is at the base.
struct GpsSample {
  double x = 0, y = 0;  ///< [m]
};

/// All that was sensed at one instant. Odometry comes first: it says how the robot came here; then heading and fix.
struct SensorStep {
  double time_s = 0;  ///< from the start of the run [s]
  TruthSample truth;
  OdometrySample odometry;
  std::optional<ImuSample> imu;
  std::optional<GpsSample> gps;
};

/// A stretch of time in which signals are missing.
struct OutageParams {
  double from_s = 0, to_s = 0;
  std::string loses = "none";

  void visit(ParamVisitor& v);
  bool losesPosition(double time_s) const { return covers(time_s) && (loses == "xy" || loses == "all"); }
  bool losesHeading(double time_s) const { return covers(time_s) && (loses == "theta" || loses == "all"); }

 private:
  bool covers(double time_s) const { return time_s >= from_s && time_s < to_s; }
};

/// A robot on a known motion, and what its sensors make of it.
struct LocalizationScenarioParams {
  TrajectoryParams trajectory;
  EncoderParams encoders;
  ImuErrorParams imu;
  GpsErrorParams gps;
  OutageParams roof;

  void visit(ParamVisitor& v);
  /// @throws ConfigError for what the ranges of single parameters do not catch.
  void check() const;
};

class LocalizationScenario;

/// One seeded run of a scenario, step by step, without allocation. Each sensor draws from a stream of its own:
/// switching one off leaves what the others say as it was. The scenario must outlive it.
class SensorStream {
 public:
  SensorStream(const LocalizationScenario& scenario, uint64_t seed);
  /// The next step; the first is the start itself, with the first measurements at the step after it.
  /// @return false at the end.
  bool next(SensorStep& out);

 private:
  const LocalizationScenario* scenario_;
  size_t k_ = 0;
  mrpt::math::TPose2D odometry_pose_;
  EncoderModel encoders_;
  ImuModel imu_;
  GpsErrorModel gps_;
};

/// A scenario ready to run many times: the truth is computed once.
class LocalizationScenario {
 public:
  /// @throws ConfigError as LocalizationScenarioParams::check.
  explicit LocalizationScenario(const LocalizationScenarioParams& params);

  const LocalizationScenarioParams& params() const { return params_; }
  /// At 0, step, 2 step, ...; the same in each run.
  const std::vector<TruthSample>& truth() const { return truth_; }
  SensorStream run(uint64_t seed) const { return {*this, seed}; }
  /// A whole run at once.
  std::vector<SensorStep> generate(uint64_t seed) const;

 private:
  LocalizationScenarioParams params_;
  std::vector<TruthSample> truth_;
};

}  // namespace sidestep
