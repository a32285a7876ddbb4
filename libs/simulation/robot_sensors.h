// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "simulation/laser.h"
#include "simulation/localization_scenario.h"
#include "simulation/observations.h"
#include "simulation/world_params.h"
#include "simulation/world_physics.h"

namespace sidestep {

/// The sensors of one robot of a world: wheels, IMU, GPS, laser, and the truth. Each draws from a stream of its own.
class RobotSensors {
 public:
  RobotSensors(const WorldParams& params, uint64_t seed, size_t robot);
  /// What they say of the step that has just been made.
  void sense(double time_s, const WorldPhysics& world);

  /// Truth and odometry always.
  const SensorStep& sensed() const { return sensed_; }
  void startAt(const mrpt::math::TPose2D& pose) { sensed_.truth.pose = pose; }
  /// The scan of this step, if there was one.
  const LaserScanner* scan() const { return scanned_ ? &laser_ : nullptr; }
  /// What was sensed in this step as observations: `odometry`, `imu`, `gps`, `ground_truth`.
  void tellStep(const ObservationSink& sink) const { tellObservations(sensed_, encoder_params_, gps_params_, sink); }
  /// `laser`, if there was a scan in this step.
  void tellScan(const ObservationSink& sink) const;

 private:
  void senseWheels(const BodyMotion& wheels);
  void senseLaser(const WorldPhysics& world);

  size_t robot_;
  double step_s_;
  EncoderParams encoder_params_;
  GpsErrorParams gps_params_;
  EncoderModel encoders_;
  ImuModel imu_;
  GpsErrorModel gps_;
  LaserScanner laser_;
  SampleClock laser_clock_;
  Random laser_random_;
  SensorStep sensed_;
  bool scanned_ = false;
  std::vector<SeenDisc> discs_;
};

}  // namespace sidestep
