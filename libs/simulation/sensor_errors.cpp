// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/sensor_errors.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>

#include "core/kinematics.h"

namespace sidestep {

void EncoderParams::visit(ParamVisitor& v) {
  v.number("v_sd", v_sd, {0, 10}, "m/s", "white noise of v in each step, sqrt of Q's first entry (3.16)");
  v.number("w_sd", w_sd, {0, 10}, "rad/s", "white noise of w in each step, sqrt of Q's second entry (3.16)");
  v.number("track_m", track_m, {0.01, 10}, "m", "distance between the wheels, as the robot thinks");
  v.number("track_scale", track_scale, {0.5, 2}, "", "true track by that");
  v.number("left_scale", left_scale, {0.5, 2}, "", "true size of the left wheel by what the robot thinks");
  v.number("right_scale", right_scale, {0.5, 2}, "", "true size of the right wheel by what the robot thinks");
  v.number("tick_m", tick_m, {0, 1}, "m", "way of a wheel in one tick; 0: not counted");
  v.number("slip_mean", slip_mean, {-0.9, 10}, "", "mean slip of each wheel: share that it turns more than it rolls");
  v.number("slip_sd", slip_sd, {0, 1}, "", "sd of each wheel's slip about that");
  v.number("slip_correlation_s", slip_correlation_s, {0, 3600}, "s", "time over which slip stays alike");
}

EncoderModel::EncoderModel(const EncoderParams& params, Random random)
    : params_(params),
      random_(random),
      left_slip_(params.slip_sd, params.slip_correlation_s),
      right_slip_(params.slip_sd, params.slip_correlation_s) {}

double EncoderModel::wheel(double way_m, double scale, CorrelatedError& slip, double dt_s) {
  return way_m / scale * (1 + params_.slip_mean + slip.step(dt_s, random_));
}

EncoderModel::Reading EncoderModel::step(double dt_s, double distance_m, double turn_rad) {
  const double distance = distance_m + params_.v_sd * random_.gaussian() * dt_s;
  const double turn = turn_rad + params_.w_sd * random_.gaussian() * dt_s;
  const WheelMotion rims = wheelsOf({distance, turn}, params_.track_m * params_.track_scale);
  double left = wheel(rims.left, params_.left_scale, left_slip_, dt_s);
  double right = wheel(rims.right, params_.right_scale, right_slip_, dt_s);
  if (params_.tick_m > 0) {
    left_way_ += left, right_way_ += right;
    const auto left_ticks = static_cast<int64_t>(std::floor(left_way_ / params_.tick_m));
    const auto right_ticks = static_cast<int64_t>(std::floor(right_way_ / params_.tick_m));
    left = static_cast<double>(left_ticks - left_ticks_) * params_.tick_m;
    right = static_cast<double>(right_ticks - right_ticks_) * params_.tick_m;
    left_ticks_ = left_ticks, right_ticks_ = right_ticks;
  }
  const BodyMotion read = bodyOf({left, right}, params_.track_m);
  return {read.ahead, read.turn, left_ticks_, right_ticks_};
}

void ImuErrorParams::visit(ParamVisitor& v) {
  v.number("rate_hz", rate_hz, {0, 10000}, "Hz", "readings a second; 0: no IMU");
  v.number("heading_sd", heading_sd, {0, 3}, "rad", "white noise of the heading, sqrt of R_theta (3.17)");
  v.angle("heading_offset_deg", heading_offset, {-360, 360}, "constant error of the heading");
  v.angle("heading_drift_deg", heading_drift, {-10, 10}, "growth of the heading's error a second");
  v.number("heading_correlated_sd", heading_correlated_sd, {0, 3}, "rad", "sd of an error that stays alike");
  v.number("heading_correlation_s", heading_correlation_s, {0, 3600}, "s", "for this long");
  v.number("gyro_sd", gyro_sd, {0, 10}, "rad/s", "white noise of one reading of the yaw rate");
  v.number("gyro_bias", gyro_bias, {-1, 1}, "rad/s", "constant error of the yaw rate");
  v.number("gyro_bias_walk", gyro_bias_walk, {0, 1}, "rad/s/sqrt(s)", "how that error walks");
  v.number("gyro_scale", gyro_scale, {0.5, 2}, "", "yaw rate read by the true one");
}

ImuModel::ImuModel(const ImuErrorParams& params, Random random)
    : params_(params),
      random_(random),
      clock_(params.rate_hz),
      heading_error_(params.heading_correlated_sd, params.heading_correlation_s),
      bias_(params.gyro_bias) {}

ImuModel::Reading ImuModel::read(double time_s, double yaw, double yaw_rate) {
  const double dt = time_s - last_s_;
  last_s_ = time_s;
  bias_ += params_.gyro_bias_walk * std::sqrt(dt) * random_.gaussian();
  Reading out;
  out.yaw = yaw + params_.heading_offset + params_.heading_drift * time_s + params_.heading_sd * random_.gaussian() +
            heading_error_.step(dt, random_);
  out.yaw = mrpt::math::wrapToPi(out.yaw);
  out.yaw_rate = yaw_rate * params_.gyro_scale + bias_ + params_.gyro_sd * random_.gaussian();
  return out;
}

void GpsErrorParams::visit(ParamVisitor& v) {
  v.number("rate_hz", rate_hz, {0, 10000}, "Hz", "fixes a second; 0: no GPS");
  v.number("sd_m", sd_m, {0, 1000}, "m", "white noise of x and of y (3.17)");
  v.number("correlated_sd_m", correlated_sd_m, {0, 1000}, "m", "sd of an error that stays alike");
  v.number("correlation_s", correlation_s, {0, 36000}, "s", "for this long");
  v.choice("output", output, {"latlon", "xy"},
           "what is written: GGA messages, or CObservationRobotPose with label gps (--label gps=gps)");
  v.number("datum_lat_deg", datum_lat_deg, {-89, 89}, "deg", "where the map's origin lies on Earth");
  v.number("datum_lon_deg", datum_lon_deg, {-180, 180}, "deg", "where the map's origin lies on Earth");
  v.number("datum_height_m", datum_height_m, {-1000, 10000}, "m", "where the map's origin lies on Earth");
  v.table("outages", {"from", "to"}, outages, "stretches without fixes [s]");
}

GpsErrorModel::GpsErrorModel(const GpsErrorParams& params, Random random)
    : params_(&params),
      random_(random),
      clock_(params.rate_hz),
      x_error_(params.correlated_sd_m, params.correlation_s),
      y_error_(params.correlated_sd_m, params.correlation_s) {}

bool GpsErrorModel::inOutage(double time_s) const {
  for (const auto& row : params_->outages)
    if (time_s >= row[0] && time_s < row[1]) return true;
  return false;
}

GpsErrorModel::Reading GpsErrorModel::read(double time_s, double x, double y) {
  const double dt = time_s - last_s_;
  last_s_ = time_s;
  Reading out;
  out.x = x + params_->sd_m * random_.gaussian() + x_error_.step(dt, random_);
  out.y = y + params_->sd_m * random_.gaussian() + y_error_.step(dt, random_);
  return out;
}

}  // namespace sidestep
