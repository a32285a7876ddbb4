// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/obs_frwds.h>

namespace sidestep {

/// What an observation says of the plane, to be changed whatever its class.
struct PlanarReading {
  bool has_xy = false, has_theta = false, has_rate = false;
  double x = 0, y = 0;  ///< [m]; of GPS east and north of an origin that stays the same near it
  double theta = 0;     ///< [rad]
  double rate = 0;      ///< [rad/s]
  bool any() const { return has_xy || has_theta || has_rate; }
};

/// Reads odometry, IMU, GPS and poses; of other classes nothing is had.
PlanarReading readPlanar(const mrpt::obs::CObservation& observation);
/// Writes what is had; the rest stays. GPS: lengths of degrees are those of a sphere of the Earth's mean radius.
void writePlanar(const PlanarReading& reading, mrpt::obs::CObservation& observation);
/// Takes heading or yaw rate out of an IMU's reading. @return false if the class cannot be without.
bool removeTheta(mrpt::obs::CObservation& observation);
bool removeRate(mrpt::obs::CObservation& observation);

}  // namespace sidestep
