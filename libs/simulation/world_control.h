// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "simulation/controller.h"
#include "simulation/world_params.h"
#include "simulation/world_perception.h"
#include "simulation/world_physics.h"

namespace sidestep {

/// The controllers of a world's robots, and what they are asked.
class WorldControl {
 public:
  /// @throws ConfigError from `factory`; an empty one makes no controllers.
  WorldControl(const WorldParams& params, const ControllerFactory& factory);
  /// Replaces a robot's controller; null: it moves by `World::command` alone.
  void setController(size_t robot, std::unique_ptr<Controller> controller);
  /// What a robot is commanded now; nothing if it has no controller. A robot that has arrived stands.
  std::optional<mrpt::math::TTwist2D> command(size_t robot, double time_s, const WorldPhysics& world,
                                              const WorldPerception& perception);

 private:
  double period_s_;
  std::vector<double> delays_s_;
  std::vector<std::unique_ptr<Controller>> controllers_;
};

}  // namespace sidestep
