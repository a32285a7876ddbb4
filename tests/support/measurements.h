// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "localization/pose_filter.h"

/// What the tests of filters start from, are told, and look at.
namespace sidestep::support {

inline PoseBelief beliefOf(const mrpt::math::TPose2D& mean, double sd_xy, double sd_yaw) {
  PoseBelief b;
  b.mean = mean;
  b.covariance.diagonal() << sd_xy * sd_xy, sd_xy * sd_xy, sd_yaw * sd_yaw;
  return b;
}

inline Measurement fix(double time_s, double x, double y, double sd) {
  Measurement m;
  m.time_s = time_s;
  m.z << x, y, 0;
  m.R(0, 0) = m.R(1, 1) = sd * sd;
  return m;
}

inline Measurement heading(double time_s, double yaw, double sd, bool has_offset) {
  Measurement m;
  m.kind = Measurement::Kind::kHeading;
  m.time_s = time_s;
  m.z(0) = yaw;
  m.R(0, 0) = sd * sd;
  m.heading_has_offset = has_offset;
  return m;
}

inline MotionStep stepOf(double dt, double distance, double turn, double distance_sd = 0, double turn_sd = 0) {
  MotionStep s;
  s.dt_s = dt;
  s.distance_m = distance;
  s.turn_rad = turn;
  s.distance_var = distance_sd * distance_sd;
  s.turn_var = turn_sd * turn_sd;
  return s;
}

inline std::vector<double> saved(const PoseFilter& f) {
  std::vector<double> out;
  f.save(out);
  return out;
}

}  // namespace sidestep::support
