// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/robot_port.h"
#include "simulation/contacts.h"
#include "simulation/controller.h"
#include "simulation/robot_sensors.h"
#include "simulation/world_params.h"
#include "simulation/world_state.h"

namespace sidestep {

/// Robots and people among walls. The same parameters, inputs, seed and commands give the same world, bit by bit.
///
/// Time goes on by `step`, in stages that hand values on: each control period all robots perceive, then their
/// controllers command; in each step bodies move and touch (`WorldPhysics`), then sensors read. A robot without a
/// controller does what `command` or its `robotPort` said last.
class World {
 public:
  /// @throws ConfigError as WorldParams::check, or from `factory`; without a factory no robot has a controller.
  World(const WorldParams& params, uint64_t seed, WorldInputs inputs = {}, const ControllerFactory& factory = {});
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const WorldParams& params() const;
  double time() const;
  /// True once time is over or the robot under test has arrived.
  bool finished() const;

  /// One step of simulation: people, robots, contacts, then sensors.
  void step();
  /// Commands robot `i`.
  void command(size_t i, const mrpt::math::TTwist2D& command);
  /// Replaces the controller of robot `i`; null: only `command` and its port move it.
  void setController(size_t i, std::unique_ptr<Controller> controller);
  /// Robot `i` as a robot like any other; from now on it has sensors. Valid as long as the world.
  RobotPort& robotPort(size_t i);
  /// Steps until `finished`, or until `each` (told after each step; may be empty) says false.
  void run(const std::function<bool()>& each = {});

  const std::vector<RobotState>& robots() const;
  /// Number of the robot that the run is about: the one that the parameters name, or the first.
  size_t robotUnderTest() const;
  const RobotState& underTest() const { return robots()[robotUnderTest()]; }
  const std::vector<Person>& people() const;
  /// Who was under way and did not get on for 10 s or longer, so far.
  std::vector<StuckPerson> stuckPeople() const;
  const WallIndex& walls() const;
  /// Clearance and contacts of robot `i`.
  const ContactMeter& contacts(size_t i) const;
  /// All that moves and that robot `i` may not touch: people who are there (ids as theirs), then other robots (ids
  /// after those of people), as perceived at the last control step.
  std::span<const MovingObstacle> perceived(size_t i) const;

  /// The sensors of the robot under test.
  const RobotSensors& sensors() const;
  /// What they said in this step; truth and odometry always.
  const SensorStep& sensed() const { return sensors().sensed(); }
  /// The scan of this step, if there was one.
  const LaserScanner* scan() const { return sensors().scan(); }
  /// Whether controllers were asked in this step.
  bool controlled() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What a run came to, for the robot under test.
struct WorldSummary {
  bool success = false;  ///< arrived, and without contact
  bool arrived = false;
  int goals_reached = 0;
  double time_s = 0;  ///< until it arrived, or the end
  double path_m = 0;
  double average_velocity = 0;          ///< path by time [m/s]
  double min_clearance_m = 0;           ///< to people and other robots; infinity if there was nobody
  double min_wall_clearance_m = 0;      ///< infinity if never below 5 m
  std::map<std::string, int> contacts;  ///< by kind, all four
  bool collision = false;
};
WorldSummary summarize(const World& world);

}  // namespace sidestep
