// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/sensors/scan.h"

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>
#include <cmath>

namespace sidestep {

void ScanParams::visit(ParamVisitor& v) {
  v.integer("beams", beams, {3, 2000}, "how many of a scan's beams are used");
  v.number("min_range_m", min_range_m, {0, 100}, "m", "shorter ranges are the robot itself");
  v.number("max_range_m", max_range_m, {0.1, 1000}, "m",
           "longer ranges are not used; nor are those at the laser's limit");
  v.number("delay_s", delay_s, {-10, 10}, "s", "how late scans are stamped");
  v.flag("pose_from_log", pose_from_log, "take the laser's place on the robot from the log");
  v.number("x_m", x_m, {-50, 50}, "m", "else: laser ahead of the base");
  v.number("y_m", y_m, {-50, 50}, "m", "else: laser left of the base");
  v.angle("yaw_deg", yaw, {-360, 360}, "else: its turn");
}

std::shared_ptr<const Scan> readScan(const ScanParams& params, const mrpt::obs::CObservation2DRangeScan& scan) {
  const size_t n = scan.getScanSize();
  const mrpt::poses::CPose3D T_base_laser =
      params.pose_from_log ? scan.sensorPose : mrpt::poses::CPose3D(params.x_m, params.y_m, 0, params.yaw, 0, 0);
  const double limit = std::min(params.max_range_m, 0.999 * static_cast<double>(scan.maxRange));
  std::vector<size_t> usable;
  usable.reserve(n);
  for (size_t i = 0; i < n; ++i) {
    const double r = static_cast<double>(scan.getScanRange(i));
    if (scan.getScanRangeValidity(i) && r > params.min_range_m && r < limit) usable.push_back(i);
  }
  if (usable.empty() || !std::isfinite(T_base_laser.x()) || !std::isfinite(T_base_laser.y())) return nullptr;
  auto out = std::make_shared<Scan>();
  out->laser_x = static_cast<float>(T_base_laser.x());
  out->laser_y = static_cast<float>(T_base_laser.y());
  out->max_range = static_cast<float>(limit);
  const double aperture = static_cast<double>(scan.aperture),
               first = scan.rightToLeft ? -0.5 * aperture : 0.5 * aperture;
  const double step = n > 1 ? (scan.rightToLeft ? 1 : -1) * aperture / static_cast<double>(n - 1) : 0;
  const size_t count = std::min(usable.size(), static_cast<size_t>(params.beams));
  for (size_t k = 0; k < count; ++k) {
    const size_t i = usable[(2 * k + 1) * usable.size() / (2 * count)];
    const double angle = first + step * static_cast<double>(i), r = static_cast<double>(scan.getScanRange(i));
    double x, y, z;
    T_base_laser.composePoint(r * std::cos(angle), r * std::sin(angle), 0, x, y, z);
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    out->x.push_back(static_cast<float>(x));
    out->y.push_back(static_cast<float>(y));
  }
  if (out->x.empty()) return nullptr;
  return out;
}

}  // namespace sidestep
