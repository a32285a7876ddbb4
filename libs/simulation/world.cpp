// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/world.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry.h"
#include "core/kinematics.h"
#include "simulation/robot_start.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr double kWallsMatter_m = 5;  // clearance to walls beyond counts as infinite

enum Stream : uint64_t { kEncoders = 1, kImu, kGps, kLaser, kCrowd, kTracks, kFirstRobot = 100 };
enum RobotStream : uint64_t { kStart, kWheels, kPerception, kStreamsPerRobot };

std::vector<Segment> allWalls(const WorldParams& p, const WorldInputs& inputs) {
  std::vector<Segment> out = inputs.walls;
  for (const auto& name : p.wall_names) {
    const WallParams& wall = p.walls.at(name);
    const auto corner = [&](size_t i) { return TPoint2D(wall.points[i][0], wall.points[i][1]); };
    for (size_t i = 0; i + 1 < wall.points.size(); ++i) out.push_back({corner(i), corner(i + 1)});
    if (wall.closed) out.push_back({corner(wall.points.size() - 1), corner(0)});
  }
  return out;
}

std::vector<PeopleParams> groupsOf(const WorldParams& p) {
  std::vector<PeopleParams> out;
  for (const auto& name : p.people_names) out.push_back(p.people.at(name));
  return out;
}

Random robotRandom(uint64_t seed, size_t robot, RobotStream what) {
  return Random(seed, kFirstRobot + kStreamsPerRobot * robot + what);
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

/// A robot with its wheels, its eyes and whoever drives it.
struct Robot {
  Robot(const RobotParams& p, const RobotStart& start, uint64_t seed, size_t index)
      : params(p),
        goals(goalsOf(p, start.goal)),
        drive(p.drive, p.limits, start.pose, robotRandom(seed, index, kWheels)),
        perception(p.perception, robotRandom(seed, index, kPerception)),
        meter(static_cast<int>(index)) {
    drive.startAt(p.start_speed);
  }
  RobotParams params;
  std::vector<mrpt::math::TPose2D> goals;  ///< in order, one at least
  DiffDrive drive;
  Perception perception;
  ContactMeter meter;
  std::unique_ptr<Driver> driver;
  std::vector<MovingObstacle> perceived;
  TPoint2D before;  ///< position before this step
};

}  // namespace

struct World::Impl {
  Impl(const WorldParams& p, uint64_t seed, WorldInputs inputs, const DriverFactory& factory);
  void step();
  void control();
  void order(size_t i, const mrpt::math::TTwist2D& command);
  void drive(size_t i);
  void touch(size_t i);
  void listMoving(size_t robot);
  void sense();
  void senseLaser();
  void publish();

  WorldParams params;
  WallIndex walls;
  Crowd crowd;
  std::vector<Robot> robots;
  std::vector<RobotState> states;
  EncoderModel encoders;
  ImuModel imu;
  GpsErrorModel gps;
  LaserScanner laser;
  SampleClock laser_clock;
  Random laser_random;
  SensorStep sensed;
  bool scanned = false, controlled = false;
  int64_t steps = 0, steps_a_period = 1;
  double time_s = 0;
  std::vector<Body> bodies;
  std::vector<TPoint2D> people_before;
  std::vector<bool> was_present;
  std::vector<MovingObstacle> moving;
  std::vector<SeenDisc> discs;
  std::vector<uint32_t> near_walls;
};

World::Impl::Impl(const WorldParams& p, uint64_t seed, WorldInputs inputs, const DriverFactory& factory)
    : params((p.check(), p)),
      walls(allWalls(p, inputs)),
      crowd(groupsOf(p), shifted(std::move(inputs.tracks), p.tracks_shift_s, Random(seed, kTracks)), p.social_force,
            Random(seed, kCrowd)),
      encoders(params.encoders, Random(seed, kEncoders)),
      imu(params.imu, Random(seed, kImu)),
      gps(params.gps, Random(seed, kGps)),
      laser(params.laser),
      laser_clock(params.laser.rate_hz),
      laser_random(seed, kLaser),
      steps_a_period(std::llround(p.control_period_s / p.step_s)) {
  for (size_t i = 0; i < params.robot_names.size(); ++i) {
    const RobotParams& robot = params.robots.at(params.robot_names[i]);
    const RobotStart start = drawStart(robot, robotRandom(seed, i, kStart), crowd.people(), walls);
    robots.emplace_back(robot, start, seed, i);
    robots.back().driver = factory(robot.planner, robot.limits);
    states.emplace_back();
    states.back().goal = robots.back().goals.front();
    states.back().radius_m = robot.limits.radius_m;
  }
  bodies.resize(robots.size());
  publish();
  sensed.truth.pose = states[0].pose;
}

