// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/obs_frwds.h>
#include <mrpt/topography/data_types.h>

#include <memory>
#include <optional>

#include "core/params.h"
#include "localization/sensors/sensor_model.h"

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

std::unique_ptr<SensorModel> makeGpsSensor(const GpsParams& params);

}  // namespace sidestep
