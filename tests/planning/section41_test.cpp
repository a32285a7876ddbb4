// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Section 4.1 in the small: what must hold in each encounter.
#include <gtest/gtest.h>

#include "support/encounter.h"

namespace sidestep::testing {
namespace {

using support::runEncounter;
using support::section41Encounter;

/// Table 4.2, EDWA-DWA and EDWA-EDWA.
constexpr double kTable42[2][4] = {{0.9531, 0.9441, 0.9439, 0.9361}, {0.9711, 0.9630, 0.9527, 0.9461}};

void expectSafeAndFast(int scenario, const std::string& others, double average) {
  constexpr int kSeeds = 25;
  double sum = 0;
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto r = runEncounter(section41Encounter(scenario, "edwa", others, seed));
    EXPECT_TRUE(r.reached) << others << " scenario " << scenario << " seed " << seed;
    EXPECT_FALSE(r.collided) << others << " scenario " << scenario << " seed " << seed << ": " << r.clearance_m << " m";
    sum += r.average_velocity();
  }
  EXPECT_GE(sum / kSeeds, average) << others << " scenario " << scenario;
}

TEST(Section41, EdwaAmongDwaNeverTouchesAndIsAsFastAsTable42) {
  for (int s = 1; s <= 4; ++s) expectSafeAndFast(s, "dwa", kTable42[0][s - 1]);
}

TEST(Section41, EdwaAmongEdwaNeverTouchesAndIsAsFastAsTable42) {
  for (int s = 1; s <= 4; ++s) expectSafeAndFast(s, "edwa", kTable42[1][s - 1]);
}

TEST(Section41, EdwaPassesThoseWhoNeitherSeeNorBrake) {
  for (int s = 1; s <= 4; ++s) expectSafeAndFast(s, "straight", kTable42[0][s - 1]);
}

TEST(Section41, EdwaKeepsFartherAwayThanDwaDoes) {
  for (int s = 1; s <= 4; ++s) {
    double dwa = 0, edwa = 0;
    for (uint64_t seed = 1; seed <= 10; ++seed) {
      dwa += runEncounter(section41Encounter(s, "dwa", "dwa", seed)).clearance_m;
      edwa += runEncounter(section41Encounter(s, "edwa", "dwa", seed)).clearance_m;
    }
    EXPECT_GT(edwa, dwa) << "scenario " << s;
  }
}

TEST(Section41, AGoalInsideTheTurningCircleIsReachedAllTheSame) {
  // Starts at full speed, the goal abeam 2 m away; the turning circle has 2.86 m.
  for (const std::string name : {"dwa", "edwa", "hrvo"}) {
    auto e = section41Encounter(1, name, "straight", 1, 0);
    e.actors.resize(1);
    e.actors[0].pose = {0, 0, 0};
    e.actors[0].goal = {0, 2};
    e.actors[0].v = 1;
    EXPECT_TRUE(runEncounter(e).reached) << name;
  }
}

TEST(Section41, TheSameSeedGivesTheSameRun) {
  const auto a = runEncounter(section41Encounter(4, "edwa", "edwa", 7)),
             b = runEncounter(section41Encounter(4, "edwa", "edwa", 7));
  EXPECT_EQ(a.time_s, b.time_s);
  EXPECT_EQ(a.clearance_m, b.clearance_m);
  EXPECT_EQ(a.way_m, b.way_m);
}

}  // namespace
}  // namespace sidestep::testing
