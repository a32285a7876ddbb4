// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/param_sections.h"

namespace sidestep {

class GridMap;     // maps/grid_map.h
class PoseFilter;  // localization/pose_filter.h

/// What a filter is made from, besides its parameters.
struct FilterInputs {
  uint64_t seed = 1;              ///< of what it draws
  const GridMap* map = nullptr;   ///< for filters that need one
  bool start_is_unknown = false;  ///< the robot may be anywhere on the map
};

/// A filter as the table knows it.
struct FilterRow {
  const char* name;
  const char* about;            ///< one line, for lists and help
  const ParamSection* section;  ///< its parameters; filters may share one
  bool needs_map = false;
  bool can_smooth = false;
  bool odometry_only = false;  ///< uses no other sensor
  /// Share of good measurements that its gate lets in, 1 without a gate; null: it has no NIS to judge.
  std::optional<double> (*gate_probability)(const ParamSections&) = nullptr;
  /// How well the constant offset of an IMU's heading is known at the start, sd [rad].
  double (*heading_offset_sd)(const ParamSections&) = nullptr;
  /// Whether it weighs all that is measured at an instant as one number (EN of algorithm 3); null: never.
  bool (*joins_instants)(const ParamSections&) = nullptr;
  std::unique_ptr<PoseFilter> (*make)(const ParamSections&, const FilterInputs&) = nullptr;
};

/// The table of all filters. Adding one: a file with its parameters and the filter, a row in filters.cpp.
const std::vector<FilterRow>& filters();
std::vector<std::string> filterNames();
/// @throws ConfigError for a name that is none, with the nearest known one
const FilterRow& filterOf(const std::string& name);
/// "ekf, pf, ...": the names of those that have a trait.
std::string filtersWith(bool FilterRow::*trait);
/// Parameters of all filters.
ParamSections filterParams();

}  // namespace sidestep
