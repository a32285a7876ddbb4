// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace sidestep {

/// A line of a study about cells of its matrix: `SCENARIO ALGORITHM METRIC[.STATISTIC] OPERATOR VALUE`, for example
/// `sinusoid-10hz enc+gps mean_error_m <= 0.22`. Scenario and algorithm may hold `*`; the statistic is a column of
/// summary.csv, `mean` if left out; the operator is one of <=, >=, <, >, and = for a reference.
struct StudyStatement {
  std::string text;  ///< as written
  std::string scenario, algorithm, metric, statistic = "mean", comparison;
  double value = 0;

  bool matches(const std::string& scenario_name, const std::string& algorithm_name) const;
  bool holds(double seen) const;  ///< false for NaN
};

/// @param where  what the line stands in, for the message
/// @throws ConfigError if it is not such a line.
StudyStatement parseStatement(const std::string& text, const std::string& where);

/// Statistics that a statement may name.
const std::vector<std::string>& statisticWords();

/// Whether `text` is what `pattern` says, where `*` stands for any characters.
bool matchesPattern(const std::string& pattern, const std::string& text);

}  // namespace sidestep
