// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/world_physics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry.h"
#include "simulation/robot_start.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr double kWallsMatter_m = 5;  // clearance to walls beyond counts as infinite

std::vector<Segment> allWalls(const WorldParams& p, const WorldInputs& inputs) {
  std::vector<Segment> out = inputs.walls;
  for (const auto& name : p.wall_names) {
    const auto pieces = p.walls.at(name).segments();
    out.insert(out.end(), pieces.begin(), pieces.end());
  }
  return out;
}

std::vector<PeopleParams> groupsOf(const WorldParams& p) {
  std::vector<PeopleParams> out;
  for (const auto& name : p.people_names) out.push_back(p.people.at(name));
  return out;
}

/// Recorded people, as of a time at random.
std::vector<RecordedTrack> shifted(std::vector<RecordedTrack> tracks, double most_s, Random random) {
  if (!(most_s > 0)) return tracks;
  const double by = random.uniform(0, most_s);
  for (auto& track : tracks)
    for (auto& p : track.points) p.time_s -= by;
  return tracks;
}

std::vector<mrpt::math::TPose2D> goalsOf(const RobotParams& p, const TPoint2D& goal) {
  std::vector<mrpt::math::TPose2D> out;
  for (const auto& row : p.goals) out.emplace_back(row[0], row[1], 0);
  if (out.empty()) out.emplace_back(goal.x, goal.y, 0);
  return out;
}

}  // namespace

WorldPhysics::WorldPhysics(const WorldParams& p, uint64_t seed, WorldInputs inputs)
    : step_s_(p.step_s),
      walls_(allWalls(p, inputs)),
      crowd_(groupsOf(p), shifted(std::move(inputs.tracks), p.tracks_shift_s, worldRandom(seed, WorldStream::kTracks)),
             p.social_force, worldRandom(seed, WorldStream::kCrowd)) {
  for (size_t i = 0; i < p.robot_names.size(); ++i) {
    const RobotParams& robot = p.robots.at(p.robot_names[i]);
    const RobotStart start = drawStart(robot, robotRandom(seed, i, RobotStream::kStart), crowd_.people(), walls_);
    bases_.push_back({goalsOf(robot, start.goal),
                      robot.goal_tolerance_m,
                      robot.limits.radius_m,
                      DiffDrive(robot.drive, robot.limits, start.pose, robotRandom(seed, i, RobotStream::kWheels)),
                      ContactMeter(static_cast<int>(i)),
                      {}});
    bases_.back().drive.startAt(robot.start_speed);
    states_.emplace_back();
    states_.back().goal = bases_.back().goals.front();
    states_.back().radius_m = robot.limits.radius_m;
  }
  bodies_.resize(bases_.size());
  publish(0);
}

void WorldPhysics::command(size_t robot, double time_s, const mrpt::math::TTwist2D& command) {
  states_[robot].command = command;
  bases_[robot].drive.order(time_s, command);
}

void WorldPhysics::step(double time_s) {
  walk(time_s);
  for (size_t i = 0; i < bases_.size(); ++i) roll(i, time_s);
  for (size_t i = 0; i < bases_.size(); ++i) meet(i, time_s);
  publish(time_s);
}

void WorldPhysics::walk(double time_s) {
  const auto& people = crowd_.people();
  people_before_.resize(people.size());
  was_present_.resize(people.size());
  for (size_t k = 0; k < people.size(); ++k) {
    people_before_[k] = people[k].position;
    was_present_[k] = people[k].present;
  }
  crowd_.step(time_s, step_s_, bodies_, walls_);
  for (size_t k = 0; k < people.size(); ++k)
    if (!was_present_[k]) people_before_[k] = people[k].position;  // who appears has not come here on a line
}

/// Of the rim to `near_walls_`; infinity where that is too far to matter.
double WorldPhysics::wallClearance(const mrpt::math::TPose2D& at, double radius_m) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const uint32_t k : near_walls_) {
    const TPoint2D p = nearestPoint(walls_.walls()[k], {at.x, at.y});
    nearest = std::min(nearest, std::hypot(p.x - at.x, p.y - at.y) - radius_m);
  }
  return nearest <= kWallsMatter_m ? nearest : std::numeric_limits<double>::infinity();
}

/// One base a step on; a wall holds it where it is.
void WorldPhysics::roll(size_t i, double time_s) {
  Base& base = bases_[i];
  const mrpt::math::TPose2D before = base.drive.pose();
  base.before = {before.x, before.y};
  base.drive.step(time_s, step_s_);
  base.meter.startStep();
  if (!walls_.walls().empty()) {
    walls_.near(base.before, kWallsMatter_m + base.radius_m, near_walls_);
    const double now = wallClearance(base.drive.pose(), base.radius_m);
    base.meter.wall(time_s, now, std::abs(base.drive.twist().vx));
    if (now < 0 && now < wallClearance(before, base.radius_m)) base.drive.block(before);
  }
  states_[i].path_m += std::hypot(base.drive.pose().x - before.x, base.drive.pose().y - before.y);
}

/// Clearance of one robot to everybody within this step.
void WorldPhysics::meet(size_t i, double time_s) {
  Base& base = bases_[i];
  const auto& at = base.drive.pose();
  const SweptDisc self{base.before, {at.x, at.y}, base.radius_m};
  const auto& people = crowd_.people();
  for (size_t k = 0; k < people.size(); ++k)
    if (people[k].present)
      base.meter.body(time_s, step_s_, self, {people_before_[k], people[k].position, people[k].radius_m}, people[k].id,
                      true);
  for (size_t k = 0; k < bases_.size(); ++k) {
    if (k == i) continue;
    const auto& other = bases_[k].drive.pose();
    base.meter.body(time_s, step_s_, self, {bases_[k].before, {other.x, other.y}, bases_[k].radius_m},
                    static_cast<int>(k), false);
  }
}

void WorldPhysics::publish(double time_s) {
  for (size_t i = 0; i < bases_.size(); ++i) {
    RobotState& s = states_[i];
    s.pose = bases_[i].drive.pose();
    s.twist = bases_[i].drive.twist();
    const double c = std::cos(s.pose.phi), n = std::sin(s.pose.phi);
    bodies_[i] = {{s.pose.x, s.pose.y}, {s.twist.vx * c, s.twist.vx * n}, s.radius_m};
    passGoals(i, time_s);
  }
}

void WorldPhysics::passGoals(size_t i, double time_s) {
  RobotState& s = states_[i];
  const double to_goal = std::hypot(s.goal.x - s.pose.x, s.goal.y - s.pose.y);
  if (s.arrived || to_goal > bases_[i].goal_tolerance_m) return;
  const auto& goals = bases_[i].goals;
  if (const auto next = static_cast<size_t>(++s.goals_reached); next < goals.size()) {
    s.goal = goals[next];
    return;
  }
  s.arrived = true;
  s.arrived_s = time_s;
}

}  // namespace sidestep
