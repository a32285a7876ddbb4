// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// sidestep-evaluate, run as a user runs it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace sidestep::testing {
namespace {

const char* const kStudy =
    "kind: localization\n"
    "title: \"A <small> study\"\n"
    "runs: 4\n"
    "baseline: enc\n"
    "metrics: [mean_error_m]\n"
    "figures: [mean_error_m]\n"
    "medians: [mean_error_m]\n"
    "pictures: [enc+gps]\n"
    "scenarios:\n"
    "  short:\n"
    "    set: {trajectory: {duration_s: 3}}\n"
    "  roof:\n"
    "    set: {trajectory: {duration_s: 6}}\n"
    "    axis: outage_s\n"
    "    x: [1, 2]\n"
    "    outage: {loses: xy, settle_s: 1, recover_s: 1}\n"
    "algorithms:\n"
    "  enc: {set: {filter: odometry}}\n"
    "  enc+gps: {set: {sensors: [odometry, gps]}}\n"
    "  cloud: {set: {filter: pf, pf: {particles: 50}}}\n"
    "references: [short enc+gps mean_error_m = 0.5]\n"
    "expect: [\"* enc+gps mean_error_m <= 100\"]\n";

/// A study in a folder of its own.
struct StudyFolder {
  TemporaryFolder folder;
  explicit StudyFolder(const std::string& text = kStudy) { writeFile(folder / "study.yaml", text); }
  ProgramResult run(const std::string& options) const {
    return runShell("sidestep-evaluate study.yaml " + options, folder.path());
  }
  std::string file(const std::string& name) const { return readFile(folder.path() / name); }
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Evaluate, LeavesRunsSummaryReportAndFigures) {
  const StudyFolder s;
  const auto run = s.run("-o out");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const auto runs = linesOf(s.file("out/runs.csv")), summary = linesOf(s.file("out/summary.csv"));
  EXPECT_EQ(runs.size(), 1u + 3 * 3 * 4);  // short, roof@1, roof@2; three algorithms; four runs
  EXPECT_TRUE(runs[0].starts_with("scenario,algorithm,run,status,mean_error_m,")) << runs[0];
  EXPECT_EQ(summary[0], "scenario,algorithm,metric,n,mean,sd,ci_low,ci_high,reference,baseline,difference,p_value");
  EXPECT_TRUE(summary[1].starts_with("short,enc,mean_error_m,4,")) << summary[1];
  const std::string report = s.file("out/report.html");
  for (const char* text :
       {"A &lt;small&gt; study", "data:image/png;base64,", "sidestep-evaluate study.yaml -o out", "published"})
    EXPECT_NE(report.find(text), std::string::npos) << text;
  for (const char* text : {"src=\"http", "<link", "<script"}) EXPECT_EQ(report.find(text), std::string::npos) << text;
  EXPECT_TRUE(s.file("out/quantiles.csv").starts_with("scenario,algorithm,metric,n,min,q05,q25,median,q75,q95,max,"));
  EXPECT_TRUE(s.file("out/consistency.csv").starts_with("scenario,algorithm,quantity,n,mean,ci_low,ci_high,"));
  EXPECT_NE(report.find("<h2>Consistency</h2>"), std::string::npos);
  EXPECT_NE(report.find("<h2>Medians and tails</h2>"), std::string::npos);
  for (const char* name : {"mean_error_m-median.png", "mean_error_m.png", "mean_error_m-roof.png",
                           "run-short-enc-gps.png", "metrics.json", "effective.yaml", "command.txt"})
    EXPECT_GT(s.file(std::string("out/") + name).size(), 20u) << name;
  EXPECT_TRUE(nlohmann::json::parse(s.file("out/metrics.json")).at("expectations").at(0).at("met").get<bool>());
}

TEST(Evaluate, GivesTheSameBytesForAnyNumberOfThreads) {
  const StudyFolder s;
  ASSERT_EQ(s.run("-o one -j 1").exit_code, 0);
  ASSERT_EQ(s.run("-o two -j 2").exit_code, 0);
  ASSERT_EQ(s.run("-o five -j 5").exit_code, 0);
  for (const char* name : {"runs.csv", "summary.csv", "mean_error_m.png"}) {
    EXPECT_TRUE(s.file(std::string("one/") + name) == s.file(std::string("two/") + name)) << name;
    EXPECT_TRUE(s.file(std::string("one/") + name) == s.file(std::string("five/") + name)) << name;
  }
}

/// What a kill leaves behind: some rows, in any order, the last one cut.
TEST(Evaluate, GoesOnAfterAKillToTheSameBytes) {
  const StudyFolder s;
  ASSERT_EQ(s.run("-o whole").exit_code, 0);
  ASSERT_EQ(s.run("-o cut").exit_code, 0);
  const auto rows = linesOf(s.file("whole/runs.csv"));
  writeFile(s.folder / "cut/runs.csv",
            rows[0] + "\n" + rows[20] + "\n" + rows[3] + "\n" + rows[7].substr(0, rows[7].size() - 9));
  std::filesystem::remove(s.folder / "cut/summary.csv");
  const auto run = s.run("-o cut --resume");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* name : {"runs.csv", "summary.csv"})
    EXPECT_TRUE(s.file(std::string("cut/") + name) == s.file(std::string("whole/") + name)) << name;
}

