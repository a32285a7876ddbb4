// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Section 4.1 in the small: the first runs of the study table-4.2 meet its targets.
#include <gtest/gtest.h>

#include <algorithm>

#include "evaluation/experiments/world_controllers.h"
#include "evaluation/experiments/world_scenario.h"
#include "evaluation/study/study.h"

namespace sidestep::testing {
namespace {

/// With run 15 of scenario 2, in which a robot that may stop where somebody comes is run over by one who goes straight.
constexpr size_t kRuns = 16;

/// Table 4.2 of the dissertation.
constexpr double kEdwaDwa[] = {0.9531, 0.9441, 0.9439, 0.9361}, kEdwaEdwa[] = {0.9711, 0.9630, 0.9527, 0.9461};

const Study& table42() {
  static const Study study = [] {
    Study s = Study::read(std::string(SIDESTEP_SOURCE) + "/share/studies/table-4.2.yaml");
    s.prepare();
    return s;
  }();
  return study;
}

size_t position(const std::vector<std::string>& words, const std::string& word) {
  return static_cast<size_t>(std::find(words.begin(), words.end(), word) - words.begin());
}

/// One metric of the first runs of scenario `row`.
std::vector<double> firstRuns(size_t row, const std::string& algorithm, const std::string& metric) {
  const Study& s = table42();
  const size_t a = position(s.algorithms(), algorithm), m = position(namesOf(s.runner().metrics()), metric);
  std::vector<double> out;
  for (size_t run = 0; run < kRuns; ++run) out.push_back(s.runner().run(s.place(row, a, run)).at(m));
  return out;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

void expectSafeAndFast(const std::string& algorithm, const double* velocities) {
  ASSERT_EQ(table42().rows().size(), 4u);
  for (size_t row = 0; row < 4; ++row) {
    EXPECT_EQ(mean(firstRuns(row, algorithm, "success")), 1) << algorithm << " " << table42().rows()[row].name;
    EXPECT_GE(mean(firstRuns(row, algorithm, "average_velocity")), velocities[row])
        << algorithm << " " << table42().rows()[row].name;
  }
}

TEST(Section41, EdwaAmongDwaNeverTouchesAndIsAsFastAsTable42) { expectSafeAndFast("edwa-dwa", kEdwaDwa); }
TEST(Section41, EdwaAmongEdwaNeverTouchesAndIsAsFastAsTable42) { expectSafeAndFast("edwa-edwa", kEdwaEdwa); }
TEST(Section41, EdwaPassesThoseWhoNeitherSeeNorBrake) { expectSafeAndFast("edwa-straight", kEdwaDwa); }

TEST(Section41, EdwaKeepsFartherAwayThanDwaDoes) {
  for (size_t row = 0; row < 4; ++row)
    EXPECT_GT(mean(firstRuns(row, "edwa-dwa", "min_clearance")), mean(firstRuns(row, "dwa-dwa", "min_clearance")))
        << table42().rows()[row].name;
}

TEST(Section41, AGoalInsideTheTurningCircleIsReachedAllTheSame) {
  // Starts at full speed, the goal abeam 2 m away; the turning circle has 2.86 m.
  for (const std::string name : {"dwa", "edwa", "hrvo"}) {
    WorldScenario s;
    s.layOver("{control_period_s: 0.25, duration_s: 60, robots: {robot: {planner: " + name +
                  ", start_speed: 1, goal_y_m: 2, goal_tolerance_m: 0.5, limits: {v_max: 1, w_max: 0.35, accel: 1, "
                  "brake: 1, turn_accel: 1}}}}",
              "test");
    World world(s.world, 1, {}, navigatorControllers(s.planners));
    world.run();
    EXPECT_TRUE(summarize(world).arrived) << name;
  }
}

}  // namespace
}  // namespace sidestep::testing
