// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include "core/kinematics.h"
#include "simulation/contacts.h"
#include "simulation/crowd.h"
#include "simulation/diff_drive.h"
#include "simulation/wall_index.h"
#include "simulation/world_params.h"
#include "simulation/world_state.h"

namespace sidestep {

/// Bodies among walls: people walk, bases follow their commands, clearances and contacts are measured. It knows nothing
/// of what robots perceive, nor of who commands them.
class WorldPhysics {
 public:
  WorldPhysics(const WorldParams& params, uint64_t seed, WorldInputs inputs);

  /// Commands base `robot` at `time_s`; times must not decrease.
  void command(size_t robot, double time_s, const mrpt::math::TTwist2D& command);
  /// Goes on by one step, to `time_s`.
  void step(double time_s);

  const std::vector<RobotState>& robots() const { return states_; }
  const std::vector<Person>& people() const { return crowd_.people(); }
  std::vector<StuckPerson> stuckPeople() const { return crowd_.stuck(); }
  const WallIndex& walls() const { return walls_; }
  const ContactMeter& contacts(size_t robot) const { return bases_[robot].meter; }
  /// The robots as people see them.
  std::span<const Body> bodies() const { return bodies_; }
  /// What the wheels of a robot turned by in the last step: what encoders see.
  BodyMotion wheels(size_t robot) const {
    return {bases_[robot].drive.wheelDistance(), bases_[robot].drive.wheelTurn()};
  }

 private:
  struct Base {
    std::vector<mrpt::math::TPose2D> goals;  ///< in order, one at least
    double goal_tolerance_m, radius_m;
    DiffDrive drive;
    ContactMeter meter;
    mrpt::math::TPoint2D before;  ///< position before this step
  };
  void walk(double time_s);
  void roll(size_t robot, double time_s);
  void meet(size_t robot, double time_s);
  double wallClearance(const mrpt::math::TPose2D& at, double radius_m) const;
  void publish(double time_s);
  void passGoals(size_t robot, double time_s);

  double step_s_;
  WallIndex walls_;
  Crowd crowd_;
  std::vector<Base> bases_;
  std::vector<RobotState> states_;
  std::vector<Body> bodies_;
  std::vector<mrpt::math::TPoint2D> people_before_;
  std::vector<bool> was_present_;
  std::vector<uint32_t> near_walls_;
};

}  // namespace sidestep
