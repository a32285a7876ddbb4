// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/robot_sensors.h"

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cmath>

#include "core/kinematics.h"

namespace sidestep {
namespace {

/// The robot under test has the world's own streams, each other one streams of its own.
Random sensorRandom(const WorldParams& params, uint64_t seed, size_t robot, WorldStream sensor) {
  constexpr uint64_t kOthers = 1 << 20, kSensors = 8;
  if (robot == params.underTest()) return worldRandom(seed, sensor);
  return Random(seed, kOthers + kSensors * robot + static_cast<uint64_t>(sensor));
}

}  // namespace

RobotSensors::RobotSensors(const WorldParams& p, uint64_t seed, size_t robot)
    : robot_(robot),
      step_s_(p.step_s),
      encoder_params_(p.encoders),
      gps_params_(p.gps),
      encoders_(p.encoders, sensorRandom(p, seed, robot, WorldStream::kEncoders)),
      imu_(p.imu, sensorRandom(p, seed, robot, WorldStream::kImu)),
      gps_(p.gps, sensorRandom(p, seed, robot, WorldStream::kGps)),
      laser_(p.laser),
      laser_clock_(p.laser.rate_hz),
      laser_random_(sensorRandom(p, seed, robot, WorldStream::kLaser)) {}

void RobotSensors::sense(double time_s, const WorldPhysics& world) {
  const RobotState& s = world.robots()[robot_];
  senseWheels(world.wheels(robot_));
  sensed_.time_s = time_s;
  sensed_.truth = {time_s, s.pose, s.twist.vx, s.twist.omega, s.twist.vx * step_s_, s.twist.omega * step_s_};
  sensed_.imu.reset();
  sensed_.gps.reset();
  if (imu_.due(time_s)) {
    const auto r = imu_.read(time_s, s.pose.phi, s.twist.omega);
    sensed_.imu = {true, r.yaw, r.yaw_rate};
  }
  if (gps_.due(time_s)) {
    const auto r = gps_.read(time_s, s.pose.x, s.pose.y);
    if (!gps_.inOutage(time_s)) sensed_.gps = {r.x, r.y};
  }
  scanned_ = laser_clock_.due(time_s);
  if (scanned_) senseLaser(world);
}

void RobotSensors::senseWheels(const BodyMotion& motion) {
  const auto wheels = encoders_.step(step_s_, motion.ahead, motion.turn);
  OdometrySample& o = sensed_.odometry;
  o.dt_s = step_s_;
  o.distance_m = wheels.distance_m, o.turn_rad = wheels.turn_rad;
  o.v = wheels.distance_m / step_s_, o.w = wheels.turn_rad / step_s_;
  o.left_ticks = wheels.left_ticks, o.right_ticks = wheels.right_ticks;
  o.pose = alongArc(o.pose, wheels.distance_m, wheels.turn_rad);
}

void RobotSensors::senseLaser(const WorldPhysics& world) {
  discs_.clear();
  for (const Person& p : world.people()) {
    if (!p.present) continue;
    if (laser_.params().people == "legs")
      addLegs(p, discs_);
    else
      discs_.push_back({p.position, p.radius_m});
  }
  const auto bodies = world.bodies();
  for (size_t k = 0; k < bodies.size(); ++k)
    if (k != robot_) discs_.push_back({bodies[k].position, bodies[k].radius_m});
  laser_.cast(world.robots()[robot_].pose, world.walls(), discs_);
  laser_.disturb(laser_random_);
}

void RobotSensors::tellScan(const ObservationSink& sink) const {
  if (!scanned_) return;
  const LaserParams& p = laser_.params();
  mrpt::obs::CObservation2DRangeScan o;
  o.sensorLabel = "laser";
  o.timestamp = mrpt::Clock::fromDouble(kSimulationStart_s + sensed_.time_s);
  o.rightToLeft = true;
  o.aperture = static_cast<float>(p.field);
  o.maxRange = static_cast<float>(p.range_m);
  o.stdError = static_cast<float>(p.range_sd_m);
  o.sensorPose = mrpt::poses::CPose3D(p.x_m, p.y_m, 0, p.yaw, 0, 0);
  const auto& ranges = laser_.ranges();
  o.resizeScan(ranges.size());
  for (size_t i = 0; i < ranges.size(); ++i) {
    const bool seen = std::isfinite(ranges[i]);
    o.setScanRange(i, static_cast<float>(seen ? ranges[i] : 0));
    o.setScanRangeValidity(i, seen);
  }
  sink(o);
}

}  // namespace sidestep
