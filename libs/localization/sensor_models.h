// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/obs_frwds.h>
#include <mrpt/topography/data_types.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/params.h"
#include "localization/measurement.h"

namespace sidestep {

/// GPS as a position (3.10).
struct GpsParams {
  double sd_m = 3;
  double use_hdop = 0;
  double correlation_s = 0;
  double delay_s = 0;
  double lever_x_m = 0, lever_y_m = 0;
  bool lever_from_log = true;
  double datum_lat_deg = 0, datum_lon_deg = 0, datum_height_m = 0;
  bool datum_given = false;

  void visit(ParamVisitor& v);
};

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

/// Ranges to known beacons, the indoor stand-in for GPS.
struct BeaconParams {
  double sd_m = 0.2;
  double delay_s = 0;
  Table beacons;  // id, x, y, z

  void visit(ParamVisitor& v);
};

/// GPS fixes to a local frame: east-north-up at the datum, which is the first fix unless it is given.
class GpsModel {
 public:
  explicit GpsModel(const GpsParams& params);
  /// Nothing if the observation carries no fix.
  std::optional<Measurement> measurement(double time_s, const mrpt::obs::CObservationGPS& fix);
  /// The same for a position that is metric already (a pose observation that serves as GPS).
  Measurement measurement(double time_s, double x, double y);
  bool hasDatum() const { return datum_.has_value(); }

 private:
  Measurement make(double time_s, double x, double y, double hdop);
  GpsParams params_;
  std::optional<mrpt::topography::TGeodeticCoords> datum_;
  double last_time_s_ = 0;
};

/// What an IMU observation says about yaw, in the base frame (the sensor may be mounted in any way).
struct ImuReading {
  std::optional<double> heading_rad, yaw_rate;
};
ImuReading readImu(const ImuParams& params, const mrpt::obs::CObservationIMU& imu);
/// @param period_s  time since the last heading [s], 0 = unknown
Measurement headingMeasurement(const ImuParams& params, double time_s, double heading_rad, double period_s);

/// By how much to raise the variance of measurements whose errors stay alike for tau = `correlation_s`: to white noise
/// of the same spectral density as an exponentially correlated error, 2 tau / dt; never less than 1.
double raisedBy(double correlation_s, double period_s);

/// One measurement a range to a beacon that the parameters know.
std::vector<Measurement> beaconMeasurements(const BeaconParams& params, double time_s,
                                            const mrpt::obs::CObservationBeaconRanges& ranges);

}  // namespace sidestep
