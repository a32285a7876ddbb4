// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// sidestep-plan band and crossing, run as a user runs them.
#include <gtest/gtest.h>

#include "support/run_program.h"

namespace sidestep::testing {
namespace {

const std::string kBand = std::string(SIDESTEP_SOURCE) + "/share/problems/band.csv";
const std::string kCrossing = std::string(SIDESTEP_SOURCE) + "/share/problems/crossing.csv";

/// results.csv without its times, which differ from run to run.
std::string withoutTimes(const std::string& csv, size_t first, size_t count) {
  std::string out;
  for (const auto& line : linesOf(csv)) {
    size_t column = 0;
    for (char c : line) {
      if (c == ',') ++column;
      if (column < first || column >= first + count) out += c;
    }
    out += '\n';
  }
  return out;
}

TEST(PlanBand, SolvesAllProblemsClearOfContact) {
  const TemporaryFolder folder;
  const auto run = runShell("sidestep-plan band --problems " + kBand + " --planner teb -o out", folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto lines = linesOf(readFile(folder / "out/results.csv"));
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0],
            "n_obs,seed,planner,status,time_ms,warm_ms,poses,transition_s,min_dist_m,max_v,max_w,max_a,max_alpha,cost");
  for (size_t k = 1; k < lines.size(); ++k) EXPECT_NE(lines[k].find(",teb,clear,"), std::string::npos) << lines[k];
  for (const char* name : {"metrics.json", "effective.yaml", "command.txt"})
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;
}

TEST(PlanBand, ThreadsChangeNothingButTheTimes) {
  const TemporaryFolder folder;
  const std::string command = "sidestep-plan band --moving --repeats 1 --problems " + kBand;
  ASSERT_EQ(runShell(command + " -o one", folder.path()).exit_code, 0);
  ASSERT_EQ(runShell(command + " -o three --threads 3", folder.path()).exit_code, 0);
  EXPECT_EQ(withoutTimes(readFile(folder / "one/results.csv"), 4, 2),
            withoutTimes(readFile(folder / "three/results.csv"), 4, 2));
}

TEST(PlanBand, ExplainAndVerifySayWhatWasFoundAndWhatExists) {
  const TemporaryFolder folder;
  const std::string command = "sidestep-plan band --repeats 1 --explain --verify --problems " + kBand;
  ASSERT_EQ(runShell(command + " --planner teb -o still", folder.path()).exit_code, 0);
  ASSERT_EQ(runShell(command + " --planner eteb --moving -o moving", folder.path()).exit_code, 0);
  for (const char* run : {"still", "moving"}) {
    const auto rows = linesOf(readFile(folder / (std::string(run) + "/results.csv")));
    EXPECT_TRUE(rows[0].ends_with(",cost,way_exists,least_s"));
    for (size_t k = 1; k < rows.size(); ++k) {
      EXPECT_NE(rows[k].find(",yes,"), std::string::npos) << rows[k];
      EXPECT_GE(std::stod(rows[k].substr(rows[k].rfind(',') + 1)), 10.0 - 1e-9);  // 8 m straight, from rest to rest
    }
    const auto lines = linesOf(readFile(folder / (std::string(run) + "/candidates.csv")));
    EXPECT_TRUE(lines[0].starts_with("n_obs,seed,candidate,chosen,rejected,total,transition_s,time,nonholonomic,"));
    size_t chosen = 0;
    for (const auto& line : lines) chosen += line.find(",1,,") != std::string::npos ? 1 : 0;
    EXPECT_EQ(chosen, rows.size() - 1) << "one of each problem";
  }
}

TEST(PlanBand, ABrokenRowIsNamedWithItsLine) {
  const TemporaryFolder folder;
  writeFile(folder / "p.csv", "n_obs,seed,i,x,y,vx,vy\n5,1,0,1,2,0,0\n5,1,1,nan,2,0,0\n");
  const auto run = runShell("sidestep-plan band --problems p.csv", folder.path());
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_NE(run.err.find("p.csv:3: not n_obs,seed,i,x,y,vx,vy as finite numbers"), std::string::npos) << run.err;
  EXPECT_EQ(runShell("sidestep-plan band --problems none.csv", folder.path()).exit_code, 3);
  EXPECT_EQ(runShell("sidestep-plan band", folder.path()).exit_code, 2);
}

TEST(PlanCrossing, EtebGetsThroughWithoutContact) {
  const TemporaryFolder folder;
  const auto run = runShell("sidestep-plan crossing --planner eteb --problems " + kCrossing + " -o out", folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto lines = linesOf(readFile(folder / "out/results.csv"));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "seed,planner,outcome,time_s,min_clearance_m,plan_ms_median,plan_ms_p95");
  for (size_t k = 1; k < lines.size(); ++k) EXPECT_NE(lines[k].find(",eteb,goal,"), std::string::npos) << lines[k];
}

TEST(PlanCrossing, AnUnknownPlannerIsAnErrorThatNamesTheNearest) {
  const auto run = runShell("sidestep-plan crossing --planner etebb --problems " + kCrossing);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("did you mean 'eteb'?"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace sidestep::testing
