// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "core/robot_port.h"
#include "simulation/robot_sensors.h"

namespace sidestep {

class World;

/// A robot of a world behind the door of a real one. Time goes on by `World::step`, which whoever holds the world
/// calls; readings are those of the scenario's sensors, stamped from `kSimulationStart_s` on, the truth among them.
///
/// The world commands as long as the robot has a controller: take it away (`World::setController`) to drive.
class SimulatedRobot final : public RobotPort {
 public:
  /// Made by `World::robotPort`.
  SimulatedRobot(World& world, size_t robot) : world_(world), robot_(robot) {}
  SimulatedRobot(const SimulatedRobot&) = delete;
  SimulatedRobot& operator=(const SimulatedRobot&) = delete;

  void read(std::vector<Reading>& readings) override;
  void drive(const mrpt::math::TTwist2D& command) override;
  void stop() noexcept override;
  RobotHealth health() const override;
  /// The world hands over what was sensed in a step.
  void take(const RobotSensors& sensors);

 private:
  World& world_;
  size_t robot_;
  std::vector<Reading> waiting_;
  double last_reading_s_ = 0;
};

}  // namespace sidestep
