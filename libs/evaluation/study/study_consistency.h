// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "evaluation/study/study_summary.h"

namespace sidestep {

/// What the runs of one cell together say of a filter's noise: one of its errors (nees), or one sensor's (nis_KIND).
struct CellConsistency {
  std::string scenario, algorithm_name;
  std::string quantity;  ///< "nees", "nis_gps", ...: a mean by what a consistent filter has, which is 1
  size_t n = 0;
  double mean = 0, ci_low = 0, ci_high = 0;  ///< over the runs
  double share_in_band = 0;                  ///< runs whose own 95 % band holds 1; about 0.95 if consistent
  double sd_factor = 1;                      ///< sqrt(mean): real sd over the believed one
  std::string verdict;  ///< over-confident if ci_low > 1, too cautious if ci_high < 1, else consistent
};

/// For each metric NAME that has a NAME_in_band beside it. Runs are independent of each other, so that the interval
/// over them holds however correlated errors within a run are. Of fewer than 5 runs there is no verdict.
std::vector<CellConsistency> consistencyOf(const std::vector<SummaryLine>& lines);

/// The text of consistency.csv.
std::string consistencyCsv(const std::vector<CellConsistency>& cells);
/// A section of the report; empty if there is nothing to judge.
std::string consistencyHtml(const std::vector<CellConsistency>& cells);

}  // namespace sidestep
