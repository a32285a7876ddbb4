// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/params.h"
#include "localization/ekf.h"
#include "localization/localizer.h"
#include "localization/mcl.h"
#include "localization/particle_filter.h"
#include "maps/map_file.h"

namespace sidestep {

/// All that a YAML for sidestep-localize may hold: the robot, its sensors, its filter.
struct LocalizeConfig {
  std::string filter = "ekf";
  int seed = 1;
  std::vector<std::string> sensors;  // empty: whatever the log has of odometry, imu, gps, and beacons if known
  LocalizerParams robot;
  EkfParams ekf;
  PfParams pf;
  MclParams mcl;
  std::string map;
  MapReadParams map_read;
  std::string align = "auto";
  double truth_x_m = 0, truth_y_m = 0, truth_yaw = 0;  // T_map_truth
  bool truth_frame_given = false;

  void visit(ParamVisitor& v);
  bool uses(const std::string& sensor) const;
};

/// What is asked for on the command line.
struct LocalizeOptions {
  std::string log, config_file, output = "sidestep-localize-out", ground_truth, initial_pose;
  std::string filter, sensors, align, map;
  std::vector<std::string> labels;
  double from_s = 0, to_s = 1e18;
  bool overwrite = false, quiet = false, write_config = false, no_picture = false;
  std::optional<int> seed;
};

/// The file's parameters with the command line's on top.
/// @throws ConfigError for anything that is not known or does not fit.
LocalizeConfig effectiveConfig(const LocalizeOptions& options);

/// "kind=label" words as a map.
std::map<std::string, std::string> labelMap(const std::vector<std::string>& words);

}  // namespace sidestep
