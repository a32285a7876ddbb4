// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/obs_frwds.h>

#include <memory>
#include <vector>

#include "core/params.h"

namespace sidestep {

/// How a laser's scans are read.
struct ScanParams {
  int beams = 60;
  double min_range_m = 0.05;
  double max_range_m = 80;
  double delay_s = 0;
  bool pose_from_log = true;
  double x_m = 0, y_m = 0, yaw = 0;  // else: T_base_laser

  void visit(ParamVisitor& v);
};

/// A few beams of a scan, spread evenly over those that hit something, in the plane of the base frame [m].
struct Scan {
  std::vector<float> x, y;         ///< where each beam ends
  float laser_x = 0, laser_y = 0;  ///< where all begin
  float max_range = 0;
  size_t size() const { return x.size(); }
};

/// @return null if no beam is usable
std::shared_ptr<const Scan> readScan(const ScanParams& params, const mrpt::obs::CObservation2DRangeScan& scan);

}  // namespace sidestep
