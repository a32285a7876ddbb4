// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "simulation/contacts.h"
#include "simulation/driver.h"
#include "simulation/localization_scenario.h"
#include "simulation/world_params.h"

namespace sidestep {

/// What a world needs besides its parameters: what was read from files.
struct WorldInputs {
  std::vector<Segment> walls;         ///< of a map, besides those of the parameters
  std::vector<RecordedTrack> tracks;  ///< recorded people, time 0 at the start of the run
};

/// A robot at work.
struct RobotState {
  mrpt::math::TPose2D pose;      ///< true [m, rad]
  mrpt::math::TTwist2D twist;    ///< over the ground, base frame
  mrpt::math::TTwist2D command;  ///< last ordered
  mrpt::math::TPose2D goal;      ///< the one it is on its way to
  int goals_reached = 0;
  double radius_m = 0;
  bool arrived = false;  ///< at its last goal
  std::optional<double> arrived_s;
  double path_m = 0;
};

/// Robots and people among walls. The same parameters, inputs, seed and orders give the same world, bit by bit.
///
/// Time goes on by `step`; robots do what was last ordered by `order`. `drive` asks the drivers of all robots, as often
/// as the control period says, and is all that a study needs; the live navigator orders by itself.
class World {
 public:
  /// @throws ConfigError as WorldParams::check, or from `factory`.
  World(const WorldParams& params, uint64_t seed, WorldInputs inputs = {},
        const DriverFactory& factory = makeSimpleDriver);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const WorldParams& params() const;
  double time() const;
  /// True once time is over or the first robot has arrived.
  bool finished() const;

  /// One step of simulation: people, robots, contacts, then sensors.
  void step();
  /// Orders robot `i` about.
  void order(size_t i, const mrpt::math::TTwist2D& command);
  /// Replaces the driver of robot `i`; null: only `order` moves it.
  void setDriver(size_t i, std::unique_ptr<Driver> driver);
  /// Steps until `finished`, or until `each` (told after each step; may be empty) says false.
  void run(const std::function<bool()>& each = {});

  const std::vector<RobotState>& robots() const;
  const std::vector<Person>& people() const;
  const WallIndex& walls() const;
  /// Clearance and contacts of robot `i`.
  const ContactMeter& contacts(size_t i) const;
  /// All that moves and that robot `i` may not touch: people who are there (ids as theirs), then other robots (ids
  /// after those of people), as perceived at the last control step.
  std::span<const MovingObstacle> perceived(size_t i) const;

  /// What the first robot's sensors said in this step; truth and odometry always.
  const SensorStep& sensed() const;
  /// The scan of this step, if there was one.
  const LaserScanner* scan() const;
  /// Whether drivers were asked in this step.
  bool controlled() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What a run came to, for the first robot.
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
