// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/params.h"
#include "core/reading.h"
#include "localization/ekf.h"
#include "localization/localizer.h"
#include "localization/mcl.h"
#include "localization/particle_filter.h"
#include "maps/map_file.h"

namespace sidestep {

/// All that a YAML for sidestep-localize may hold: the robot, its sensors, its filter.
struct LocalizeConfig {
  std::string filter = "ekf";
  bool smooth = false;
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
  /// Fixes tell where the robot starts; a filter with a map need not wait for them unless they are asked for by name.
  bool expectsFixes() const { return uses("gps") && (filter != "mcl" || !sensors.empty()); }
  /// What its sensors can tell of the start.
  Expectation expectation() const;
  /// Share of good measurements that the filter's gate lets in, 1 without a gate; nothing where there is no NIS to
  /// judge.
  std::optional<double> gateProbability() const;
  /// @param where  what named the sensors, for the message
  /// @throws ConfigError for a sensor that is none, wheels without sizes, beacons that are used but not known.
  void check(const std::string& where) const;
};

/// The filter that the configuration names. @param seed  of what it draws
std::unique_ptr<PoseFilter> makeFilter(const LocalizeConfig& config, uint64_t seed);

/// Carries observations of a log to the localizer's doors.
class LocalizationFeed {
 public:
  LocalizationFeed(const LocalizeConfig& config, Localizer& localizer) : config_(config), localizer_(localizer) {}
  /// Observations of sensors that are not used are left out.
  void feed(const Reading& e);
  /// Kinds by the labels that were fed.
  const std::map<std::string, SensorKind>& kinds() const { return kinds_; }

 private:
  int streamOf(const Reading& e);

  const LocalizeConfig& config_;
  Localizer& localizer_;
  std::map<std::string, int> streams_;
  std::map<std::string, SensorKind> kinds_;
};

/// "kind=label" words as a map. @throws ConfigError
std::map<std::string, std::string> labelMap(const std::vector<std::string>& words);

}  // namespace sidestep
