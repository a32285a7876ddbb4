// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/params.h"

namespace sidestep {

/// Weights delta of the objective (2.33): cost = sum of weight * r^2.
///
/// Those of table 4.4 (time 1, nonholonomic 1000, clearance 50, velocity 2, acceleration 1) let a band run over its
/// limits by tens of percent; velocity and acceleration weigh more here, so that little is left to the retiming.
struct BandWeights {
  double time = 1;             ///< intervals [1/s^2]
  double nonholonomic = 1000;  ///< displacement across the heading [1/m^2]
  double velocity = 60;        ///< excess of speed [s^2/m^2]
  double acceleration = 60;    ///< excess of acceleration [s^4/m^2]
  double clearance = 50;       ///< missing distance to obstacles [1/m^2]
  double contact = 400;        ///< distance missing to the least allowed [1/m^2]
  double shortest_path = 0;    ///< way of an interval [1/m^2]
  double forward = 10;         ///< speed backwards [s^2/m^2]
  double via_points = 0.5;     ///< offset from the global path [1/m^2]

  void visit(ParamVisitor& v);
};

struct BandParams {
  double interval_s = 0.35;         ///< wished length of the intervals; poses are added and removed to keep it
  int poses_max = 150;              ///< of a band
  double distance_m = 0.5;          ///< wished clearance, edge to edge
  double distance_moving_m = 0.25;  ///< to what moves
  double distance_least_m = 0.07;   ///< least clearance that a band may have; nearer is a contact
  double limit_share = 0.99;        ///< of the limits that the optimizer keeps to; the rest is for what is left over
  int iterations_cold = 30;         ///< of Levenberg-Marquardt, for a band from scratch
  int iterations_warm = 8;          ///< for one from the last plan
  double tolerance = 1e-3;          ///< relative decrease of the cost below which the optimizer stops
  double damping = 1;               ///< first lambda of Levenberg-Marquardt, cold
  double damping_warm = 1e-3;       ///< and warm

  void visit(ParamVisitor& v);
};

}  // namespace sidestep
