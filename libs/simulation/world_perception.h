// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include "simulation/perceived.h"
#include "simulation/world_params.h"
#include "simulation/world_physics.h"

namespace sidestep {

/// What each robot perceives of all that moves: people who are there (ids as theirs), then other robots (ids after
/// those of people).
class WorldPerception {
 public:
  WorldPerception(const WorldParams& params, uint64_t seed);
  void perceive(const WorldPhysics& world);
  /// As of the last `perceive`.
  std::span<const MovingObstacle> of(size_t robot) const { return robots_[robot].perceived; }

 private:
  struct Eyes {
    Perception perception;
    bool sees_robot_under_test;
    std::vector<MovingObstacle> perceived;
  };
  void listMoving(const WorldPhysics& world, size_t robot);

  size_t under_test_;
  std::vector<Eyes> robots_;
  std::vector<MovingObstacle> moving_;
};

}  // namespace sidestep