void World::Impl::publish() {
  for (size_t i = 0; i < robots.size(); ++i) {
    RobotState& s = states[i];
    s.pose = robots[i].drive.pose();
    s.twist = robots[i].drive.twist();
    const double c = std::cos(s.pose.phi), n = std::sin(s.pose.phi);
    bodies[i] = {{s.pose.x, s.pose.y}, {s.twist.vx * c, s.twist.vx * n}, s.radius_m};
    const double to_goal = std::hypot(s.goal.x - s.pose.x, s.goal.y - s.pose.y);
    if (s.arrived || to_goal > robots[i].params.goal_tolerance_m) continue;
    const auto& goals = robots[i].goals;
    if (const auto next = static_cast<size_t>(++s.goals_reached); next < goals.size()) {
      s.goal = goals[next];
      continue;
    }
    s.arrived = true;
    s.arrived_s = time_s;
  }
}

/// All that moves but robot `robot` itself; those blind to the first robot do not get it.
void World::Impl::listMoving(size_t robot) {
  size_t n = 0;
  const auto add = [&](int id, const TPoint2D& position, const TPoint2D& velocity, double radius_m) {
    if (n == moving.size()) moving.emplace_back();
    MovingObstacle& o = moving[n++];
    o.id = id, o.position = position, o.velocity = velocity, o.radius_m = radius_m;
  };
  const auto& people = crowd.people();
  for (const Person& p : people)
    if (p.present) add(p.id, p.position, p.velocity, p.radius_m);
  for (size_t k = 0; k < bodies.size(); ++k) {
    if (k == robot || (k == 0 && !robots[robot].params.sees_robot)) continue;
    add(static_cast<int>(people.size() + k), bodies[k].position, bodies[k].velocity, bodies[k].radius_m);
  }
  moving.resize(n);
}

void World::Impl::order(size_t i, const mrpt::math::TTwist2D& command) {
  states[i].command = command;
  robots[i].drive.order(time_s, command);
}

void World::Impl::control() {
  controlled = true;
  for (size_t i = 0; i < robots.size(); ++i) {
    Robot& robot = robots[i];
    const RobotState& s = states[i];
    listMoving(i);
    robot.perception.perceive(s.pose, moving, walls, robot.perceived);
    if (!robot.driver) continue;
    if (s.arrived)
      order(i, {0, 0, 0});
    else
      order(i, robot.driver->drive({time_s, s.pose, s.twist, s.goal, walls.walls(), robot.perceived,
                                    params.control_period_s, s.command,
                                    robot.params.drive.latency_s + robot.params.drive.lag_s}));
  }
}

/// One robot a step on; a wall holds it where it is.
void World::Impl::drive(size_t i) {
  Robot& robot = robots[i];
  const mrpt::math::TPose2D before = robot.drive.pose();
  robot.before = {before.x, before.y};
  const double radius = robot.params.limits.radius_m;
  robot.drive.step(time_s, params.step_s);
  const auto clearance = [&](const mrpt::math::TPose2D& at) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const uint32_t k : near_walls) {
      const TPoint2D p = nearestPoint(walls.walls()[k], {at.x, at.y});
      nearest = std::min(nearest, std::hypot(p.x - at.x, p.y - at.y) - radius);
    }
    return nearest <= kWallsMatter_m ? nearest : std::numeric_limits<double>::infinity();
  };
  robot.meter.startStep();
  if (!walls.walls().empty()) {
    walls.near(robot.before, kWallsMatter_m + radius, near_walls);
    const double now = clearance(robot.drive.pose());
    robot.meter.wall(time_s, now, std::abs(robot.drive.twist().vx));
    if (now < 0 && now < clearance(before)) robot.drive.block(before);
  }
  states[i].path_m += std::hypot(robot.drive.pose().x - before.x, robot.drive.pose().y - before.y);
}

/// Clearance of one robot to everybody within this step.
void World::Impl::touch(size_t i) {
  Robot& robot = robots[i];
  const auto& at = robot.drive.pose();
  const SweptDisc self{robot.before, {at.x, at.y}, robot.params.limits.radius_m};
  const auto& people = crowd.people();
  for (size_t k = 0; k < people.size(); ++k)
    if (people[k].present)
      robot.meter.body(time_s, params.step_s, self, {people_before[k], people[k].position, people[k].radius_m},
                       people[k].id, true);
  for (size_t k = 0; k < robots.size(); ++k) {
    if (k == i) continue;
    const auto& other = robots[k].drive.pose();
    robot.meter.body(time_s, params.step_s, self,
                     {robots[k].before, {other.x, other.y}, robots[k].params.limits.radius_m}, static_cast<int>(k),
                     false);
  }
}

