// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// What each sensor says, as motion or as measurements; localizer.cpp puts them in their places.
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <cmath>

#include "localization/localizer.h"

namespace sidestep {

void Localizer::odometry(int stream, double time_s, const mrpt::obs::CObservationOdometry& o) {
  ++use(stream).read;
  start_.begin(time_s);
  const uint64_t index = odometry_count_++;
  if (index == 0) first_odometry_s_ = time_s;
  const auto step = motion_.addOdometry(time_s, o);
  if (!step) {
    if (index > 0) refuse(stream, "no_increment");
    tryStart(false);
    if (started_ && time_s > now_s_ + 1e-9) {
      coastTo(time_s);
      owe(index);
    }
    return;
  }
  ++use(stream).used;
  if (!started_) {
    waiting_.push_back({*step, index});
    odometry_pose_ = odometry_pose_ + step->T_from_to;
    start_.track(time_s, odometry_pose_);
    tryStart(false);
    return;
  }
  giveOut();
  odometry_pose_ = odometry_pose_ + step->T_from_to;
  if (step->to_s <= now_s_) return;  // all of it was coasted already
  if (step->from_s > now_s_ + 1e-9) coastTo(step->from_s);
  MotionStep motion = step->motion;
  gapNoise(motion);
  advanceTo(step->to_s, motion.part(std::min(1.0, (step->to_s - now_s_) / motion.dt_s)));
  if (step->resting_rate) addStill(*step, stream);
  owe(index);
}

void Localizer::gapNoise(MotionStep& motion) const {
  const double gap = motion.dt_s;
  if (gap <= params_.odometry.gap_s) return;
  motion.turn_var += std::min(M_PI * M_PI, std::pow(params_.coast_turn_accel * gap, 2));
  motion.distance_var += std::pow(0.1 * motion.distance_m, 2) + std::pow(params_.odometry.still_speed * gap, 2);
}

void Localizer::addStill(const MotionSource::Step& step, int stream) {
  Event e;
  e.is_motion = false;
  e.counted = true;  // no measurement of the log
  e.time_s = now_s_;
  e.measurement.kind = Measurement::Kind::kStill;
  e.measurement.time_s = now_s_;
  e.measurement.stream = stream;
  e.measurement.z(0) = *step.resting_rate;
  e.measurement.R(0, 0) = params_.imu.yaw_rate_sd * params_.imu.yaw_rate_sd / std::max(step.motion.dt_s, 1e-3);
  append(std::move(e));
}

void Localizer::imu(int stream, double time_s, const mrpt::obs::CObservationIMU& o) {
  auto& u = use(stream);
  ++u.read;
  const ImuReading reading = readImu(params_.imu, o);
  if (!reading.heading_rad && !reading.yaw_rate) return refuse(stream, "no_yaw");
  if (reading.yaw_rate) motion_.addYawRate(time_s, *reading.yaw_rate);
  if (!reading.heading_rad) {
    ++u.used;
    return;
  }
  addHeading(stream, time_s, *reading.heading_rad);
}

void Localizer::heading(int stream, double time_s, double heading_rad) {
  ++use(stream).read;
  addHeading(stream, time_s, heading_rad - params_.imu.heading_offset);
}

void Localizer::positionHeading(int stream, double time_s, double x, double y, double heading_rad) {
  ++use(stream).read;
  auto m = gps_.measurement(time_s, x, y);
  const auto h =
      headingMeasurement(params_.imu, m.time_s + params_.imu.delay_s, heading_rad - params_.imu.heading_offset,
                         last_heading_s_ > 0 ? time_s - last_heading_s_ : 0);
  last_heading_s_ = time_s;
  m.kind = Measurement::Kind::kPositionHeading;
  m.stream = stream;
  m.z(2) = h.z(0);
  m.R(2, 2) = h.R(0, 0);
  m.heading_has_offset = h.heading_has_offset;
  fixes_.push_back({x, y});
  add(m);
}

void Localizer::yawRate(int stream, double time_s, double rate) {
  ++use(stream).read;
  ++use(stream).used;
  motion_.addYawRate(time_s, params_.imu.yaw_rate_scale * (rate - params_.imu.yaw_rate_bias));
}

void Localizer::addHeading(int stream, double time_s, double heading_rad) {
  auto m = headingMeasurement(params_.imu, time_s, heading_rad, last_heading_s_ > 0 ? time_s - last_heading_s_ : 0);
  last_heading_s_ = time_s;
  m.stream = stream;
  add(m);
}

void Localizer::gps(int stream, double time_s, const mrpt::obs::CObservationGPS& o) {
  ++use(stream).read;
  auto m = gps_.measurement(time_s, o);
  if (!m) return refuse(stream, "no_fix");
  m->stream = stream;
  fixes_.push_back({m->z.x(), m->z.y()});
  add(*m);
}

void Localizer::position(int stream, double time_s, double x, double y) {
  ++use(stream).read;
  auto m = gps_.measurement(time_s, x, y);
  m.stream = stream;
  fixes_.push_back({x, y});
  add(m);
}

void Localizer::beacons(int stream, double time_s, const mrpt::obs::CObservationBeaconRanges& o) {
  for (auto& m : beaconMeasurements(params_.beacons, time_s, o)) {
    ++use(stream).read;
    m.stream = stream;
    add(m);
  }
}

void Localizer::laser(int stream, double time_s, const mrpt::obs::CObservation2DRangeScan& o) {
  ++use(stream).read;
  Measurement m;
  m.kind = Measurement::Kind::kScan;
  m.time_s = time_s - params_.laser.delay_s;
  m.stream = stream;
  m.scan = readScan(params_.laser, o);
  if (!m.scan) return refuse(stream, "no_range");
  add(m);
}

}  // namespace sidestep
