// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/metrics/consistency.h"
#include "evaluation/metrics/trajectory_error.h"

namespace sidestep {

/// What became of one sensor's measurements.
struct SensorCounts {
  uint64_t read = 0, used = 0;
  std::map<std::string, uint64_t> refused;  ///< by reason
  std::optional<double> mean_nis;           ///< consistent if close to nis_dof
  int nis_dof = 0;
  std::optional<Consistency> consistency;  ///< nothing for few measurements, or a filter without NIS
  double nis_independent = 0;              ///< effective sample size of the mean (SensorUse)
};

/// All that metrics.json says about a run.
struct LocalizationMetrics {
  double duration_s = 0;                               ///< of the log
  double wall_s = 0;                                   ///< of the computation
  double peak_memory_mb = 0;                           ///< [MiB], see peakMemoryMb()
  std::optional<TrajectoryErrors> estimate, odometry;  ///< nothing without truth
  std::map<std::string, SensorCounts> sensors;         ///< by label
  std::optional<uint64_t> most_modes;                  ///< places at once where the robot may have been (pf, mcl)
  std::optional<double> several_modes_share;           ///< share of the looks that saw more than one
  std::string truth_source;                            ///< empty without truth
  std::vector<std::string> warnings;
  bool partial = false;  ///< the run was interrupted
};

/// The text of metrics.json, keys in a fixed order; what is not finite or not known is null. Ends with a newline.
std::string metricsJson(const LocalizationMetrics& metrics);

/// @throws DatasetError if the text did not reach the disk.
void writeMetrics(const LocalizationMetrics& metrics, const std::string& file);

/// The table a program prints, and a line a sensor on its noise: rows odometry and estimate (those that are known); `-`
/// for what is not known.
std::string errorTable(const LocalizationMetrics& metrics);

/// Largest resident memory of this process so far [MiB].
double peakMemoryMb();

}  // namespace sidestep
