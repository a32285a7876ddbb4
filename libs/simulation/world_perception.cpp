// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/world_perception.h"

namespace sidestep {

WorldPerception::WorldPerception(const WorldParams& params, uint64_t seed) : under_test_(params.underTest()) {
  for (size_t i = 0; i < params.robot_names.size(); ++i) {
    const RobotParams& p = params.robots.at(params.robot_names[i]);
    robots_.push_back({Perception(p.perception, robotRandom(seed, i, RobotStream::kPerception)), p.sees_robot, {}});
  }
}

/// All that moves but the robot itself; those blind to the robot under test do not get it.
void WorldPerception::listMoving(const WorldPhysics& world, size_t robot) {
  size_t n = 0;
  const auto add = [&](int id, const mrpt::math::TPoint2D& position, const mrpt::math::TPoint2D& velocity,
                       double radius_m) {
    if (n == moving_.size()) moving_.emplace_back();
    MovingObstacle& o = moving_[n++];
    o.id = id, o.position = position, o.velocity = velocity, o.radius_m = radius_m;
  };
  const auto& people = world.people();
  for (const Person& p : people)
    if (p.present) add(p.id, p.position, p.velocity, p.radius_m);
  const auto bodies = world.bodies();
  for (size_t k = 0; k < bodies.size(); ++k) {
    if (k == robot || (k == under_test_ && !robots_[robot].sees_robot_under_test)) continue;
    add(static_cast<int>(people.size() + k), bodies[k].position, bodies[k].velocity, bodies[k].radius_m);
  }
  moving_.resize(n);
}

void WorldPerception::perceive(const WorldPhysics& world) {
  for (size_t i = 0; i < robots_.size(); ++i) {
    listMoving(world, i);
    robots_[i].perception.perceive(world.robots()[i].pose, moving_, world.walls(), robots_[i].perceived);
  }
}

}  // namespace sidestep
