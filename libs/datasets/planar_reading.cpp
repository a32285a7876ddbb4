// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/planar_reading.h"

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <cmath>
#include <optional>

namespace sidestep {
namespace {

using namespace mrpt::obs;

constexpr double kMetresPerDegree = 6371008.8 * M_PI / 180;

/// Where a fix is, by either of its messages [deg]. The fields are packed: nothing may refer to them.
struct Degrees {
  double latitude = 0, longitude = 0;
};

std::optional<Degrees> degreesOf(const CObservationGPS& gps) {
  if (gps.hasMsgClass<gnss::Message_NMEA_GGA>()) {
    const auto& fields = gps.getMsgByClass<gnss::Message_NMEA_GGA>().fields;
    return Degrees{fields.latitude_degrees, fields.longitude_degrees};
  }
  if (gps.hasMsgClass<gnss::Message_NMEA_RMC>()) {
    const auto& fields = gps.getMsgByClass<gnss::Message_NMEA_RMC>().fields;
    return Degrees{fields.latitude_degrees, fields.longitude_degrees};
  }
  return std::nullopt;
}

/// Moves each message of a fix.
void move(CObservationGPS& gps, const Degrees& by) {
  if (auto* gga = gps.getMsgByClassPtr<gnss::Message_NMEA_GGA>()) {
    gga->fields.latitude_degrees += by.latitude;
    gga->fields.longitude_degrees += by.longitude;
  }
  if (auto* rmc = gps.getMsgByClassPtr<gnss::Message_NMEA_RMC>()) {
    rmc->fields.latitude_degrees += by.latitude;
    rmc->fields.longitude_degrees += by.longitude;
  }
}

/// Longitudes are measured on one and the same parallel over some 100 km, so that x does not depend on y.
double parallel(double latitude) { return std::cos(std::round(latitude) * M_PI / 180); }

PlanarReading readGps(const CObservationGPS& gps) {
  PlanarReading out;
  const auto at = degreesOf(gps);
  if (!at) return out;
  out.has_xy = true;
  out.x = at->longitude * kMetresPerDegree * parallel(at->latitude);
  out.y = at->latitude * kMetresPerDegree;
  return out;
}

void writeGps(const PlanarReading& reading, CObservationGPS& gps) {
  const PlanarReading was = readGps(gps);
  if (!was.has_xy || !reading.has_xy) return;
  const double north = (reading.y - was.y) / kMetresPerDegree, east = (reading.x - was.x) / kMetresPerDegree;
  move(gps, {north, east / parallel(degreesOf(gps)->latitude)});
}

bool removeImu(CObservation& observation, TIMUDataIndex what) {
  auto* imu = dynamic_cast<CObservationIMU*>(&observation);
  if (imu) imu->dataIsPresent[what] = false;
  return imu != nullptr;
}

}  // namespace

PlanarReading readPlanar(const CObservation& observation) {
  PlanarReading out;
  if (const auto* gps = dynamic_cast<const CObservationGPS*>(&observation)) return readGps(*gps);
  if (const auto* imu = dynamic_cast<const CObservationIMU*>(&observation)) {
    out.has_theta = imu->has(IMU_YAW), out.has_rate = imu->has(IMU_WZ);
    if (out.has_theta) out.theta = imu->get(IMU_YAW);
    if (out.has_rate) out.rate = imu->get(IMU_WZ);
  } else if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation)) {
    const auto& p = odometry->odometry;
    out = {true, true, odometry->hasVelocities, p.x(), p.y(), p.phi(), odometry->velocityLocal.omega};
  } else if (const auto* pose = dynamic_cast<const CObservationRobotPose*>(&observation)) {
    const auto& p = pose->pose.mean;
    out = {true, true, false, p.x(), p.y(), p.yaw(), 0};
  }
  return out;
}

void writePlanar(const PlanarReading& reading, CObservation& observation) {
  if (auto* gps = dynamic_cast<CObservationGPS*>(&observation)) return writeGps(reading, *gps);
  if (auto* imu = dynamic_cast<CObservationIMU*>(&observation)) {
    if (reading.has_theta && imu->has(IMU_YAW)) imu->rawMeasurements[IMU_YAW] = reading.theta;
    if (reading.has_rate && imu->has(IMU_WZ)) imu->rawMeasurements[IMU_WZ] = reading.rate;
  } else if (auto* odometry = dynamic_cast<CObservationOdometry*>(&observation)) {
    odometry->odometry = mrpt::poses::CPose2D(reading.x, reading.y, reading.theta);
    if (odometry->hasVelocities) odometry->velocityLocal.omega = reading.rate;
  } else if (auto* pose = dynamic_cast<CObservationRobotPose*>(&observation)) {
    auto& p = pose->pose.mean;
    p = mrpt::poses::CPose3D(reading.x, reading.y, p.z(), reading.theta, p.pitch(), p.roll());
  }
}

bool removeTheta(CObservation& observation) { return removeImu(observation, IMU_YAW); }
bool removeRate(CObservation& observation) { return removeImu(observation, IMU_WZ); }

}  // namespace sidestep
