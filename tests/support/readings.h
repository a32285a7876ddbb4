// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/reading.h"

/// Observations and exact paths for the tests of localization.
namespace sidestep::support {

constexpr double kStart_s = 1.6e9;

/// Pose at `t` on a circle that starts at the origin towards +x: R = v / w, counter-clockwise for w > 0.
inline mrpt::math::TPose2D onCircle(double v, double w, double t) {
  return {v / w * std::sin(w * t), v / w * (1 - std::cos(w * t)), w * t};
}

inline mrpt::obs::CObservationOdometry odometryAt(double time_s, const mrpt::math::TPose2D& pose) {
  mrpt::obs::CObservationOdometry o;
  o.timestamp = mrpt::Clock::fromDouble(time_s);
  o.odometry = mrpt::poses::CPose2D(pose);
  o.hasVelocities = o.hasEncodersInfo = false;
  return o;
}

inline mrpt::obs::CObservationOdometry velocityAt(double time_s, double v, double w) {
  auto o = odometryAt(time_s, {0, 0, 0});
  o.hasVelocities = true;
  o.velocityLocal = {v, 0, w};
  return o;
}

inline mrpt::obs::CObservationIMU imuWith(const std::vector<std::pair<mrpt::obs::TIMUDataIndex, double>>& values) {
  mrpt::obs::CObservationIMU o;
  o.dataIsPresent.fill(false);
  for (const auto& [index, value] : values) o.set(index, value);
  return o;
}

inline mrpt::obs::CObservationIMU yawRate(double rate) { return imuWith({{mrpt::obs::IMU_WZ, rate}}); }
inline mrpt::obs::CObservationIMU yaw(double angle) { return imuWith({{mrpt::obs::IMU_YAW, angle}}); }

inline mrpt::obs::CObservationGPS fixAt(double latitude_deg, double longitude_deg, double hdop = 0) {
  mrpt::obs::gnss::Message_NMEA_GGA gga;
  gga.fields.latitude_degrees = latitude_deg;
  gga.fields.longitude_degrees = longitude_deg;
  gga.fields.altitude_meters = 50;
  gga.fields.fix_quality = 1;
  gga.fields.thereis_HDOP = hdop > 0;
  gga.fields.HDOP = static_cast<float>(hdop);
  mrpt::obs::CObservationGPS o;
  o.setMsg(gga);
  return o;
}

/// What a log gives of an observation: labelled by its kind's word.
template <class Observation>
Reading readingOf(SensorKind kind, double time_s, Observation o) {
  o.timestamp = mrpt::Clock::fromDouble(time_s);
  o.sensorLabel = word(kind);
  return {time_s, kind, word(kind), std::make_shared<Observation>(std::move(o))};
}

inline Reading wheelsAt(double time_s, const mrpt::math::TPose2D& pose) {
  return readingOf(SensorKind::kOdometry, time_s, odometryAt(time_s, pose));
}

/// A metric fix.
inline Reading positionAt(double time_s, double x, double y) {
  mrpt::obs::CObservationRobotPose o;
  o.pose.mean.setFromValues(x, y, 0, 0, 0, 0);
  return readingOf(SensorKind::kGps, time_s, std::move(o));
}

}  // namespace sidestep::support
