// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "evaluation/study/statistics.h"
#include "evaluation/study/study_runs.h"

namespace sidestep {

/// One line of summary.csv.
struct SummaryLine {
  size_t row = 0, algorithm = 0;
  std::string scenario, algorithm_name, metric;
  SampleSummary summary;
  std::optional<double> reference;   ///< the published number
  std::string baseline;              ///< empty for the baseline itself, or if there is none
  std::optional<double> difference;  ///< mean of (this - baseline) over the runs that both have
  std::optional<double> p_value;     ///< of that difference, see signFlipPValue

  /// A column by its name; NaN where there is nothing.
  double statistic(const std::string& word) const;
};

/// An expectation and what became of it.
struct ExpectationResult {
  std::string text;
  std::string seen;  ///< "sinusoid enc+gps mean_error_m = 0.21", or the first cell that missed it
  bool met = true;
};

/// All metrics of all cells, in the order of the matrix. Random numbers are the study's, by the names of the cell.
std::vector<SummaryLine> summarizeRuns(const Study& study, const std::vector<StudyRun>& runs);

/// The text of summary.csv: scenario,algorithm,metric,n,mean,sd,ci_low,ci_high,reference,baseline,difference,p_value;
/// a cell is empty where there is nothing to say.
std::string summaryCsv(const std::vector<SummaryLine>& lines);

/// Each expectation holds if it holds for every cell that it matches.
std::vector<ExpectationResult> checkExpectations(const Study& study, const std::vector<SummaryLine>& lines);

/// A table for the terminal: a line a cell, the dissertation's numbers beside ours.
std::string summaryTable(const Study& study, const std::vector<SummaryLine>& lines);

}  // namespace sidestep
