// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <string>
#include <vector>

#include "evaluation/study/study_summary.h"

namespace sidestep {

/// What a few runs far out cannot move: quantiles of one metric of one cell.
struct QuantileLine {
  size_t row = 0, algorithm = 0;
  std::string scenario, algorithm_name, metric;
  size_t n = 0;
  std::array<double, 7> at{};              ///< of kQuantiles; linear between the order statistics around (n - 1) q
  double median_low = 0, median_high = 0;  ///< 95 % interval of the median
};

constexpr std::array<double, 7> kQuantiles = {0, 0.05, 0.25, 0.5, 0.75, 0.95, 1};

/// The interval of the median is between two order statistics, whatever the distribution: the k-th from either end with
/// the largest k for which a binomial of n halves is under k with at most 2.5 % (David & Nagaraja 2003, 7.1). Of fewer
/// than 6 runs it is the whole range, and holds less.
std::vector<QuantileLine> quantilesOfRuns(const Study& study, const std::vector<StudyRun>& runs);

/// The text of quantiles.csv.
std::string quantilesCsv(const std::vector<QuantileLine>& lines);
/// Tables for the report, of the metrics in Study::medians; empty if there are none.
std::string quantilesHtml(const Study& study, const std::vector<QuantileLine>& lines);
/// As lines of a summary whose mean is the median, for figures; of the metrics in Study::medians.
std::vector<SummaryLine> medianLines(const Study& study, const std::vector<QuantileLine>& lines);

}  // namespace sidestep
