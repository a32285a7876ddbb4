// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// `sidestep-plan path` as a user runs it, on a small map drawn here.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace sidestep::testing {
namespace {

class PlanPath : public ::testing::Test {
 protected:
  /// 6 m x 4 m in cells of 0.1 m; a wall at x = 3 m with a door from y = 2.5 to y = 4.
  PlanPath() {
    std::string pgm = "P5\n60 40\n255\n";
    for (int row = 0; row < 40; ++row)
      for (int column = 0; column < 60; ++column) pgm += column == 30 && row >= 15 ? '\0' : '\xff';
    writeFile(folder_ / "room.pgm", pgm);
    writeFile(folder_ / "room.yaml", "image: room.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n");
  }
  ProgramResult run(const std::string& arguments) const {
    return runShell("sidestep-plan path --map room.yaml " + arguments, folder_.path());
  }
  nlohmann::json metrics(const std::string& out) const {
    return nlohmann::json::parse(readFile(folder_ / (out + "/metrics.json")));
  }
  TemporaryFolder folder_;
};

TEST_F(PlanPath, OneQueryLeavesAllItsFiles) {
  const auto r = run("--start 1,1,0 --goal 5,1,90 --planner theta -o out");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  for (const char* name : {"path.csv", "path.tum", "path.png", "metrics.json", "effective.yaml", "command.txt"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / name)) << name;
  const auto path = metrics("out")["paths"][0];
  EXPECT_EQ(path["status"], "found");
  // Up to the door's edge, kept by 0.3 m, and down: longer than two straight lines to (3.05, 2.45), shorter than by
  // (3.05, 3).
  EXPECT_GT(path["length_m"].get<double>(), 5.0);
  EXPECT_LT(path["length_m"].get<double>(), 5.66);
  EXPECT_GE(path["clearance_m"].get<double>(), 0.3 - 1e-6);
  EXPECT_TRUE(path.contains("bending_per_m2"));
  const auto lines = linesOf(readFile(folder_ / "out/path.csv"));
  EXPECT_EQ(lines[0], "x,y,heading_deg,clearance_m");
  EXPECT_TRUE(lines[1].starts_with("1,1,")) << lines[1];
  EXPECT_TRUE(lines.back().starts_with("5,1,90,")) << lines.back();
  EXPECT_EQ(linesOf(readFile(folder_ / "out/path.tum")).size(), lines.size() - 1);
}

TEST_F(PlanPath, TheSameCommandGivesTheSamePath) {
  ASSERT_EQ(run("--start 1,1,0 --goal 5,1,90 --smooth --no-picture -o one").exit_code, 0);
  ASSERT_EQ(run("--start 1,1,0 --goal 5,1,90 --smooth --no-picture -o two").exit_code, 0);
  EXPECT_EQ(readFile(folder_ / "one/path.csv"), readFile(folder_ / "two/path.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "one/path.png"));
}

TEST_F(PlanPath, SmoothBendsLessAndKeepsTheClearance) {
  ASSERT_EQ(run("--start 1,1,0 --goal 5,1,90 --no-picture -o rough").exit_code, 0);
  ASSERT_EQ(run("--start 1,1,0 --goal 5,1,90 --no-picture --smooth -o smooth").exit_code, 0);
  const auto rough = metrics("rough")["paths"][0], smooth = metrics("smooth")["paths"][0];
  EXPECT_LT(smooth["bending_per_m2"].get<double>(), 0.5 * rough["bending_per_m2"].get<double>());
  EXPECT_GE(smooth["clearance_m"].get<double>(), 0.3 - 1e-6);
}

TEST_F(PlanPath, AllPlannersMakeOneTableAndOnePicture) {
  const auto r = run("--start 1,1,0 --goal 5,1,90 --all --time 0.2 -o out");
  EXPECT_TRUE(r.exit_code == 0 || r.exit_code == 5) << r.err;  // on a busy machine one of OMPL's may give up
  for (const char* word :
       {"astar", "theta", "dijkstra", "rrtconnect", "rrtstar", "informed-rrtstar", "bitstar", "prmstar", "kpiece"})
    EXPECT_NE(r.out.find(std::string("\n") + word + " "), std::string::npos) << r.out;
  EXPECT_EQ(metrics("out")["paths"].size(), 9u);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/path.png"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/path-astar.csv"));
}

TEST_F(PlanPath, AllLeavesOutThosePlannersThatCannotDriveTheArcsAndSaysSo) {
  const auto r = run("--start 1,1,0 --goal 5,1,90 --all --space dubins --time 0.2 --no-picture -o out");
  EXPECT_TRUE(r.exit_code == 0 || r.exit_code == 5) << r.err;  // on a busy machine one of OMPL's may give up
  const auto lines = linesOf(r.err);
  ASSERT_GE(lines.size(), 3u) << r.err;
  EXPECT_TRUE(lines[0].starts_with("sidestep-plan: left out: informed-rrtstar cannot plan in the space dubins,"));
  EXPECT_TRUE(lines[1].starts_with("sidestep-plan: left out: bitstar cannot plan in the space dubins,"));
  EXPECT_TRUE(lines[2].starts_with("sidestep-plan: left out: prmstar cannot plan in the space dubins,"));
  EXPECT_EQ(metrics("out")["paths"].size(), 6u);
}

TEST_F(PlanPath, PairsMakeABatchWhoseColumnsGoByName) {
  writeFile(folder_ / "pairs.csv", "name,goal_y,goal_x,start_x,start_y\na,1,5,1,1\nb,1,3.05,1,1\n");
  const auto r = run("--pairs pairs.csv -o out");
  EXPECT_EQ(r.exit_code, 5);
  EXPECT_EQ(
      r.err,
      "sidestep-plan: pair 1, astar: no path: the goal (3.05, 1.00) is 0.00 m from an obstacle, less than 0.30 m\n");
  const auto lines = linesOf(readFile(folder_ / "out/paths.csv"));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "pair,planner,status,length_m,clearance_m,time_ms");
  EXPECT_TRUE(lines[1].starts_with("0,astar,found,")) << lines[1];
  EXPECT_TRUE(lines[2].starts_with("1,astar,goal_blocked,,,")) << lines[2];
}