TEST(Evaluate, ResumesOnlyTheSameStudyButWithMoreRuns) {
  const StudyFolder s;
  ASSERT_EQ(s.run("-o out --runs 2").exit_code, 0);
  const auto other = s.run("-o out --resume --seed 7");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("was made by another study or with other parameters"), std::string::npos) << other.err;
  ASSERT_EQ(s.run("-o out --resume").exit_code, 0);
  ASSERT_EQ(s.run("-o whole").exit_code, 0);
  EXPECT_TRUE(s.file("out/summary.csv") == s.file("whole/summary.csv"));
}

TEST(Evaluate, EffectiveYamlIsEnoughToRunAgain) {
  const StudyFolder s;
  ASSERT_EQ(s.run("-o out").exit_code, 0);
  const auto again = runShell("sidestep-evaluate out/effective.yaml -o again", s.folder.path());
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(s.file("out/runs.csv") == s.file("again/runs.csv"));
}

TEST(Evaluate, AMissedExpectationIsSixAndTheLineThatSaysWhich) {
  const StudyFolder s(replaced(kStudy, "enc+gps mean_error_m <= 100", "enc mean_error_m >= 1000"));
  const auto run = s.run("-o out");
  EXPECT_EQ(run.exit_code, 6);
  EXPECT_TRUE(
      run.err.starts_with("sidestep-evaluate: missed: * enc mean_error_m >= 1000: short enc mean_error_m.mean is "))
      << run.err;
  EXPECT_NE(s.file("out/report.html").find("missed"), std::string::npos);
  EXPECT_EQ(s.run("-o fewer --runs 2").exit_code, 0);  // the study expects it of its own number of runs
}

TEST(Evaluate, AnInterruptSavesWhatIsFinished) {
  const StudyFolder s;
  const auto run = s.run(
      "-o out --scenarios short --runs 1000000 -j 2 & pid=$!\n"
      "until [ -f out/runs.csv ] && [ \"$(wc -l < out/runs.csv)\" -gt 5 ]; do :; done\n"
      "kill -INT $pid\nwait $pid\nexit $?");
  EXPECT_EQ(run.exit_code, 130) << run.err;
  EXPECT_NE(run.err.find("--resume goes on from there"), std::string::npos) << run.err;
  const auto rows = linesOf(s.file("out/runs.csv"));
  EXPECT_GT(rows.size(), 5u);
  const auto commas = std::count(rows[0].begin(), rows[0].end(), ',');
  for (const auto& row : rows) EXPECT_EQ(std::count(row.begin(), row.end(), ','), commas) << row;
  EXPECT_TRUE(nlohmann::json::parse(s.file("out/metrics.json")).at("partial").get<bool>());
  EXPECT_FALSE(s.file("out/report.html").empty());
}

TEST(Evaluate, MissingDataAreOneClearLine) {
  const StudyFolder s(replaced(kStudy, "set: {trajectory: {duration_s: 3}}", "log: ${NOT_THERE}/run.rawlog"));
  const auto unset = s.run("-o out");
  EXPECT_EQ(unset.exit_code, 3);
  EXPECT_EQ(linesOf(unset.err).size(), 1u) << unset.err;
  EXPECT_NE(unset.err.find("the environment variable NOT_THERE is not set"), std::string::npos) << unset.err;
  const auto set = runShell("NOT_THERE=/nowhere sidestep-evaluate study.yaml -o out", s.folder.path());
  EXPECT_EQ(set.exit_code, 3);
  EXPECT_NE(set.err.find("scenarios.short.log: /nowhere/run.rawlog is not there"), std::string::npos) << set.err;
  EXPECT_EQ(s.run("-o out --scenarios 'roof'").exit_code, 0);
}

TEST(Evaluate, WhatIsWrongInAStudyIsNamed) {
  const auto errorOf = [](const std::string& from, const std::string& to) {
    const StudyFolder s(replaced(kStudy, from, to));
    const auto run = s.run("-o out");
    EXPECT_EQ(run.exit_code, 2) << to;
    EXPECT_EQ(linesOf(run.err).size(), 1u) << run.err;
    return run.err;
  };
  EXPECT_NE(errorOf("baseline: enc", "baseline: end").find("did you mean 'enc'?"), std::string::npos);
  EXPECT_NE(errorOf("metrics: [mean_error_m]", "metrics: [mean_eror_m]").find("did you mean 'mean_error_m'?"),
            std::string::npos);
  EXPECT_NE(errorOf("kind: localization", "kind: localisation").find("did you mean 'localization'?"),
            std::string::npos);
  EXPECT_NE(errorOf("axis: outage_s", "axis: outage").find("did you mean 'outage_s'?"), std::string::npos);
  EXPECT_NE(errorOf("duration_s: 3", "duration: 3").find("study.yaml:11: trajectory.duration is no known key"),
            std::string::npos);
  EXPECT_NE(errorOf("filter: odometry", "filtre: odometry").find("study.yaml:18: filtre is no known key"),
            std::string::npos);
  EXPECT_NE(errorOf("short enc+gps", "shrot enc+gps").find("matches no scenario and algorithm"), std::string::npos);
}

TEST(Evaluate, DoesNotWriteIntoAFolderThatHoldsSomething) {
  const StudyFolder s;
  std::filesystem::create_directory(s.folder / "out");
  writeFile(s.folder / "out/mine.txt", "mine");
  const auto run = s.run("-o out");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("holds something"), std::string::npos) << run.err;
  EXPECT_EQ(s.file("out/mine.txt"), "mine");
}

}  // namespace
}  // namespace sidestep::testing
