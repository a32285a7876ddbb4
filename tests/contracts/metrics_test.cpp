// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Each row of each table of metrics says what it is, doc/metrics.md lists them all, and each kind of study runs.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "evaluation/metrics/trajectory_error.h"
#include "evaluation/study/study.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace sidestep::testing {
namespace {

struct MetricTable {
  std::string title, text;
  std::vector<MetricInfo> rows;
};

std::vector<MetricTable> metricTables() {
  std::vector<MetricTable> out = {{"Errors of a trajectory",
                                   "`estimate` and `odometry` in `metrics.json` of `sidestep-localize`.",
                                   infosOf(errorMetrics())}};
  for (const auto& info : infosOf(neesMetrics())) out[0].rows.push_back(info);
  for (const auto& kind : studyKinds())
    out.push_back({"Studies of kind `" + kind + "`",
                   kind == "world"
                       ? "The same rows stand in `metrics.json` of `sidestep-simulate`, there under the name "
                         "in brackets."
                       : "",
                   makeStudyRunner(kind, "")->metrics()});
  return out;
}

const char* word(Better better) {
  return better == Better::kLower ? "lower" : better == Better::kHigher ? "higher" : "on target";
}

TEST(Metrics, EachRowHasAUnitAndAMeaningAndANameOfItsOwn) {
  static const std::regex name_of_words("[a-z][a-z0-9]*(_[a-z0-9]+)*");
  const std::set<std::string> units = {"m", "m2", "s", "m/s", "deg", "1", "yes/no", "count"};
  for (const auto& table : metricTables()) {
    std::set<std::string> names;
    EXPECT_FALSE(table.rows.empty()) << table.title;
    for (const auto& row : table.rows) {
      EXPECT_TRUE(std::regex_match(row.name, name_of_words)) << row.name;
      EXPECT_TRUE(names.insert(row.name).second) << row.name << " is there twice";
      EXPECT_TRUE(units.count(row.unit)) << row.name << ": unit '" << row.unit << "'";
      EXPECT_GE(row.meaning.size(), 8u) << row.name;
      EXPECT_EQ(row.meaning.find('\n'), std::string::npos) << row.name;
    }
  }
}

TEST(Metrics, ANameMeansTheSameInEachTable) {
  std::map<std::string, MetricInfo> seen;
  for (const auto& table : metricTables())
    for (const auto& row : table.rows) {
      const auto& before = seen.emplace(row.name, row).first->second;
      EXPECT_EQ(before.unit, row.unit) << row.name;
      EXPECT_EQ(before.better, row.better) << row.name;
      EXPECT_EQ(before.meaning, row.meaning) << row.name;
    }
}

TEST(Metrics, AUnitInTheNameIsTheUnit) {
  for (const auto& table : metricTables())
    for (const auto& row : table.rows)
      for (const std::string unit : {"m", "m2", "s", "deg"}) {
        if (row.name.ends_with("_" + unit)) {
          EXPECT_EQ(row.unit, unit) << row.name;
        }
      }
}

std::string document() {
  std::string out =
      "# Metrics\n\n"
      "What a run is measured by. Generated from the code; do not edit. After a change of metrics:\n\n"
      "    SIDESTEP_REGENERATE=1 build/release/bin/test_contracts\n\n"
      "Unit 1 is a ratio, yes/no is 1 or 0 in CSV. *Better* says which way; *on target*: the meaning says where it\n"
      "should lie. What is not defined in a run is an empty cell.\n";
  for (const auto& table : metricTables()) {
    out += "\n## " + table.title + "\n\n";
    if (!table.text.empty()) out += table.text + "\n\n";
    out += "| metric | unit | better | meaning |\n|---|---|---|---|\n";
    for (const auto& row : table.rows) {
      const bool renamed = table.title.find("world") != std::string::npos && !row.alias.empty();
      out += "| `" + row.name + "`" + (renamed ? " (`" + row.alias + "`)" : "") + " | " + row.unit + " | " +
             word(row.better) + " | " + row.meaning + " |\n";
    }
  }
  return out;
}

TEST(Metrics, AreAllInTheDocument) {
  const auto file = std::filesystem::path(SIDESTEP_SOURCE) / "doc" / "metrics.md";
  if (std::getenv("SIDESTEP_REGENERATE") != nullptr) writeFile(file, document());
  EXPECT_EQ(readFile(file), document())
      << "out of date; SIDESTEP_REGENERATE=1 build/release/bin/test_contracts writes it";
}

/// A room of 6 m x 4 m with a pillar, 10 cm a cell.
void writeRoom(const support::TemporaryFolder& folder) {
  std::string pixels = "P5\n60 40\n255\n";
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      const bool wall = x < 2 || y < 2 || x > 57 || y > 37 || (x > 20 && x < 24 && y > 10 && y < 16);
      pixels += wall ? '\0' : '\xfe';
    }
  writeFile(folder / "room.pgm", pixels);
  writeFile(
      folder / "room.yaml",
      "image: room.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

/// The smallest example of each kind; a new kind needs one.
const std::map<std::string, std::string>& smallestStudies() {
  static const std::map<std::string, std::string> studies = {
      {"localization",
       "scenarios: {a: {set: {trajectory: {duration_s: 3}}}}\nalgorithms: {ekf: {set: {filter: ekf}}}\n"},
      {"laser",
       "scenarios: {a: {map: room.yaml, drive: {duration_s: 8}, trial: {start: off}}}\n"
       "algorithms: {mcl: {set: {filter: mcl}}}\n"},
      {"world",
       "scenarios: {a: {set: {duration_s: 2, robots: {robot: {goals: [{x: 1, y: 0}]}}}}}\n"
       "algorithms: {straight: {robot: straight}}\n"}};
  return studies;
}

TEST(StudyKinds, EachRunsItsSmallestExample) {
  const support::TemporaryFolder folder;
  writeRoom(folder);
  for (const auto& kind : studyKinds()) {
    ASSERT_TRUE(smallestStudies().count(kind)) << kind << ": no example here";
    writeFile(folder / (kind + ".yaml"), "kind: " + kind + "\nruns: 1\n" + smallestStudies().at(kind));
    Study study = Study::read(folder / (kind + ".yaml"));
    study.prepare();
    ASSERT_EQ(study.size(), 1u) << kind;
    const auto values = study.runner().run(study.place(0, 0, 0));
    EXPECT_EQ(values.size(), study.runner().metrics().size()) << kind;
    EXPECT_TRUE(std::isfinite(values[0])) << kind;
  }
}

}  // namespace
}  // namespace sidestep::testing
