// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/world_runner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

#include "core/errors.h"
#include "evaluation/experiments/world_scenario.h"
#include "evaluation/study/study.h"
#include "support/run_program.h"

namespace sidestep::testing {
namespace {

/// The robot goes 4 m along x at 1 m/s; somebody stands 0.9 m beside the middle of its way.
const char* const kPassing =
    "kind: world\n"
    "seed: 3\n"
    "robots: {robot: {goal_x_m: 4, limits: {v_max: 1, radius_m: 0.3}},\n"
    "         other: {x_m: 20, goal_x_m: 30, planner: stand}}\n"
    "people: {one: {model: straight, speed: 0, x_m: 2, y_m: 0.9, goal_x_m: 2, goal_y_m: 0.9, radius_m: 0.3}}\n";

struct StudyFile {
  TemporaryFolder folder;
  explicit StudyFile(const std::string& scenarios_and_algorithms, const std::string& world = kPassing) {
    writeFile(folder / "w.yaml", world);
    writeFile(folder / "study.yaml", "kind: world\nruns: 3\n" + scenarios_and_algorithms);
  }
  Study read() const {
    Study study = Study::read((folder / "study.yaml").string());
    study.prepare();
    return study;
  }
  std::string error() const {
    try {
      read();
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }
};

double valueOf(const Study& study, const std::vector<double>& values, const std::string& metric) {
  const auto names = namesOf(study.runner().metrics());
  EXPECT_EQ(names.size(), values.size());
  return values.at(static_cast<size_t>(std::find(names.begin(), names.end(), metric) - names.begin()));
}

TEST(WorldRunner, MetricsAreThoseOfTheGeometry) {
  const StudyFile file("scenarios: {passing: {file: w.yaml}}\nalgorithms: {as-is: {}}\n");
  const Study study = file.read();
  const auto values = study.runner().run(study.place(0, 0, 0));
  const auto value = [&](const char* metric) { return valueOf(study, values, metric); };
  EXPECT_EQ(value("success"), 1);
  EXPECT_EQ(value("collision"), 0);
  // Centres pass at 0.9 m: 0.3 m between the rims.
  EXPECT_NEAR(value("min_clearance"), 0.3, 1e-6);
  EXPECT_NEAR(value("delta_min"), std::exp(-0.3 * 0.3 / 3), 1e-6);
  EXPECT_NEAR(value("ci_max"), std::exp(-0.9 * 0.9 / (2 * 0.45 * 0.45)), 1e-4);
  EXPECT_EQ(value("ci_exceeded"), 0);
  EXPECT_EQ(value("ci_exceeded_time"), 0);
  EXPECT_TRUE(std::isnan(value("min_wall_clearance")));
  EXPECT_TRUE(std::isnan(value("braked")));  // `straight` is no planner that could brake
  EXPECT_NEAR(value("average_velocity"), value("path_length") / value("time"), 1e-12);
}

TEST(WorldRunner, WhoIsTooNearAndForHowLongIsNoted) {
  // The person stands in the way. CI > 0.54 within 0.45 sqrt(-2 ln 0.54) = 0.49955 m of it: 0.999 m at 1 m/s.
  const StudyFile file(
      "scenarios: {hit: {file: w.yaml, set: {people: {one: {y_m: 0, goal_y_m: 0}}}}}\nalgorithms: {as-is: {}}\n");
  const Study study = file.read();
  const auto values = study.runner().run(study.place(0, 0, 0));
  const auto value = [&](const char* metric) { return valueOf(study, values, metric); };
  EXPECT_EQ(value("success"), 0);
  EXPECT_EQ(value("arrived"), 1);
  EXPECT_EQ(value("collision"), 1);
  EXPECT_EQ(value("robot_into_person"), 1);
  EXPECT_EQ(value("delta_min"), 1);
  EXPECT_EQ(value("ci_exceeded"), 1);
  EXPECT_NEAR(value("ci_max"), 1, 1e-3);
  EXPECT_NEAR(value("ci_exceeded_time"), 0.999, 0.02);
}

TEST(WorldRunner, AlgorithmsSayWhoDrivesAndWhatTheySee) {
  const StudyFile file(
      "scenarios: {s: {file: w.yaml, set: {robots: {other: {x_m: 4, y_m: 0.2, yaw_deg: 180, goal_x_m: -4}}, people: "
      "{one: {y_m: 9, "
      "goal_y_m: 9}}}}}\n"
      "algorithms:\n"
      "  standing: {robot: stand, others: {planner: stand}}\n"
      "  blind: {robot: stand, others: {planner: edwa, sees_robot: false}}\n"
      "  seeing: {robot: stand, others: {planner: edwa, sees_robot: true}}\n");
  const Study study = file.read();
  const auto clearance = [&](size_t algorithm) {
    const auto values = study.runner().run(study.place(0, algorithm, 0));
    return valueOf(study, values, "min_clearance");
  };
  EXPECT_NEAR(clearance(0), std::hypot(4, 0.2) - 0.6, 1e-9);  // nobody moves
  EXPECT_LT(clearance(1), 0);                                 // the other one comes, and does not see the robot
  EXPECT_GT(clearance(2), 0.1);                               // it does
}

TEST(WorldRunner, ARunDependsOnItsPlaceAlone) {
  const StudyFile file(
      "scenarios: {s: {file: w.yaml, set: {robots: {robot: {planner: edwa, start_shift_m: 0.5}}}}}\n"
      "algorithms: {as-is: {}}\n");
  const Study study = file.read();
  std::vector<double> first[3], again[3];
  for (size_t run = 0; run < 3; ++run) first[run] = study.runner().run(study.place(0, 0, run));
  {
    std::vector<std::jthread> threads;
    for (size_t run = 0; run < 3; ++run)
      threads.emplace_back([&, run] { again[run] = study.runner().run(study.place(0, 0, run)); });
  }
  for (size_t run = 0; run < 3; ++run)
    for (size_t m = 0; m < first[run].size(); ++m)
      EXPECT_TRUE(first[run][m] == again[run][m] || (std::isnan(first[run][m]) && std::isnan(again[run][m])));
  EXPECT_NE(valueOf(study, first[0], "time"), valueOf(study, first[1], "time"));
}

TEST(WorldRunner, AnAxisVariesTheWorld) {
  const StudyFile file(
      "scenarios: {s: {file: w.yaml, axis: people_speed, x: [0, 1], set: {people: {one: {goal_y_m: -30}}}}}\n"
      "algorithms: {as-is: {}}\n");
  const Study study = file.read();
  const auto still = study.runner().run(study.place(0, 0, 0)), walking = study.runner().run(study.place(1, 0, 0));
  EXPECT_NEAR(valueOf(study, still, "min_clearance"), 0.3, 1e-6);
  EXPECT_NE(valueOf(study, walking, "min_clearance"), valueOf(study, still, "min_clearance"));
}

TEST(WorldRunner, OneOfSeveralGoalsIsDrawnFromThePlaceOfTheOneBefore) {
  const StudyFile file("scenarios: {one: {file: w.yaml, goals: one}, all: {file: w.yaml}}\nalgorithms: {as-is: {}}\n",
                       "kind: world\nrobots: {robot: {goals: [{x: 2, y: 0}, {x: 2, y: 5}, {x: -6, y: 5}]}}\n");
  const Study study = file.read();
  const auto of = [&](size_t row, size_t run, const char* metric) {
    return valueOf(study, study.runner().run(study.place(row, 0, run)), metric);
  };
  // legs of 2, 5 and 8 m, less the tolerance of 0.3 m
  std::set<long> lengths;
  for (size_t run = 0; run < 12; ++run) {
    EXPECT_EQ(of(0, run, "goals_reached"), 1);
    lengths.insert(std::lround(of(0, run, "path_length") + 0.3));
  }
  EXPECT_EQ(lengths, (std::set<long>{2, 5, 8}));
  EXPECT_EQ(of(1, 0, "goals_reached"), 3);
  EXPECT_GT(of(1, 0, "path_length"), 13);
}

TEST(WorldRunner, RecordedPeopleAreReadOnceFromBesideTheScenario) {
  const StudyFile file("scenarios: {s: {file: w.yaml}}\nalgorithms: {as-is: {}, edwa: {robot: edwa}}\n",
                       "kind: world\ntracks: people.csv\nduration_s: 20\nrobots: {robot: {goal_x_m: 6}}\n");
  EXPECT_NE(file.error().find("people.csv"), std::string::npos) << file.error();
  writeFile(file.folder / "people.csv", "t,id,x,y\n0,1,3,0.1\n60,1,3,0.1\n");
  const Study study = file.read();
  std::filesystem::remove(file.folder / "people.csv");
  EXPECT_EQ(valueOf(study, study.runner().run(study.place(0, 0, 0)), "robot_into_person"), 1);
  EXPECT_EQ(valueOf(study, study.runner().run(study.place(0, 1, 0)), "success"), 1);
}

TEST(WorldRunner, ErrorsSayWhichEntry) {
  EXPECT_NE(StudyFile("scenarios: {s: {file: w.yaml}}\nalgorithms: {a: {robot: edva}}\n")
                .error()
                .find("algorithms.a: robots.robot.planner: no local planner 'edva'"),
            std::string::npos);
  EXPECT_NE(StudyFile("scenarios: {s: {set: {duration_s: 3}}}\nalgorithms: {a: {}}\n").error().find("scenarios.s: rob"),
            std::string::npos);
  const auto unknown = StudyFile("scenarios: {s: {file: w.yaml, set: {robot: 1}}}\nalgorithms: {a: {}}\n").error();
  EXPECT_NE(unknown.find("study.yaml:3: robot is no known key; did you mean 'robots'?"), std::string::npos) << unknown;
}

TEST(WorldScenario, AnOverlayKeepsWhomItDoesNotName) {
  WorldScenario s;
  s.layOver("robots: {a: {x_m: 1}, b: {x_m: 2}}", "base");
  s.layOver("robots: {b: {y_m: 5}, another: {x_m: 3}}", "over");
  EXPECT_EQ(s.world.robot_names, (std::vector<std::string>{"a", "b", "another"}));
  EXPECT_EQ(s.world.robots["b"].x_m, 2);
  EXPECT_EQ(s.world.robots["b"].y_m, 5);
}

TEST(WorldScenario, ANameThatIsNearAKnownOneIsMisspeltAndNoNewRobot) {
  WorldScenario s;
  s.layOver("robots: {leader: {x_m: 1}, follower: {x_m: 2}}", "base");
  EXPECT_THROW(s.layOver("robots: {folower: {y_m: 5}}", "over"), ConfigError);
}

}  // namespace
}  // namespace sidestep::testing
