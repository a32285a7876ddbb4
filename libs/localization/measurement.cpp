// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/measurement.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>

namespace sidestep {
namespace {

/// Sensor position in the map and its derivative by yaw: the lever arm turns with the robot.
struct SensorPosition {
  double x, y, dx_dyaw, dy_dyaw;
};

SensorPosition sensorPosition(const Eigen::Vector3d& lever, const mrpt::math::TPose2D& pose) {
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  const double ox = c * lever.x() - s * lever.y(), oy = s * lever.x() + c * lever.y();
  return {pose.x + ox, pose.y + oy, -oy, ox};
}

void addPosition(const Measurement& m, const mrpt::math::TPose2D& pose, Innovation& out) {
  const auto p = sensorPosition(m.p_base_sensor, pose);
  out.nu(0) = m.z(0) - p.x;
  out.nu(1) = m.z(1) - p.y;
  out.H.row(0) << 1, 0, p.dx_dyaw;
  out.H.row(1) << 0, 1, p.dy_dyaw;
}

void addHeading(int row, const Measurement& m, const mrpt::math::TPose2D& pose, Innovation& out) {
  out.nu(row) = mrpt::math::wrapToPi(m.z(row) - pose.phi);
  out.H.row(row) << 0, 0, 1;
}

/// Range in space: the height between sensor and beacon is known, so the ground distance is seen foreshortened.
void addRange(const Measurement& m, const mrpt::math::TPose2D& pose, Innovation& out) {
  const auto p = sensorPosition(m.p_base_sensor, pose);
  const double dx = p.x - m.p_map_beacon.x(), dy = p.y - m.p_map_beacon.y();
  const double dz = m.p_base_sensor.z() - m.p_map_beacon.z();
  const double range = std::max(std::sqrt(dx * dx + dy * dy + dz * dz), 1e-6);
  out.nu(0) = m.z(0) - range;
  out.H.row(0) << dx / range, dy / range, (dx * p.dx_dyaw + dy * p.dy_dyaw) / range;
}

}  // namespace

Innovation innovation(const Measurement& m, const mrpt::math::TPose2D& pose) {
  Innovation out;
  switch (m.kind) {
    case Measurement::Kind::kPosition:
      addPosition(m, pose, out);
      break;
    case Measurement::Kind::kHeading:
      addHeading(0, m, pose, out);
      break;
    case Measurement::Kind::kPositionHeading:
      addPosition(m, pose, out);
      addHeading(2, m, pose, out);
      break;
    case Measurement::Kind::kRange:
      addRange(m, pose, out);
      break;
    case Measurement::Kind::kStill:
    case Measurement::Kind::kScan:
      break;
  }
  return out;
}

}  // namespace sidestep
