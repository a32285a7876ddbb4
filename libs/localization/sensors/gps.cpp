// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/sensors/gps.h"

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/topography/conversions.h>

#include <cmath>

#include "localization/sensors/covariance_inflation.h"

namespace sidestep {
namespace {

/// Fixes of a receiver, or poses that serve as fixes.
class GpsSensor final : public SensorModel {
 public:
  explicit GpsSensor(const GpsParams& params) : model_(params) {}
  void interpret(const Reading& r, SensorSays& out) override {
    std::optional<Measurement> m;
    if (const auto* gps = dynamic_cast<const mrpt::obs::CObservationGPS*>(r.observation.get()))
      m = model_.measurement(r.time_s, *gps);
    else if (const auto* pose = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(r.observation.get()))
      m = model_.measurement(r.time_s, pose->pose.mean.x(), pose->pose.mean.y());
    if (m)
      out.measurements.push_back(*m);
    else
      out.refused = "no_fix";
  }

 private:
  GpsModel model_;
};

}  // namespace

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
  m.covariance_inflation = covarianceInflation(params_.correlation_s, last_time_s_ > 0 ? time_s - last_time_s_ : 0);
  last_time_s_ = time_s;
  m.R(0, 0) = m.R(1, 1) = m.covariance_inflation * sd * sd;
  return m;
}

std::unique_ptr<SensorModel> makeGpsSensor(const GpsParams& params) { return std::make_unique<GpsSensor>(params); }

}  // namespace sidestep
