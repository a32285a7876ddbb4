// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/plan_snapshots.h"

#include <cmath>

#include "evaluation/experiments/world_controllers.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

PlanSnapshot snapshotOf(const World& world, const PlanInput& in, const PlanOutput& out,
                        const std::vector<TPoint2D>& driven) {
  const RobotState& robot = world.underTest();
  PlanSnapshot s{in.time_s, robot.pose, robot.radius_m, {robot.goal.x, robot.goal.y}, {}, driven, {}, out.reason};
  for (const Person& p : world.people()) {
    if (!p.present) continue;
    MovingObstacle& o = s.others.emplace_back();
    o.id = p.id, o.position = p.position, o.velocity = p.velocity, o.radius_m = p.radius_m;
  }
  for (size_t k = 0; k < world.robots().size(); ++k) {
    if (k == world.robotUnderTest()) continue;
    const RobotState& r = world.robots()[k];
    MovingObstacle& o = s.others.emplace_back();
    o.position = {r.pose.x, r.pose.y}, o.radius_m = r.radius_m;
    o.velocity = {r.twist.vx * std::cos(r.pose.phi), r.twist.vx * std::sin(r.pose.phi)};
  }
  const auto add = [&](const std::vector<TrajectoryPoint>& trajectory, bool chosen) {
    PlanSnapshot::Line& line = s.candidates.emplace_back();
    line.chosen = chosen;
    for (const auto& p : trajectory) line.points.emplace_back(p.pose.x, p.pose.y);
  };
  for (const auto& c : out.candidates) add(c.trajectory, c.rejected.empty());
  if (out.candidates.empty() && !out.trajectory.empty()) add(out.trajectory, true);
  return s;
}

}  // namespace

std::vector<PlanSnapshot> takeSnapshots(const WorldScenario& scenario, uint64_t seed, const WorldInputs& inputs,
                                        const std::vector<double>& times_s) {
  std::vector<PlanSnapshot> out;
  World world(scenario.world, seed, inputs, navigatorControllers(scenario.planners));
  std::vector<TPoint2D> driven;
  const auto watch = [&](const PlanInput& in, const PlanOutput& plan) {
    driven.emplace_back(in.pose.x, in.pose.y);
    while (out.size() < times_s.size() && in.time_s + 1e-9 >= times_s[out.size()])
      out.push_back(snapshotOf(world, in, plan, driven));
  };
  if (!watchRobotUnderTest(world, scenario, true, watch)) return out;
  world.run([&] { return out.size() < times_s.size(); });
  return out;
}

}  // namespace sidestep
