// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/observations.h"

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/topography/conversions.h>

#include <cmath>

namespace sidestep {
namespace {

mrpt::Clock::time_point stampOf(double time_s) { return mrpt::Clock::fromDouble(kSimulationStart_s + time_s); }

mrpt::obs::CObservationOdometry odometryOf(const SensorStep& step, const EncoderParams& encoders) {
  mrpt::obs::CObservationOdometry o;
  o.sensorLabel = "odometry";
  o.timestamp = stampOf(step.time_s);
  o.odometry = mrpt::poses::CPose2D(step.odometry.pose);
  o.hasVelocities = true;
  o.velocityLocal = {step.odometry.v, 0, step.odometry.w};
  o.hasEncodersInfo = encoders.tick_m > 0;
  o.encoderLeftTicks = static_cast<int32_t>(step.odometry.left_ticks);
  o.encoderRightTicks = static_cast<int32_t>(step.odometry.right_ticks);
  return o;
}

mrpt::obs::CObservationIMU imuOf(double time_s, const ImuSample& sample) {
  mrpt::obs::CObservationIMU o;
  o.sensorLabel = "imu";
  o.dataIsPresent.fill(false);
  o.rawMeasurements.fill(0);
  o.timestamp = stampOf(time_s);
  if (sample.has_yaw) o.set(mrpt::obs::IMU_YAW, sample.yaw);
  o.set(mrpt::obs::IMU_WZ, sample.yaw_rate);
  return o;
}

mrpt::obs::CObservationRobotPose poseOf(double time_s, const char* label, const mrpt::math::TPose2D& pose,
                                        double position_var, double yaw_var) {
  mrpt::obs::CObservationRobotPose o;
  o.sensorLabel = label;
  o.timestamp = stampOf(time_s);
  o.pose.mean = mrpt::poses::CPose3D(pose.x, pose.y, 0, pose.phi, 0, 0);
  o.pose.cov.setZero();
  o.pose.cov(0, 0) = o.pose.cov(1, 1) = position_var;
  o.pose.cov(3, 3) = yaw_var;
  return o;
}

/// NMEA's time of day of a stamp; UTC has no leap seconds here.
mrpt::obs::gnss::UTC_time utcOf(double unix_s) {
  const double day = std::fmod(unix_s, 86400);
  mrpt::obs::gnss::UTC_time out;
  out.hour = static_cast<uint8_t>(day / 3600);
  out.minute = static_cast<uint8_t>(std::fmod(day, 3600) / 60);
  out.sec = std::fmod(day, 60);
  return out;
}

mrpt::obs::CObservationGPS ggaOf(double time_s, const GpsSample& fix, const GpsErrorParams& gps) {
  const mrpt::topography::TGeodeticCoords datum(gps.datum_lat_deg, gps.datum_lon_deg, gps.datum_height_m);
  mrpt::topography::TGeocentricCoords xyz;
  mrpt::topography::TGeodeticCoords at;
  mrpt::topography::ENUToGeocentric({fix.x, fix.y, 0}, datum, xyz, mrpt::topography::TEllipsoid::Ellipsoid_WGS84());
  mrpt::topography::geocentricToGeodetic(xyz, at, mrpt::topography::TEllipsoid::Ellipsoid_WGS84());
  mrpt::obs::gnss::Message_NMEA_GGA gga;
  gga.fields.UTCTime = utcOf(kSimulationStart_s + time_s);
  gga.fields.latitude_degrees = at.lat.decimal_value;
  gga.fields.longitude_degrees = at.lon.decimal_value;
  gga.fields.altitude_meters = at.height;
  gga.fields.fix_quality = 1;
  gga.fields.satellitesUsed = 9;
  mrpt::obs::CObservationGPS o;
  o.sensorLabel = "gps";
  o.timestamp = o.originalReceivedTimestamp = stampOf(time_s);
  o.has_satellite_timestamp = false;
  o.setMsg(gga);
  return o;
}

}  // namespace

void tellObservations(const SensorStep& step, const EncoderParams& encoders, const GpsErrorParams& gps,
                      const ObservationSink& sink) {
  sink(odometryOf(step, encoders));
  if (step.imu) sink(imuOf(step.time_s, *step.imu));
  if (step.gps && gps.output == "latlon") sink(ggaOf(step.time_s, *step.gps, gps));
  if (step.gps && gps.output == "xy")
    sink(poseOf(step.time_s, "gps", {step.gps->x, step.gps->y, 0}, gps.sd_m * gps.sd_m, 1e3));
  sink(poseOf(step.time_s, "ground_truth", step.truth.pose, 0, 0));
}

}  // namespace sidestep
