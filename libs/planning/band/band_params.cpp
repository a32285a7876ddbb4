// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/band_params.h"

namespace sidestep {

void BandWeights::visit(ParamVisitor& v) {
  v.number("time", time, {1e-6, 1e6}, "1/s^2", "weight of the transition time");
  v.number("nonholonomic", nonholonomic, {0, 1e7}, "1/m^2", "weight of sliding sideways");
  v.number("velocity", velocity, {0, 1e6}, "s^2/m^2", "weight of speeds over the limits");
  v.number("acceleration", acceleration, {0, 1e6}, "s^4/m^2", "weight of accelerations over the limits");
  v.number("clearance", clearance, {0, 1e6}, "1/m^2", "weight of what is missing to distance_m");
  v.number("contact", contact, {0, 1e6}, "1/m^2", "weight of what is missing to distance_least_m");
  v.number("shortest_path", shortest_path, {0, 1e6}, "1/m^2", "weight of the way travelled");
  v.number("forward", forward, {0, 1e6}, "s^2/m^2", "weight of driving backwards");
  v.number("via_points", via_points, {0, 1e6}, "1/m^2", "weight of offsets from the global path");
}

void BandParams::visit(ParamVisitor& v) {
  v.number("interval_s", interval_s, {0.05, 2}, "s", "wished time between poses of a band");
  v.integer("poses_max", poses_max, {8, 1000}, "most poses of a band");
  v.number("distance_m", distance_m, {0, 10}, "m", "wished clearance to obstacles, edge to edge");
  v.number("distance_moving_m", distance_moving_m, {0, 10}, "m", "wished clearance to moving obstacles");
  v.number("distance_least_m", distance_least_m, {0, 10}, "m", "least clearance of a band, edge to edge");
  v.number("limit_share", limit_share, {0.5, 1}, "-", "share of the robot's limits that the optimizer keeps to");
  v.integer("iterations_cold", iterations_cold, {1, 10000}, "iterations for a band from scratch");
  v.integer("iterations_warm", iterations_warm, {1, 10000}, "iterations for a band of the last plan");
  v.number("tolerance", tolerance, {0, 1}, "-", "relative decrease of the cost below which the optimizer stops");
  v.number("damping", damping, {1e-12, 1e6}, "-", "first damping of Levenberg-Marquardt, cold");
  v.number("damping_warm", damping_warm, {1e-12, 1e6}, "-", "first damping of Levenberg-Marquardt, warm");
}

}  // namespace sidestep
