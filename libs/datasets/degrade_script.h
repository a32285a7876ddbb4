// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <map>
#include <string>
#include <vector>

#include "core/params.h"

namespace sidestep {

/// Something that goes wrong with the observations of one label, for a time or in a place.
struct DegradeEvent {
  std::string label;               ///< of the observations; a kind's word ("gps") means all of that kind; none for jump
  std::string action = "drop";     ///< drop, thin, delay, freeze, bias, spike, noise, jump
  std::string components = "all";  ///< all, xy, theta, rate
  double from_s = 0, to_s = 1e9;   ///< after the first stamp of the log; the end is not in it [s]
  std::string zone;                ///< only there; empty: everywhere
  double probability = 1;          ///< of each observation (drop, spike)
  int keep_every = 2;              ///< thin
  double delay_s = 0;              ///< delay
  double x_m = 0, y_m = 0, theta = 0, rate = 0;  ///< bias [m, m, rad, rad/s]
  double spike_m = 10, spike_theta = 1;          ///< size of a spike, whose direction is random [m, rad]
  double sd_m = 0, sd_theta = 0, sd_rate = 0;    ///< noise as it is [m, rad, rad/s] ...
  double noise_scale = 2;                        ///< ... and what it becomes, times that

  void visit(ParamVisitor& v);
};

/// A polygon in map coordinates [m], closed by itself.
struct Zone {
  std::vector<mrpt::math::TPoint2D> corners;
  bool contains(const mrpt::math::TPoint2D& p) const;
};

/// What is done to a log, event by event in the order of the file.
struct DegradeScript {
  int seed = 1;
  std::string pose_from = "auto";                      ///< of the robot, for zones: auto, truth, odometry
  double start_x_m = 0, start_y_m = 0, start_yaw = 0;  ///< T_map_odom, for zones by odometry [m, rad]
  std::vector<std::string> event_names, zone_names;
  std::map<std::string, DegradeEvent> events;
  std::map<std::string, Zone> zones;

  void visit(ParamVisitor& v);
  /// @throws ConfigError for an event without label, an unknown zone, a zone of fewer than three corners.
  void check() const;
};

}  // namespace sidestep
