// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/study_figures.h"

#include <gtest/gtest.h>

#include <fstream>

#include "evaluation/study/study_report.h"
#include "support/temporary_folder.h"

namespace sidestep {
namespace {

Study studyIn(const support::TemporaryFolder& folder) {
  std::ofstream(folder / "study.yaml") << "kind: world\nruns: 1\nfigures: [min_clearance, time]\n"
                                          "scenarios: {a: {}}\nalgorithms: {stand: {robot: stand}}\n";
  return Study::read(folder / "study.yaml");
}

SummaryLine line(const std::string& metric, double mean) {
  SummaryLine out;
  out.scenario = std::string(1, 'a');
  out.algorithm_name = "stand";
  out.metric = metric;
  out.summary = {1, mean, 0, mean, mean};
  return out;
}

TEST(StudyFigures, OneThatFailsLeavesTheOthersAndTheReport) {
  const support::TemporaryFolder folder;
  const Study study = studyIn(folder);
  const std::vector<SummaryLine> lines = {line("min_clearance", -0.3), line("time", 5)};
  std::filesystem::create_directory(folder / "min_clearance.png");  // so that it cannot be written
  const auto figures = drawStudy(study, lines, {}, folder.path());
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_NE(figures[0].failure, "");
  EXPECT_EQ(figures[1].failure, "");
  EXPECT_TRUE(std::filesystem::is_regular_file(folder / figures[1].file));
  const std::string report = reportHtml(study, lines, {}, figures, folder.path(), {});
  EXPECT_NE(report.find("could not be drawn: "), std::string::npos);
  EXPECT_NE(report.find("data:image/png;base64,"), std::string::npos);
}

}  // namespace
}  // namespace sidestep
