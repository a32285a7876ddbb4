// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/screening.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <cmath>
#include <cstring>
#include <initializer_list>

namespace sidestep {
namespace {

using Dropped = std::function<void(const std::string&)>;

constexpr double kFarthest_m = 2.1e7;  // half the Earth's circumference: UTM and Earth-centred coordinates fit
constexpr double kFastest_mps = 1e4;
constexpr double kFastest_radps = 1e3;
constexpr double kLargestVariance = 1e12;
constexpr double kDay_s = 86400;

bool finite(std::initializer_list<double> values) {
  for (const double v : values)
    if (!std::isfinite(v)) return false;
  return true;
}

bool within(double limit, std::initializer_list<double> values) {
  for (const double v : values)
    if (std::abs(v) > limit) return false;
  return true;
}

/// MRPT reads a flag as the byte it finds, and old or damaged logs hold others than 0 and 1, which no bool may be. Such
/// a flag was never set by anybody.
void settle(std::initializer_list<bool*> flags) {
  for (bool* flag : flags) {
    unsigned char byte = 0;
    std::memcpy(&byte, flag, 1);
    if (byte > 1) *flag = false;
  }
}

bool finitePose(const mrpt::poses::CPose3D& p) { return finite({p.x(), p.y(), p.z(), p.yaw(), p.pitch(), p.roll()}); }

std::string screenOdometry(mrpt::obs::CObservationOdometry& o) {
  settle({&o.hasVelocities, &o.hasEncodersInfo});
  const auto& p = o.odometry;
  const auto& v = o.velocityLocal;
  if (!finite({p.x(), p.y(), p.phi()})) return "not finite";
  if (o.hasVelocities && !finite({v.vx, v.vy, v.omega})) return "not finite";
  if (!within(kFarthest_m, {p.x(), p.y()})) return "absurd value";
  if (o.hasVelocities && !(within(kFastest_mps, {v.vx, v.vy}) && within(kFastest_radps, {v.omega})))
    return "absurd value";
  return "";
}

std::string screenImu(mrpt::obs::CObservationIMU& o) {
  for (bool& present : o.dataIsPresent) settle({&present});
  for (size_t i = 0; i < o.rawMeasurements.size(); ++i)
    if (o.dataIsPresent[i] && !std::isfinite(o.rawMeasurements[i])) return "not finite";
  for (const auto rate : {mrpt::obs::IMU_WX, mrpt::obs::IMU_WY, mrpt::obs::IMU_WZ})
    if (o.has(rate) && std::abs(o.get(rate)) > kFastest_radps) return "absurd value";
  for (const auto angle : {mrpt::obs::IMU_YAW, mrpt::obs::IMU_PITCH, mrpt::obs::IMU_ROLL})
    if (o.has(angle) && std::abs(o.get(angle)) > 1e6) return "absurd value";
  for (const auto acc : {mrpt::obs::IMU_X_ACC, mrpt::obs::IMU_Y_ACC, mrpt::obs::IMU_Z_ACC})
    if (o.has(acc) && std::abs(o.get(acc)) > 1e6) return "absurd value";
  return finitePose(o.sensorPose) ? "" : "not finite";
}

std::string screenPosition(double latitude_deg, double longitude_deg, double altitude_m) {
  if (!finite({latitude_deg, longitude_deg, altitude_m})) return "not finite";
  if (std::abs(latitude_deg) > 90 || std::abs(longitude_deg) > 360 || std::abs(altitude_m) > 1e6) return "absurd value";
  return "";
}

std::string screenGps(mrpt::obs::CObservationGPS& o) {
  using mrpt::obs::gnss::Message_NMEA_GGA;
  using mrpt::obs::gnss::Message_NMEA_RMC;
  if (!finitePose(o.sensorPose)) return "not finite";
  if (auto* gga = o.getMsgByClassPtr<Message_NMEA_GGA>()) {
    settle({&gga->fields.thereis_HDOP});
    if (gga->fields.fix_quality == 0) return "no fix";
    if (gga->fields.thereis_HDOP && !std::isfinite(gga->fields.HDOP)) return "not finite";
    return screenPosition(gga->fields.latitude_degrees, gga->fields.longitude_degrees, gga->fields.altitude_meters);
  }
  if (auto* rmc = o.getMsgByClassPtr<Message_NMEA_RMC>()) {
    if (rmc->fields.validity_char != 'A') return "no fix";
    return screenPosition(rmc->fields.latitude_degrees, rmc->fields.longitude_degrees, 0);
  }
  return "no fix";
}

bool isRange(double range) { return std::isfinite(range) && range > 0 && range < kFarthest_m; }

std::string screenBeacons(mrpt::obs::CObservationBeaconRanges& o, const Dropped& dropped) {
  const auto bad = [&](const auto& m) {
    const auto& at = m.sensorLocationOnRobot;
    const bool good = isRange(m.sensedDistance) && finite({at.x(), at.y(), at.z()});
    if (!good) dropped("no range");
    return !good;
  };
  if (o.sensedData.empty()) return "no range";
  if (!finite({o.stdError})) return "not finite";
  std::erase_if(o.sensedData, bad);
  return o.sensedData.empty() ? "only bad ranges" : "";
}

std::string screenLandmarks(mrpt::obs::CObservationBearingRange& o, const Dropped& dropped) {
  settle({&o.validCovariances});
  const auto bad = [&](const auto& m) {
    const bool good = isRange(m.range) && finite({m.yaw, m.pitch}) && within(1e3, {m.yaw, m.pitch}) &&
                      (!o.validCovariances || m.covariance.asEigen().allFinite());
    if (!good) dropped("no range");
    return !good;
  };
  if (!finitePose(o.sensorLocationOnRobot)) return "not finite";
  if (!finite({o.sensor_std_range, o.sensor_std_yaw, o.sensor_std_pitch})) return "not finite";
  const bool was_empty = o.sensedData.empty();  // seeing no landmark is a measurement too
  std::erase_if(o.sensedData, bad);
  return o.sensedData.empty() && !was_empty ? "only bad ranges" : "";
}

std::string screenScan(mrpt::obs::CObservation2DRangeScan& o) {
  settle({&o.rightToLeft});
  if (o.getScanSize() == 0) return "no beams";
  if (!finitePose(o.sensorPose) || !finite({o.aperture, o.maxRange, o.stdError})) return "not finite";
  if (o.aperture <= 0 || o.aperture > 7 || o.maxRange <= 0) return "absurd value";
  for (size_t i = 0; i < o.getScanSize(); ++i) {
    if (std::isfinite(o.getScanRange(i))) continue;
    o.setScanRange(i, 0);
    o.setScanRangeValidity(i, false);
  }
  return "";
}

std::string screenRgbd(mrpt::obs::CObservation3DRangeScan& o) {
  settle({&o.hasPoints3D, &o.hasRangeImage, &o.hasIntensityImage, &o.hasConfidenceImage, &o.range_is_depth});
  return finitePose(o.sensorPose) ? "" : "not finite";
}

std::string screenPose(const mrpt::obs::CObservationRobotPose& o) {
  const auto& p = o.pose.mean;
  if (!finitePose(p) || !finitePose(o.sensorPose)) return "not finite";
  if (!within(kFarthest_m, {p.x(), p.y(), p.z()})) return "absurd value";
  if (!o.pose.cov.asEigen().allFinite()) return "bad covariance";
  for (int i = 0; i < 6; ++i)
    if (o.pose.cov(i, i) < 0 || o.pose.cov(i, i) > kLargestVariance) return "bad covariance";
  return "";
}

}  // namespace

std::string screen(mrpt::obs::CObservation& observation, const Dropped& dropped) {
  auto* o = &observation;
  if (auto* odometry = dynamic_cast<mrpt::obs::CObservationOdometry*>(o)) return screenOdometry(*odometry);
  if (auto* imu = dynamic_cast<mrpt::obs::CObservationIMU*>(o)) return screenImu(*imu);
  if (auto* gps = dynamic_cast<mrpt::obs::CObservationGPS*>(o)) return screenGps(*gps);
  if (auto* beacons = dynamic_cast<mrpt::obs::CObservationBeaconRanges*>(o)) return screenBeacons(*beacons, dropped);
  if (auto* marks = dynamic_cast<mrpt::obs::CObservationBearingRange*>(o)) return screenLandmarks(*marks, dropped);
  if (auto* scan = dynamic_cast<mrpt::obs::CObservation2DRangeScan*>(o)) return screenScan(*scan);
  if (auto* pose = dynamic_cast<mrpt::obs::CObservationRobotPose*>(o)) return screenPose(*pose);
  if (auto* rgbd = dynamic_cast<mrpt::obs::CObservation3DRangeScan*>(o)) return screenRgbd(*rgbd);
  return "";
}

std::string screenStamp(double time_s, double now_s) {
  if (!std::isfinite(time_s) || time_s <= 0) return "no stamp";
  return time_s > now_s + kDay_s ? "future stamp" : "";
}

}  // namespace sidestep
