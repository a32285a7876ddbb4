// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/params.h"
#include "localization/filters/filters.h"
#include "localization/localizer.h"
#include "maps/map_file.h"

namespace sidestep {

/// All that a YAML for sidestep-localize may hold: the robot, its sensors, its filter.
struct LocalizeConfig {
  std::string filter = "ekf";
  bool smooth = false;
  int seed = 1;
  std::vector<std::string> sensors;  // empty: whatever the log has of those that the configuration knows
  LocalizerParams robot;
  ParamSections filters = filterParams();
  std::string map;
  MapReadParams map_read;
  std::string align = "auto";
  double truth_x_m = 0, truth_y_m = 0, truth_yaw = 0;  // T_map_truth
  bool truth_frame_given = false;

  void visit(ParamVisitor& v);
  /// The row of the filter that is named. @throws ConfigError for a name that is none
  const FilterRow& row() const { return filterOf(filter); }
  /// Whether readings of that kind reach the filter, if there are any.
  bool uses(SensorKind kind) const;
  /// Those kinds, in the order of the table.
  std::vector<SensorKind> usedKinds() const;
  /// What the localizer is to be told.
  LocalizerSetup setup() const;
  /// Share of good measurements that the filter's gate lets in, 1 without a gate; nothing where there is no NIS to
  /// judge.
  std::optional<double> gateProbability() const;
  /// A true pose in the map's frame, as the configuration places the truth's.
  mrpt::math::TPose2D truthInMap(const mrpt::math::TPose2D& truth) const;
  /// @param where  what named the sensors, for the message
  /// @throws ConfigError for a sensor that is none, wheels without sizes, beacons that are used but not known.
  void check(const std::string& where) const;
};

/// The localizer that the configuration describes. @param seed  of what its filter draws
/// @throws DatasetError, ConfigError if its map cannot be read
Localizer makeLocalizer(const LocalizeConfig& config, uint64_t seed);

/// Whether measurements of that kind were used.
bool wasUsed(const std::vector<SensorUse>& sensors, SensorKind kind);

/// Every sensor that was asked for by name must have been of use.
/// @param log  for the message
/// @throws DatasetError (missing) naming the first that was not, and what was.
void requireSensors(const LocalizeConfig& config, const std::vector<SensorUse>& sensors, const std::string& log);

/// "odometry, gps": the labels that were used, or "nothing".
std::string usedLabels(const std::vector<SensorUse>& sensors);

}  // namespace sidestep
