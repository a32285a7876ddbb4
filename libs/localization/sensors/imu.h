// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/obs_frwds.h>

#include <memory>
#include <optional>
#include <string>

#include "core/params.h"
#include "localization/sensors/sensor_model.h"

namespace sidestep {

/// An IMU as a heading (3.12) and as a turn rate.
struct ImuParams {
  std::string heading = "auto";
  std::string yaw_rate = "auto";
  double heading_sd = 0.0873;  // rad
  double heading_correlation_s = 0;
  double heading_offset = 0;   // rad
  double yaw_rate_bias = 0;    // rad/s
  double yaw_rate_sd = 0.003;  // rad/s, of a 1 s average
  double yaw_rate_scale = 1;
  double delay_s = 0;
  double max_yaw_rate_period_s = 0.2;

  void visit(ParamVisitor& v);
};

/// What an IMU observation says about yaw, in the base frame (the sensor may be mounted in any way).
struct ImuReading {
  std::optional<double> heading_rad, yaw_rate;
};
ImuReading readImu(const ImuParams& params, const mrpt::obs::CObservationIMU& imu);
/// @param period_s  time since the last heading [s], 0 = unknown
Measurement headingMeasurement(const ImuParams& params, double time_s, double heading_rad, double period_s);

std::unique_ptr<SensorModel> makeImuSensor(const ImuParams& params);

}  // namespace sidestep
