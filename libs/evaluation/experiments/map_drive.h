// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "evaluation/experiments/drive.h"
#include "maps/grid_map.h"
#include "simulation/laser.h"
#include "simulation/sensor_errors.h"

namespace sidestep {

/// A robot that drives about on a map, from one place drawn at random to the next, with wheels and a laser.
struct MapDriveParams {
  double duration_s = 120;
  double v = 0.5, w = 0.8;   ///< m/s straight on; rad/s on the spot, between straight pieces
  double clearance_m = 0.4;  ///< of its paths
  int clutter = 0;           ///< round things that the map does not know, anywhere in its free space
  double clutter_radius_m = 0.25;
  EncoderParams encoders;
  LaserParams laser;

  MapDriveParams();
  void visit(ParamVisitor& v);
};

/// One such drive as if it had been recorded: odometry and truth at 10 Hz, scans as often as the laser gives them.
/// @throws ConfigError if the map has no room for the robot.
RecordedDrive driveOnMap(const GridMap& map, const MapDriveParams& params, uint64_t seed);

}  // namespace sidestep