void World::Impl::senseLaser() {
  discs.clear();
  for (const Person& p : crowd.people()) {
    if (!p.present) continue;
    if (params.laser.people == "legs")
      addLegs(p, discs);
    else
      discs.push_back({p.position, p.radius_m});
  }
  for (size_t k = 1; k < bodies.size(); ++k) discs.push_back({bodies[k].position, bodies[k].radius_m});
  laser.cast(states[0].pose, walls, discs);
  laser.disturb(laser_random);
}

/// The first robot's sensors.
void World::Impl::sense() {
  const RobotState& s = states[0];
  const auto wheels = encoders.step(params.step_s, robots[0].drive.wheelDistance(), robots[0].drive.wheelTurn());
  OdometrySample& o = sensed.odometry;
  o.dt_s = params.step_s;
  o.distance_m = wheels.distance_m, o.turn_rad = wheels.turn_rad;
  o.v = wheels.distance_m / params.step_s, o.w = wheels.turn_rad / params.step_s;
  o.left_ticks = wheels.left_ticks, o.right_ticks = wheels.right_ticks;
  o.pose = alongArc(o.pose, wheels.distance_m, wheels.turn_rad);
  sensed.time_s = time_s;
  sensed.truth = {time_s, s.pose, s.twist.vx, s.twist.omega, s.twist.vx * params.step_s, s.twist.omega * params.step_s};
  sensed.imu.reset();
  sensed.gps.reset();
  if (imu.due(time_s)) {
    const auto r = imu.read(time_s, s.pose.phi, s.twist.omega);
    sensed.imu = {true, r.yaw, r.yaw_rate};
  }
  if (gps.due(time_s)) {
    const auto r = gps.read(time_s, s.pose.x, s.pose.y);
    if (!gps.inOutage(time_s)) sensed.gps = {r.x, r.y};
  }
  scanned = laser_clock.due(time_s);
  if (scanned) senseLaser();
}

void World::Impl::step() {
  controlled = false;
  if (steps % steps_a_period == 0) control();
  ++steps;
  time_s = static_cast<double>(steps) * params.step_s;
  const auto& people = crowd.people();
  people_before.resize(people.size());
  for (size_t k = 0; k < people.size(); ++k) people_before[k] = people[k].position;
  was_present.resize(people.size());
  for (size_t k = 0; k < people.size(); ++k) was_present[k] = people[k].present;
  crowd.step(time_s, params.step_s, bodies, walls);
  for (size_t k = 0; k < people.size(); ++k)
    if (!was_present[k]) people_before[k] = people[k].position;  // who appears has not come here on a line
  for (size_t i = 0; i < robots.size(); ++i) drive(i);
  for (size_t i = 0; i < robots.size(); ++i) touch(i);
  publish();
  sense();
}

World::World(const WorldParams& params, uint64_t seed, WorldInputs inputs, const DriverFactory& factory)
    : impl_(std::make_unique<Impl>(params, seed, std::move(inputs), factory)) {}

World::~World() = default;

const WorldParams& World::params() const { return impl_->params; }
double World::time() const { return impl_->time_s; }
bool World::finished() const {
  return impl_->states[0].arrived || impl_->time_s >= impl_->params.duration_s - 0.5 * impl_->params.step_s;
}
void World::step() { impl_->step(); }
void World::order(size_t i, const mrpt::math::TTwist2D& command) { impl_->order(i, command); }
void World::setDriver(size_t i, std::unique_ptr<Driver> driver) { impl_->robots[i].driver = std::move(driver); }

void World::run(const std::function<bool()>& each) {
  while (!finished()) {
    step();
    if (each && !each()) return;
  }
}

const std::vector<RobotState>& World::robots() const { return impl_->states; }
const std::vector<Person>& World::people() const { return impl_->crowd.people(); }
const WallIndex& World::walls() const { return impl_->walls; }
const ContactMeter& World::contacts(size_t i) const { return impl_->robots[i].meter; }
std::span<const MovingObstacle> World::perceived(size_t i) const { return impl_->robots[i].perceived; }
const SensorStep& World::sensed() const { return impl_->sensed; }
const LaserScanner* World::scan() const { return impl_->scanned ? &impl_->laser : nullptr; }
bool World::controlled() const { return impl_->controlled; }

WorldSummary summarize(const World& world) {
  const RobotState& robot = world.robots()[0];
  const ContactMeter& meter = world.contacts(0);
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