TEST_F(PlanPath, NearestMovesTheEndsAndSaysSo) {
  EXPECT_EQ(run("--start 1,1,0 --goal 3.05,1,0 --no-picture -o refused").exit_code, 5);
  const auto r = run("--start 1,1,0 --goal 3.05,1.05,0 --nearest --no-picture -o out");
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(r.err, "sidestep-plan: goal moved by 0.30 m to (2.75, 1.05)\n");
  EXPECT_EQ(metrics("out")["moved"].size(), 1u);
  const auto out = run("--start 1,1,0 --goal -100,1,0 --nearest --no-picture -o far");
  EXPECT_EQ(out.exit_code, 5);
  EXPECT_TRUE(out.err.starts_with("sidestep-plan: goal not moved: no way of at most 5 m (nearest_within_m) leads to free space\n"))
      << out.err;
}

TEST_F(PlanPath, AFootprintAsksForTheRoomOfItsFarthestCorner) {
  // Corners 0.5 m from the base; the door is 1.5 m wide and high, so that robot turns in it, one of 1.7 m not.
  const auto r = run("--start 1,1,0 --goal 5,1,90 --footprint 0.4,0.3,-0.4,0.3,-0.4,-0.3,0.4,-0.3 --no-picture -o out");
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_GE(metrics("out")["paths"][0]["clearance_m"].get<double>(), 0.5 - 1e-6);
  const auto wide = run("--start 1,1,0 --goal 5,1,90 --footprint 0.8,0,-0.8,0.3,-0.8,-0.3 --no-picture -o wide");
  EXPECT_EQ(wide.exit_code, 5);
  EXPECT_NE(wide.err.find("with a clearance of 0.85 m"), std::string::npos) << wide.err;
}

TEST_F(PlanPath, WhatIsWrongIsOneLineWithItsExitCode) {
  const auto expect = [&](const std::string& arguments, int code, const std::string& line) {
    const auto r = runShell("sidestep-plan path " + arguments, folder_.path());
    EXPECT_EQ(r.exit_code, code) << arguments;
    EXPECT_EQ(r.err, "sidestep-plan: error: " + line + "\n");
    EXPECT_EQ(r.out, "");
  };
  expect("--start 1,1 --goal 2,2", 2, "no --map given; for example --map office.yaml");
  expect("--map none.yaml --start 1,1 --goal 2,2", 3, "none.yaml: a map cannot be read; check the name");
  expect("--map room.yaml --start 1,x --goal 2,2", 2, "--start 1,x: give numbers x,y,deg");
  expect("--map room.yaml --start 1,1 --goal 2,2 --footprint 1,1,2,2", 2,
         "--footprint 1,1,2,2: give the corners x,y,x,y,x,y of three or more");
  expect("--map room.yaml", 2, "give --start x,y,deg and --goal x,y,deg, or --pairs FILE");
  expect("--map room.pgm --start 1,1 --goal 2,2", 2,
         "room.pgm: a plain image does not say how large a pixel is; give its resolution in metres");
  expect("--map room.yaml --resolution 0.1 --start 1,1 --goal 2,2", 2,
         "--resolution is for plain images, which room.yaml is not");
  writeFile(folder_ / "pairs.csv", "start_x,start_y,goal_x,goal_z\n1,1,2,2\n");
  expect("--map room.yaml --pairs pairs.csv", 4, "pairs.csv:1: lacks the column goal_y (is 'goal_x' meant?)");
  writeFile(folder_ / "pairs.csv", "start_x,start_y,goal_x,goal_y\n1,1,2,2\n1,1,2\n");
  expect("--map room.yaml --pairs pairs.csv", 4, "pairs.csv:3: column 4 is no number");
  expect("--map room.yaml --start 1,1 --goal 2,2 --planner prmstar --space dubins -o p", 2,
         "prmstar cannot plan in the space dubins, as its roadmap knows no directions; take reeds-shepp");
  expect("--map room.yaml --start 1,1 --goal 2,2 --planner bitstar --space dubins -o q", 2,
         "bitstar cannot plan in the space dubins, as its samples know no directions; take reeds-shepp");
}

TEST_F(PlanPath, AFolderThatHoldsSomethingIsLeftAlone) {
  ASSERT_EQ(run("--start 1,1,0 --goal 5,1,90 --no-picture -o out").exit_code, 0);
  EXPECT_EQ(run("--start 1,1,0 --goal 5,1,90 --no-picture -o out").exit_code, 2);
  EXPECT_EQ(run("--start 1,1,0 --goal 5,1,90 --no-picture -o out -w").exit_code, 0);
}

TEST_F(PlanPath, ParametersReadBackIdentically) {
  const auto first = runShell("sidestep-plan path --write-config", folder_.path());
  ASSERT_EQ(first.exit_code, 0) << first.err;
  writeFile(folder_ / "config.yaml", first.out);
  EXPECT_EQ(runShell("sidestep-plan path -c config.yaml --write-config", folder_.path()).out, first.out);
}

}  // namespace
}  // namespace sidestep::testing
