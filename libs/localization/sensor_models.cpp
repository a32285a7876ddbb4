// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/sensor_models.h"

#include <mrpt/math/wrap2pi.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/topography/conversions.h>

#include <cmath>

namespace sidestep {

void GpsParams::visit(ParamVisitor& v) {
  v.number("sd_m", sd_m, {0.001, 1000}, "m", "sd of a fix in each of x and y (3.17)");
  v.number("use_hdop", use_hdop, {0, 100}, "m", "if above 0, sd is this times the fix's HDOP, where it has one");
  v.number(
      "correlation_s", correlation_s, {0, 3600}, "s",
      "time over which errors of fixes stay alike; their noise is raised so that repeated fixes do not count twice");
  v.number("delay_s", delay_s, {-10, 10}, "s", "how late fixes are stamped; they are put back where they belong");
  v.flag("lever_from_log", lever_from_log, "take the antenna's place on the robot from the log");
  v.number("lever_x_m", lever_x_m, {-50, 50}, "m", "else: antenna ahead of the base");
  v.number("lever_y_m", lever_y_m, {-50, 50}, "m", "else: antenna left of the base");
  v.flag("datum_given", datum_given, "the local frame's origin is the datum below, not the first fix");
  v.number("datum_lat_deg", datum_lat_deg, {-90, 90}, "deg", "datum, latitude");
  v.number("datum_lon_deg", datum_lon_deg, {-180, 180}, "deg", "datum, longitude");
  v.number("datum_height_m", datum_height_m, {-1000, 10000}, "m", "datum, height");
}

void ImuParams::visit(ParamVisitor& v) {
  v.choice("heading", heading, {"auto", "on", "off"},
           "use the IMU's yaw as heading (3.12); auto: where the log has it");
  v.choice("yaw_rate", yaw_rate, {"auto", "on", "off"},
           "let the gyro tell the turns instead of the wheels; auto: if sampled often enough");
  v.angle("heading_sd_deg", heading_sd, {0.01, 180}, "sd of the heading (3.17)");
  v.number("heading_correlation_s", heading_correlation_s, {0, 3600}, "s",
           "time over which errors of the heading stay alike (magnetic surroundings); see gps.correlation_s");
  v.angle("heading_offset_deg", heading_offset, {-360, 360}, "subtracted from the IMU's yaw (mounting, declination)");
  v.angle("yaw_rate_bias_deg", yaw_rate_bias, {-90, 90}, "subtracted from the yaw rate (deg/s)");
  v.angle("yaw_rate_sd_deg", yaw_rate_sd, {0.0001, 90}, "sd of a one-second average of the yaw rate (deg/s)");
  v.number("yaw_rate_scale", yaw_rate_scale, {0.5, 2}, "", "true yaw rate by the gyro's");
  v.number("delay_s", delay_s, {-10, 10}, "s", "how late the IMU is stamped");
  v.number("max_yaw_rate_period_s", max_yaw_rate_period_s, {0.0001, 100}, "s",
           "a gyro sampled more rarely than this is not integrated");
}

void BeaconParams::visit(ParamVisitor& v) {
  v.number("sd_m", sd_m, {0.001, 100}, "m", "sd of a range");
  v.number("delay_s", delay_s, {-10, 10}, "s", "how late ranges are stamped");
  v.table("beacons", {"id", "x", "y", "z"}, beacons, "where the beacons are, in the map [m]");
}

GpsModel::GpsModel(const GpsParams& params) : params_(params) {
  if (params.datum_given)
    datum_ = mrpt::topography::TGeodeticCoords(params.datum_lat_deg, params.datum_lon_deg, params.datum_height_m);
}

std::optional<Measurement> GpsModel::measurement(double time_s, const mrpt::obs::CObservationGPS& fix) {
  using mrpt::obs::gnss::Message_NMEA_GGA;
  using mrpt::obs::gnss::Message_NMEA_RMC;
  mrpt::topography::TGeodeticCoords at;
  double hdop = 0;
  if (fix.hasMsgClass<Message_NMEA_GGA>()) {
    const auto& gga = fix.getMsgByClass<Message_NMEA_GGA>();
    at = gga.getAsStruct<mrpt::topography::TGeodeticCoords>();
    if (gga.fields.thereis_HDOP) hdop = static_cast<double>(gga.fields.HDOP);
  } else if (fix.hasMsgClass<Message_NMEA_RMC>()) {
    const auto& rmc = fix.getMsgByClass<Message_NMEA_RMC>().fields;
    at = mrpt::topography::TGeodeticCoords(rmc.latitude_degrees, rmc.longitude_degrees, 0);
  } else {
    return std::nullopt;
  }
  if (!std::isfinite(at.lat.decimal_value) || !std::isfinite(at.lon.decimal_value)) return std::nullopt;
  if (!datum_) datum_ = at;
  at.height = datum_->height;  // the plane's own height: a fix's height error must not tilt into x and y
  mrpt::math::TPoint3D enu;
  mrpt::topography::geodeticToENU_WGS84(at, enu, *datum_);
  Measurement m = make(time_s, enu.x, enu.y, hdop);
  if (params_.lever_from_log) m.p_base_sensor << fix.sensorPose.x(), fix.sensorPose.y(), 0;
  return m;
}

Measurement GpsModel::measurement(double time_s, double x, double y) { return make(time_s, x, y, 0); }

Measurement GpsModel::make(double time_s, double x, double y, double hdop) {
  Measurement m;
  m.kind = Measurement::Kind::kPosition;
  m.time_s = time_s - params_.delay_s;
  m.z << x, y, 0;
  m.p_base_sensor << params_.lever_x_m, params_.lever_y_m, 0;
  const double sd = params_.use_hdop > 0 && hdop > 0 ? params_.use_hdop * hdop : params_.sd_m;
  m.raised = raisedBy(params_.correlation_s, last_time_s_ > 0 ? time_s - last_time_s_ : 0);
  last_time_s_ = time_s;
  m.R(0, 0) = m.R(1, 1) = m.raised * sd * sd;
  return m;
}

double raisedBy(double correlation_s, double period_s) {
  if (!(period_s > 0)) return 1;
  return std::max(1.0, 2 * correlation_s / std::max(period_s, 1e-3));
}

ImuReading readImu(const ImuParams& params, const mrpt::obs::CObservationIMU& imu) {
  using namespace mrpt::obs;
  ImuReading out;
  const auto R_base_imu = imu.sensorPose.getRotationMatrix();
  if (imu.has(IMU_YAW) && params.heading != "off") {
    const double pitch = imu.has(IMU_PITCH) ? imu.get(IMU_PITCH) : 0, roll = imu.has(IMU_ROLL) ? imu.get(IMU_ROLL) : 0;
    const mrpt::poses::CPose3D T_world_imu(0, 0, 0, imu.get(IMU_YAW), pitch, roll);
    // First column of R_world_base = R_world_imu * R_base_imu^T: where the base's x axis points.
    const auto R = T_world_imu.getRotationMatrix();
    double x = 0, y = 0;
    for (int k = 0; k < 3; ++k) {
      x += R(0, k) * R_base_imu(0, k);
      y += R(1, k) * R_base_imu(0, k);
    }
    out.heading_rad = mrpt::math::wrapToPi(std::atan2(y, x) - params.heading_offset);
  }
  if (imu.has(IMU_WZ) && params.yaw_rate != "off") {
    const double wx = imu.has(IMU_WX) ? imu.get(IMU_WX) : 0, wy = imu.has(IMU_WY) ? imu.get(IMU_WY) : 0;
    const double rate = R_base_imu(2, 0) * wx + R_base_imu(2, 1) * wy + R_base_imu(2, 2) * imu.get(IMU_WZ);
    out.yaw_rate = params.yaw_rate_scale * (rate - params.yaw_rate_bias);
  }
  return out;
}

Measurement headingMeasurement(const ImuParams& params, double time_s, double heading_rad, double period_s) {
  Measurement m;
  m.kind = Measurement::Kind::kHeading;
  m.time_s = time_s - params.delay_s;
  m.z(0) = heading_rad;
  m.raised = raisedBy(params.heading_correlation_s, period_s);
  m.R(0, 0) = m.raised * params.heading_sd * params.heading_sd;
  m.heading_has_offset = true;
  return m;
}

std::vector<Measurement> beaconMeasurements(const BeaconParams& params, double time_s,
                                            const mrpt::obs::CObservationBeaconRanges& ranges) {
  std::vector<Measurement> out;
  for (const auto& range : ranges.sensedData) {
    for (const auto& beacon : params.beacons) {
      if (static_cast<int>(beacon[0]) != range.beaconID) continue;
      Measurement m;
      m.kind = Measurement::Kind::kRange;
      m.time_s = time_s - params.delay_s;
      m.z(0) = static_cast<double>(range.sensedDistance);
      m.R(0, 0) = params.sd_m * params.sd_m;
      const auto& p = range.sensorLocationOnRobot;
      m.p_base_sensor << p.x(), p.y(), p.z();
      m.p_map_beacon << beacon[1], beacon[2], beacon[3];
      out.push_back(m);
    }
  }
  return out;
}

}  // namespace sidestep
