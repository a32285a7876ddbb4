// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/sensors/imu.h"

#include <mrpt/math/wrap2pi.h>
#include <mrpt/obs/CObservationIMU.h>

#include <cmath>

#include "localization/sensors/covariance_inflation.h"

namespace sidestep {
namespace {

class ImuSensor final : public SensorModel {
 public:
  explicit ImuSensor(const ImuParams& params) : params_(params) {}
  void interpret(const Reading& r, SensorSays& out) override {
    const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(r.observation.get());
    const ImuReading said = imu ? readImu(params_, *imu) : ImuReading{};
    if (!said.heading_rad && !said.yaw_rate) {
      out.refused = "no_yaw";
      return;
    }
    out.yaw_rate = said.yaw_rate;
    if (!said.heading_rad) return;
    const double period_s = last_heading_s_ > 0 ? r.time_s - last_heading_s_ : 0;
    out.measurements.push_back(headingMeasurement(params_, r.time_s, *said.heading_rad, period_s));
    last_heading_s_ = r.time_s;
  }

 private:
  ImuParams params_;
  double last_heading_s_ = 0;
};

}  // namespace

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
  m.covariance_inflation = covarianceInflation(params.heading_correlation_s, period_s);
  m.R(0, 0) = m.covariance_inflation * params.heading_sd * params.heading_sd;
  m.heading_has_offset = true;
  return m;
}

std::unique_ptr<SensorModel> makeImuSensor(const ImuParams& params) { return std::make_unique<ImuSensor>(params); }

}  // namespace sidestep
