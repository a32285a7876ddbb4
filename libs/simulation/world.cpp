// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/world.h"

#include <cmath>

#include "simulation/simulated_robot.h"
#include "simulation/world_control.h"
#include "simulation/world_perception.h"
#include "simulation/world_physics.h"

namespace sidestep {

struct World::Impl {
  Impl(const WorldParams& p, uint64_t world_seed, WorldInputs inputs, const ControllerFactory& factory)
      : params((p.check(), p)),
        seed(world_seed),
        under_test(p.underTest()),
        steps_a_period(std::llround(p.control_period_s / p.step_s)),
        physics(params, seed, std::move(inputs)),
        perception(params, seed),
        control(params, factory),
        sensors(params.robot_names.size()),
        ports(params.robot_names.size()) {
    giveSensors(under_test);
  }
  void giveSensors(size_t robot) {
    if (sensors[robot]) return;
    sensors[robot] = std::make_unique<RobotSensors>(params, seed, robot);
    sensors[robot]->startAt(physics.robots()[robot].pose);
  }
  void commandAll() {
    controlled = true;
    perception.perceive(physics);
    for (size_t i = 0; i < physics.robots().size(); ++i)
      if (const auto command = control.command(i, time_s, physics, perception)) physics.command(i, time_s, *command);
  }
  void senseAll() {
    for (size_t i = 0; i < sensors.size(); ++i) {
      if (!sensors[i]) continue;
      sensors[i]->sense(time_s, physics);
      if (ports[i]) ports[i]->take(*sensors[i]);
    }
  }
  void step() {
    controlled = false;
    if (steps % steps_a_period == 0) commandAll();
    ++steps;
    time_s = static_cast<double>(steps) * params.step_s;
    physics.step(time_s);
    senseAll();
  }

  WorldParams params;
  uint64_t seed;
  size_t under_test;
  int64_t steps = 0, steps_a_period = 1;
  double time_s = 0;
  bool controlled = false;
  WorldPhysics physics;
  WorldPerception perception;
  WorldControl control;
  std::vector<std::unique_ptr<RobotSensors>> sensors;  ///< by robot; null: it has none
  std::vector<std::unique_ptr<SimulatedRobot>> ports;  ///< by robot; null: nobody asked
};

World::World(const WorldParams& params, uint64_t seed, WorldInputs inputs, const ControllerFactory& factory)
    : impl_(std::make_unique<Impl>(params, seed, std::move(inputs), factory)) {}

World::~World() = default;

const WorldParams& World::params() const { return impl_->params; }
double World::time() const { return impl_->time_s; }
bool World::finished() const {
  return underTest().arrived || impl_->time_s >= impl_->params.duration_s - 0.5 * impl_->params.step_s;
}
void World::step() { impl_->step(); }
void World::command(size_t i, const mrpt::math::TTwist2D& command) {
  impl_->physics.command(i, impl_->time_s, command);
}
void World::setController(size_t i, std::unique_ptr<Controller> controller) {
  impl_->control.setController(i, std::move(controller));
}

RobotPort& World::robotPort(size_t i) {
  impl_->giveSensors(i);
  if (!impl_->ports[i]) impl_->ports[i] = std::make_unique<SimulatedRobot>(*this, i);
  return *impl_->ports[i];
}

void World::run(const std::function<bool()>& each) {
  while (!finished()) {
    step();
    if (each && !each()) return;
  }
}

const std::vector<RobotState>& World::robots() const { return impl_->physics.robots(); }
size_t World::robotUnderTest() const { return impl_->under_test; }
const std::vector<Person>& World::people() const { return impl_->physics.people(); }
std::vector<StuckPerson> World::stuckPeople() const { return impl_->physics.stuckPeople(); }
const WallIndex& World::walls() const { return impl_->physics.walls(); }
const ContactMeter& World::contacts(size_t i) const { return impl_->physics.contacts(i); }
std::span<const MovingObstacle> World::perceived(size_t i) const { return impl_->perception.of(i); }
const RobotSensors& World::sensors() const { return *impl_->sensors[impl_->under_test]; }
bool World::controlled() const { return impl_->controlled; }

WorldSummary summarize(const World& world) {
  const RobotState& robot = world.underTest();
  const ContactMeter& meter = world.contacts(world.robotUnderTest());
  WorldSummary out;
  out.arrived = robot.arrived;
  out.goals_reached = robot.goals_reached;
  out.time_s = robot.arrived_s.value_or(world.time());
  out.path_m = robot.path_m;
  out.average_velocity = out.time_s > 0 ? out.path_m / out.time_s : 0;
  out.min_clearance_m = meter.minClearance();
  out.min_wall_clearance_m = meter.minWallClearance();
  for (const auto kind : {Contact::Kind::kRobotIntoPerson, Contact::Kind::kPersonIntoRobot,
                          Contact::Kind::kRobotIntoRobot, Contact::Kind::kRobotIntoWall})
    out.contacts[word(kind)] = 0;
  for (const Contact& c : meter.contacts()) ++out.contacts[word(c.kind)];
  out.collision = !meter.contacts().empty();
  out.success = out.arrived && !out.collision;
  return out;
}

}  // namespace sidestep
