// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// The program as a user runs it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "datasets/log_reader.h"
#include "support/run_program.h"

namespace sidestep::testing {
namespace {

nlohmann::json jsonOf(const std::filesystem::path& file) { return nlohmann::json::parse(readFile(file)); }

const char* const kShort =
    "kind: world\nduration_s: 2\nrobots: {robot: {goal_x_m: 9}}\npeople: {crowd: {count: 4, x_m: 5, start_spread_m: "
    "3}}\n"
    "laser: {rate_hz: 10, beams: 91}\n";

TEST(Simulate, ALocalizationScenarioBecomesAHealthyLogWithTruth) {
  const TemporaryFolder folder;
  const auto run = runShell("sidestep-simulate share/scenarios/roof-curve.yaml -o '" + (folder / "out").string() + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* name : {"run.rawlog", "trajectory.png", "metrics.json", "effective.yaml", "command.txt"})
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;
  LogReader reader((folder / "out" / "run.rawlog").string());
  std::map<std::string, int> counts;
  while (const auto entry = reader.next()) ++counts[word(entry->kind)];
  EXPECT_FALSE(reader.end().damaged) << reader.end().message;
  // 500 steps and the start; 25 Hz of both sensors, 167 fixes of them under the roof.
  EXPECT_EQ(counts, (std::map<std::string, int>{{"ground_truth", 501}, {"gps", 333}, {"imu", 500}, {"odometry", 501}}));
  EXPECT_NEAR(jsonOf(folder / "out" / "metrics.json")["path_m"].get<double>(), 16, 1e-9);
}

TEST(Simulate, TheExampleOfTheGuideIsTheOfficeAndRuns) {
  const std::string page = readFile(std::filesystem::path(SIDESTEP_SOURCE) / "doc" / "simulation.md");
  const auto begin = page.find("```yaml\n") + 8, end = page.find("```", begin);
  const std::string example = page.substr(begin, end - begin);
  EXPECT_EQ(example, readFile(std::filesystem::path(SIDESTEP_SOURCE) / "share" / "scenarios" / "office.yaml"));
  const TemporaryFolder folder;
  writeFile(folder / "office.yaml", example);
  const auto run = runShell("sidestep-simulate office.yaml --no-picture -o out", folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto metrics = jsonOf(folder / "out" / "metrics.json");
  EXPECT_TRUE(metrics["arrived"].get<bool>());
  EXPECT_EQ(metrics["contacts"]["robot_into_wall"], 0);
  EXPECT_TRUE(metrics["stuck_people"].empty()) << metrics["stuck_people"];
}

TEST(Simulate, AWorldThatCannotBeIsRefusedWithLineAndKeyUnlessForced) {
  const TemporaryFolder folder;
  writeFile(folder / "w.yaml",
            "kind: world\nduration_s: 0.1\nwalls:\n  w: {points: [{x: 2, y: -9}, {x: 2, y: 9}, {x: -2, y: 9}, {x: -2, "
            "y: -9}], "
            "closed: true}\nrobots:\n  robot: {goal_x_m: 5}\npeople:\n  bob: {x_m: 0.2, goal_x_m: 1}\n");
  const auto run = runShell("sidestep-simulate w.yaml --no-picture -o out", folder.path());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("w.yaml:6: robots.robot.goal_x_m: the goal at (5.00, 0.00) cannot be reached"),
            std::string::npos)
      << run.err;
  EXPECT_NE(run.err.find("w.yaml:8: people.bob.x_m: bob starts at (0.20, 0.00) and overlaps robot robot"),
            std::string::npos)
      << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  EXPECT_EQ(runShell("sidestep-simulate w.yaml --no-picture --force -o out", folder.path()).exit_code, 0);

  writeFile(folder / "kind.yaml", "duration_s: 1\nrobots: {robot: {goal_x_m: 5}}\n");
  const auto kind = runShell("sidestep-simulate kind.yaml -o out2", folder.path());
  EXPECT_EQ(kind.exit_code, 2);
  EXPECT_NE(kind.err.find("kind.yaml:2: robots belongs to a world"), std::string::npos) << kind.err;
  EXPECT_NE(kind.err.find("did you mean 'kind: world'?"), std::string::npos) << kind.err;
}

TEST(Simulate, PrintsAWorldToBeginWithThatRuns) {
  const TemporaryFolder folder;
  const auto printed = runShell("sidestep-simulate --write-config --kind world");
  ASSERT_EQ(printed.exit_code, 0) << printed.err;
  writeFile(folder / "w.yaml", printed.out);
  EXPECT_EQ(runShell("sidestep-simulate w.yaml --no-picture -o out", folder.path()).exit_code, 0);
}

TEST(Simulate, SnapshotsShowWhatEachPlannerConsiders) {
  const TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  const auto run = runShell(
      "sidestep-simulate share/scenarios/teb-crossing.yaml --planner teb,eteb --snapshots 1,2 --no-picture -o '" + out +
      "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  // a PNG of two columns of 460 pixels: width and height stand big-endian from byte 16 on
  const std::string png = readFile(folder / "out" / "snapshots.png");
  ASSERT_GT(png.size(), 5000u);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(static_cast<unsigned char>(png[18]) * 256 + static_cast<unsigned char>(png[19]), 920);

  const auto refused = runShell("sidestep-simulate share/scenarios/circle.yaml --snapshots 1 -o '" + out + "2'");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("only of scenarios of kind: world"), std::string::npos) << refused.err;
  const auto two = runShell("sidestep-simulate share/scenarios/teb-crossing.yaml --planner teb,eteb -o '" + out + "3'");
  EXPECT_EQ(two.exit_code, 2);
  EXPECT_NE(two.err.find("more than one only with --snapshots"), std::string::npos) << two.err;
}

TEST(Simulate, TheRobotOfTheHallwayIsGivenAPathAndReachesAllItsGoals) {
  const TemporaryFolder folder;
  const auto run = runShell("sidestep-simulate share/scenarios/hallway.yaml --no-picture --seed 3 -o '" +
                            (folder / "out").string() + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto metrics = jsonOf(folder / "out" / "metrics.json");
  EXPECT_EQ(metrics["goals_reached"], 8);
  EXPECT_EQ(metrics["contacts"]["robot_into_wall"], 0);
}

TEST(Simulate, TheLocalizerWorksOnWhatComesOut) {
  const TemporaryFolder folder;
  const std::string out = (folder / "out").string(), estimate = (folder / "estimate").string();
  ASSERT_EQ(runShell("sidestep-simulate share/scenarios/circle.yaml --no-picture -o '" + out + "'").exit_code, 0);
  const auto run = runShell("sidestep-localize '" + out +
                            "/run.rawlog' -c share/robots/simulated.yaml --no-picture -o '" + estimate + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto metrics = jsonOf(folder / "estimate" / "metrics.json");
  EXPECT_LT(metrics["estimate"]["mean_error_m"].get<double>(), 0.25);
  EXPECT_LT(metrics["estimate"]["mean_error_m"].get<double>(), metrics["odometry"]["mean_error_m"].get<double>());
}

TEST(Simulate, TheSameSeedGivesTheSameBytesAndAnotherDoesNot) {
  const TemporaryFolder folder;
  writeFile(folder / "w.yaml", kShort);
  // The header holds the command line, so all three must look alike but for the seed.
  std::string bytes[3];
  for (int i = 0; i < 3; ++i) {
    const std::string seed = i == 2 ? "4" : "3";
    ASSERT_EQ(runShell("sidestep-simulate w.yaml -w --no-picture -o out --seed " + seed, folder.path()).exit_code, 0);
    bytes[i] = readFile(folder / "out" / "run.rawlog");
  }
  EXPECT_EQ(bytes[0], bytes[1]);
  EXPECT_NE(bytes[0], bytes[2]);
}

TEST(Simulate, AWorldIsRunAgainFromItsEffectiveConfiguration) {
  const TemporaryFolder folder;
  writeFile(folder / "w.yaml", kShort);
  ASSERT_EQ(runShell("sidestep-simulate w.yaml -o a --seed 9", folder.path()).exit_code, 0);
  ASSERT_EQ(runShell("sidestep-simulate a/effective.yaml -o b", folder.path()).exit_code, 0);
  EXPECT_EQ(readFile(folder / "a" / "metrics.json"), readFile(folder / "b" / "metrics.json"));
  EXPECT_TRUE(std::filesystem::exists(folder / "b" / "trajectory.png"));
  const auto metrics = jsonOf(folder / "a" / "metrics.json");
  EXPECT_EQ(metrics["observations"]["laser"], 20);
  EXPECT_EQ(metrics["observations"]["command"], 40);
}

TEST(Simulate, RecordedPeopleAreReplayedFromBesideTheScenario) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "s");
  writeFile(folder / "s" / "people.csv", "t,id,x,y\n100,1,3,0\n110,1,3,0\n");
  writeFile(folder / "s" / "w.yaml",
            "kind: world\nduration_s: 20\ntracks: people.csv\ntracks_from_s: 100\nrobots: {robot: {goal_x_m: 9}}\n");
  ASSERT_EQ(runShell("sidestep-simulate s/w.yaml -o out", folder.path()).exit_code, 0);
  const auto metrics = jsonOf(folder / "out" / "metrics.json");
  EXPECT_EQ(metrics["contacts"]["robot_into_person"], 1);
  EXPECT_EQ(metrics["success"], false);
}

TEST(Simulate, AFilmNeedsFfmpegAndSaysSo) {
  const TemporaryFolder folder;
  writeFile(folder / "w.yaml", kShort);
  std::filesystem::create_directory(folder / "bin");
  for (const char* tool : {"sh", "gnuplot"})
    runShell("ln -s \"$(command -v " + std::string(tool) + ")\" '" + (folder / "bin").string() + "/'");
  const std::string program = std::string(SIDESTEP_BIN) + "/sidestep-simulate";
  const std::string command = "PATH='" + (folder / "bin").string() + "' " + program + " w.yaml --video -o out";
  const auto without = runShell(command, folder.path());
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_NE(without.err.find("--video: ffmpeg is not installed; install it"), std::string::npos) << without.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  // With something of that name: it gets the pictures, 2 s at 10 a second and the first.
  writeFile(folder / "bin" / "ffmpeg",
            "#!" + std::string("/bin/sh\n/bin/ls out/frames > seen; for last; do :; done; echo film > $last\n"));
  std::filesystem::permissions(folder / "bin" / "ffmpeg", std::filesystem::perms::owner_all);
  const auto with = runShell(command, folder.path());
  EXPECT_EQ(with.exit_code, 0) << with.err;
  EXPECT_EQ(linesOf(readFile(folder / "seen")).size(), 21u);
  EXPECT_EQ(readFile(folder / "out" / "run.mp4"), "film\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "frames"));
}

TEST(Simulate, ExplainsWhyThePlannerDidWhatItDid) {
  const TemporaryFolder folder;
  writeFile(folder / "w.yaml",
            "kind: world\nduration_s: 0.2\nrobots: {robot: {goal_x_m: 9, planner: edwa}}\nplanners: {edwa: {window: "
            "{v_samples: 3, w_samples: 5}}}\n");
  auto run = runShell("sidestep-simulate w.yaml --explain -o out", folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto rows = linesOf(readFile(folder / "out" / "explain.csv"));
  EXPECT_EQ(rows[0], "time_s,candidate,chosen,v,w,end_x,end_y,heading,clearance,speed,total,why");
  ASSERT_EQ(rows.size(), 1u + 4 * 15);  // four cycles of 3 x 5 velocities
  int chosen = 0, dearer = 0;
  for (const auto& row : rows) {
    chosen += row.ends_with(",\"costs more\"") ? 0 : 1;
    dearer += row.ends_with(",\"costs more\"") ? 1 : 0;
  }
  EXPECT_EQ(chosen, 1 + 4);
  EXPECT_EQ(dearer, 4 * 14);
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "timeline.png"));
  writeFile(folder / "s.yaml", kShort);
  run = runShell("sidestep-simulate s.yaml --explain -o no", folder.path());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("--explain: the planner of the robot under test is straight, which is no local planner"),
            std::string::npos)
      << run.err;
}

TEST(Simulate, WrongScenariosAreOneLineThatSaysWhere) {
  const TemporaryFolder folder;
  writeFile(folder / "w.yaml", "kind: world\nrobots: {robot: {goal_x: 9}}\n");
  auto run = runShell("sidestep-simulate w.yaml -o out", folder.path());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("w.yaml:2: robots.robot.goal_x is no known key; did you mean 'goal_x_m'?"), std::string::npos)
      << run.err;
  EXPECT_EQ(linesOf(run.err).size(), 1u);
  run = runShell("sidestep-simulate none.yaml -o out", folder.path());
  EXPECT_EQ(run.exit_code, 3);
  run = runShell("sidestep-simulate -o out", folder.path());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("no SCENARIO given"), std::string::npos);
}

TEST(Degrade, ALogLosesWhatTheScriptSays) {
  const TemporaryFolder folder;
  ASSERT_EQ(
      runShell("sidestep-simulate share/scenarios/roof-curve.yaml --no-picture -o '" + (folder / "out").string() + "'")
          .exit_code,
      0);
  writeFile(folder / "s.yaml", "events: {gone: {label: gps}}\n");
  const auto run =
      runShell("sidestep-rawlog degrade out/run.rawlog --script s.yaml -o less.rawlog --json", folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["events"]["gone"]["hit"], 333);
  EXPECT_EQ(runShell("sidestep-rawlog info less.rawlog", folder.path()).out.find("CObservationGPS"), std::string::npos);
  EXPECT_EQ(runShell("sidestep-rawlog degrade out/run.rawlog --script s.yaml -o less.rawlog", folder.path()).exit_code,
            2);
  EXPECT_EQ(runShell("sidestep-rawlog degrade out/run.rawlog --script no.yaml -o l.rawlog", folder.path()).exit_code,
            3);
}

}  // namespace
}  // namespace sidestep::testing
