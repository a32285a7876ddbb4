// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/study_quantiles.h"

#include <gtest/gtest.h>

#include <fstream>

#include "evaluation/study/study_consistency.h"
#include "support/temporary_folder.h"

namespace sidestep {
namespace {

Study oneCell(const support::TemporaryFolder& folder, int runs) {
  const auto file = (folder.path() / "study.yaml").string();
  std::ofstream(file) << "runs: " << runs << "\nmedians: [recovery_s]\nscenarios: {a: {}}\nalgorithms: {b: {}}\n";
  return Study::read(file);
}

/// Runs whose values are all `run`, but for what is not finite.
std::vector<StudyRun> runsOf(const Study& study, size_t n) {
  std::vector<StudyRun> out;
  for (size_t run = 0; run < n; ++run)
    out.push_back({0, 0, run, "done", std::vector<double>(study.runner().metrics().size(), static_cast<double>(run))});
  return out;
}

TEST(StudyQuantiles, MedianIntervalIsBetweenOrderStatistics) {
  // n = 20: P(binomial(20, 1/2) < 6) = 0.0207 <= 0.025 < P(... < 7) = 0.0577: the 6th of each end, which are 5 and 14.
  const support::TemporaryFolder folder;
  const Study study = oneCell(folder, 20);
  const auto lines = quantilesOfRuns(study, runsOf(study, 20));
  ASSERT_EQ(lines.size(), study.runner().metrics().size());
  EXPECT_EQ(lines[0].n, 20u);
  EXPECT_EQ(lines[0].median_low, 5);
  EXPECT_EQ(lines[0].median_high, 14);
  EXPECT_DOUBLE_EQ(lines[0].at[3], 9.5);
  EXPECT_DOUBLE_EQ(lines[0].at[0], 0);
  EXPECT_DOUBLE_EQ(lines[0].at[6], 19);
  const auto medians = medianLines(study, lines);
  ASSERT_EQ(medians.size(), 1u);
  EXPECT_EQ(medians[0].metric, "recovery_s");
  EXPECT_EQ(medians[0].summary.mean, 9.5);
}

TEST(StudyQuantiles, WhatIsNotFiniteIsLeftOut) {
  const support::TemporaryFolder folder;
  const Study study = oneCell(folder, 3);
  auto runs = runsOf(study, 3);
  runs[2].values[0] = NAN;
  EXPECT_EQ(quantilesOfRuns(study, runs)[0].n, 2u);
}

SummaryLine lineOf(const std::string& metric, double mean, double low, double high) {
  SummaryLine l;
  l.scenario.assign(1, 's');
  l.algorithm_name.assign(1, 'a');
  l.metric = metric;
  l.summary = {20, mean, 0.1, low, high};
  return l;
}

TEST(StudyConsistency, TheVerdictIsByTheIntervalOverRuns) {
  const auto cells =
      consistencyOf({lineOf("nees", 9, 8, 10), lineOf("nees_in_band", 0.1, 0, 0.2), lineOf("nis_gps", 1.02, 0.97, 1.05),
                     lineOf("nis_gps_in_band", 0.95, 0.9, 1), lineOf("nis_imu", 0.5, 0.4, 0.6),
                     lineOf("nis_imu_in_band", 0, 0, 0), lineOf("mean_error_m", 1, 1, 1)});
  ASSERT_EQ(cells.size(), 3u);
  EXPECT_EQ(cells[0].verdict, "over-confident");
  EXPECT_DOUBLE_EQ(cells[0].sd_factor, 3);
  EXPECT_DOUBLE_EQ(cells[0].share_in_band, 0.1);
  EXPECT_EQ(cells[1].verdict, "consistent");
  EXPECT_EQ(cells[2].verdict, "too cautious");
}

}  // namespace
}  // namespace sidestep
