// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "datasets/log_reader.h"
#include "datasets/log_writer.h"
#include "datasets/object_archive.h"
#include "support/temporary_folder.h"

namespace sidestep::worlds {

constexpr double kStart_s = 1.6e9;

/// A folder of its own for one test, whose files go by their names as text.
class TemporaryFolder : public support::TemporaryFolder {
 public:
  std::string operator/(const std::string& name) const { return (path() / name).string(); }
};

template <class Observation>
Observation stamped(double t_s, const std::string& label) {
  Observation o;
  o.timestamp = mrpt::Clock::fromDouble(t_s);
  o.sensorLabel = label;
  return o;
}

inline mrpt::obs::CObservationOdometry odometry(double t_s, double x = 0, double v = 0) {
  auto o = stamped<mrpt::obs::CObservationOdometry>(t_s, "odometry");
  o.odometry = mrpt::poses::CPose2D(x, 0, 0);
  o.hasVelocities = true;
  o.velocityLocal = {v, 0, 0};
  return o;
}

inline mrpt::obs::CObservationIMU imu(double t_s, double yaw_rate = 0) {
  auto o = stamped<mrpt::obs::CObservationIMU>(t_s, "imu");
  o.dataIsPresent.fill(false);
  o.rawMeasurements.fill(0);
  o.set(mrpt::obs::IMU_WZ, yaw_rate);
  return o;
}

inline mrpt::obs::CObservationGPS gps(double t_s, double latitude_deg = 36.7, int quality = 1) {
  auto o = stamped<mrpt::obs::CObservationGPS>(t_s, "gps");
  mrpt::obs::gnss::Message_NMEA_GGA gga;
  gga.fields.latitude_degrees = latitude_deg;
  gga.fields.longitude_degrees = -4.4;
  gga.fields.altitude_meters = 10;
  gga.fields.fix_quality = static_cast<uint8_t>(quality);
  o.setMsg(gga);
  return o;
}

inline mrpt::obs::CObservationBeaconRanges beacons(double t_s, const std::vector<float>& ranges) {
  auto o = stamped<mrpt::obs::CObservationBeaconRanges>(t_s, "beacons");
  for (size_t i = 0; i < ranges.size(); ++i) {
    auto& m = o.sensedData.emplace_back();
    m.sensedDistance = ranges[i];
    m.beaconID = static_cast<int32_t>(i + 1);
  }
  return o;
}

inline mrpt::obs::CObservation2DRangeScan scan(double t_s, size_t beams = 20, float range = 2) {
  auto o = stamped<mrpt::obs::CObservation2DRangeScan>(t_s, "laser");
  o.resizeScan(beams);
  for (size_t i = 0; i < beams; ++i) {
    o.setScanRange(i, range);
    o.setScanRangeValidity(i, true);
  }
  return o;
}

inline mrpt::obs::CObservationRobotPose pose(double t_s, double variance = 0.01,
                                             const std::string& label = "ground_truth") {
  auto o = stamped<mrpt::obs::CObservationRobotPose>(t_s, label);
  for (int i = 0; i < 6; ++i) o.pose.cov(i, i) = variance;
  return o;
}

inline std::string contents(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void store(const std::string& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// A log of our own: one observation of each kind every 0.1 s.
inline void writeLog(const std::string& file, int steps = 20) {
  LogWriter log(file, "program: test\n");
  for (int i = 0; i < steps; ++i) {
    const double t = kStart_s + 0.1 * i;
    log.write(odometry(t, 0.1 * i, 1));
    log.write(imu(t + 0.01));
    log.write(gps(t + 0.02));
    log.write(scan(t + 0.03));
    log.write(pose(t + 0.04));
  }
  log.close();
}

/// Objects as bytes, one after the other: a plain log without our comments.
template <class... Objects>
std::string plainLog(const Objects&... objects) {
  return (bytesFromObject(objects) + ... + std::string());
}

struct ReadLog {
  std::vector<Reading> entries;
  LogEnd end;
  std::map<std::string, std::map<std::string, uint64_t>> refused;
};

inline ReadLog readLog(const std::string& file, const LogReaderOptions& options = {}) {
  LogReader reader(file, options);
  ReadLog out;
  while (auto entry = reader.next()) out.entries.push_back(std::move(*entry));
  out.end = reader.end();
  out.refused = reader.refused();
  return out;
}

}  // namespace sidestep::worlds
