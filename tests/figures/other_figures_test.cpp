// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Each kind of picture is drawn of little, of nothing and of what is not a number.
#include <gtest/gtest.h>

#include <cmath>

#include "figures/band_figure.h"
#include "figures/consistency_figure.h"
#include "figures/snapshot_figure.h"
#include "figures/timeline_figure.h"
#include "figures/world_figure.h"
#include "support/temporary_folder.h"

namespace sidestep {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

TEST(ConsistencyFigure, IsDrawnOfAnyValues) {
  const support::TemporaryFolder folder;
  ConsistencyFigure figure;
  EXPECT_FALSE(drawConsistency(figure, folder / "c.png"));
  figure.panels.push_back({"none", 3, {}, {}});
  figure.panels.push_back({"some", 1, {{0, 0, true}, {1, -1, false}, {2, kNaN, true}, {3, 1e99, true}}, {}});
  figure.panels.push_back({"means", 1, {{0, 1, true}}, {{0, 1, 0.5, 2}, {1, 0, 0, kInf}}});
  EXPECT_TRUE(drawConsistency(figure, folder / "c.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "c.png"));
}

TEST(TimelineFigure, IsDrawnOfARobotThatStands) {
  const support::TemporaryFolder folder;
  drawTimeline({"stands", 0.54, {{"", {{0, 0, 0, 0, 0}}}}}, folder / "t.png");
  EXPECT_TRUE(std::filesystem::exists(folder / "t.png"));
  drawTimeline({"backs", 0.54, {{"a", {{0, 1, -1, -2, 1}, {1, 0, -1, 2, 0}}}, {"b", {}}}}, folder / "b.png");
  EXPECT_TRUE(std::filesystem::exists(folder / "b.png"));
}

TEST(WorldFigure, IsDrawnOfARobotThatStandsAndOfSomebodyWhoIsNotThere) {
  const support::TemporaryFolder folder;
  WorldFigure figure;
  figure.paths = {{"robot", 0.3, true, {{1, 1}, {1, 1}}}, {"1", 0.3, false, {{kNaN, kNaN}, {kNaN, kNaN}}}};
  drawWorld(figure, folder / "w.png");
  EXPECT_TRUE(std::filesystem::exists(folder / "w.png"));
}

TEST(SnapshotFigure, IsDrawnWithoutCandidates) {
  const support::TemporaryFolder folder;
  PlanSnapshot s;
  s.radius_m = 0.3;
  drawSnapshots({{"dwa", {s}}, {"it's none", {}}}, {}, folder / "s.png");
  EXPECT_TRUE(std::filesystem::exists(folder / "s.png"));
}

TEST(BandFigure, IsDrawnWithoutBands) {
  const support::TemporaryFolder folder;
  drawBands({0.2, {{"it's empty", {}, {}, {}}}}, folder / "b.png");
  EXPECT_TRUE(std::filesystem::exists(folder / "b.png"));
}

}  // namespace
}  // namespace sidestep
