// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <fstream>
#include <map>
#include <optional>
#include <string>

#include "evaluation/metrics/metrics_json.h"
#include "figures/consistency_figure.h"
#include "localization/localizer.h"

namespace sidestep {

/// lost.csv: the probability that an estimate is off by more than 1 m, from filters that can tell.
class LostFile {
 public:
  explicit LostFile(const std::string& file) : name_(file) {}
  void write(const Estimate& e);

 private:
  std::string name_;
  std::ofstream file_;
};

/// modes.csv: where the robot may be, a row a place, from filters that can hold several.
class ModesFile {
 public:
  explicit ModesFile(const std::string& file) : name_(file) {}
  void write(const Estimate& e);
  void into(LocalizationMetrics& metrics) const;

 private:
  std::string name_;
  std::ofstream file_;
  uint64_t looks_ = 0, several_ = 0, most_ = 0;
};

/// The innovations of a run, by label, for consistency.png.
class InnovationLog {
 public:
  void take(Localizer& localizer);
  /// @param gate_probability  of LocalizeConfig::gateProbability
  ConsistencyFigure figure(const LocalizationMetrics& metrics, double gate_probability) const;

 private:
  std::map<std::string, NisTrack> tracks_;
};

}  // namespace sidestep
