// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/world_scenario.h"

#include <algorithm>
#include <filesystem>

#include "core/data_path.h"
#include "core/errors.h"
#include "datasets/track_file.h"
#include "evaluation/experiments/world_check.h"
#include "evaluation/experiments/world_controllers.h"
#include "maps/map_file.h"
#include "simulation/map_walls.h"

namespace sidestep {
namespace {

std::vector<std::string> joinedNames(std::vector<std::string> first, const std::vector<std::string>& then) {
  for (const auto& name : then)
    if (std::find(first.begin(), first.end(), name) == first.end()) first.push_back(name);
  return first;
}

}  // namespace

void WorldScenario::visit(ParamVisitor& v) {
  world.visit(v);
  v.section("planners", "local planners and what they are told, for all robots",
            [this](ParamVisitor& s) { planners.visit(s); });
}

void WorldScenario::layOver(const std::string& yaml, const std::string& name) {
  checkNewNames(yaml, name, world);
  const auto walls = world.wall_names, robots = world.robot_names, people = world.people_names;
  readYamlText(yaml, name, [this](ParamVisitor& v) { visit(v); });
  world.wall_names = joinedNames(walls, world.wall_names);
  world.robot_names = joinedNames(robots, world.robot_names);
  world.people_names = joinedNames(people, world.people_names);
}

void WorldScenario::check() const {
  world.check();
  const ControllerFactory make = navigatorControllers(planners);
  for (const auto& name : world.robot_names) {
    const RobotParams& robot = world.robots.at(name);
    try {
      make(robot.planner, robot.limits);
    } catch (const ConfigError& e) {
      throw ConfigError("robots." + name + ".planner: " + e.what());
    }
  }
}

RobotParams& robotUnderTest(WorldParams& world) { return world.robots.at(world.robot_names[world.underTest()]); }
const RobotParams& robotUnderTest(const WorldParams& world) {
  return world.robots.at(world.robot_names[world.underTest()]);
}

bool watchRobotUnderTest(World& world, const WorldScenario& scenario, bool explain, PlanWatch watch) {
  const RobotParams& robot = robotUnderTest(scenario.world);
  if (!isLocalPlanner(robot.planner)) return false;
  auto planner = makeLocalPlanner(robot.planner, scenario.planners.planners);
  planner->explain(explain);
  world.setController(world.robotUnderTest(),
                      makeNavigatorController(std::move(planner), robot.limits, scenario.planners, std::move(watch)));
  return true;
}

std::string scenarioPath(const std::string& path, const std::string& scenario_file) {
  namespace fs = std::filesystem;
  const std::string name = withVariables(path, scenario_file);
  if (fs::exists(name)) return name;
  const auto beside = fs::path(scenario_file).parent_path() / name;
  return fs::exists(beside) ? beside.string() : name;
}

WorldInputs readWorldInputs(const WorldParams& params, const std::string& scenario_file) {
  WorldInputs out;
  if (!params.map.empty()) {
    ObstacleParams known_only;
    known_only.unknown_blocks = false;
    out.walls = wallsOf(readMap(scenarioPath(params.map, scenario_file)), known_only);
  }
  if (params.tracks.empty()) return out;
  for (const auto& [id, rows] : readTracks(scenarioPath(params.tracks, scenario_file))) {
    RecordedTrack& track = out.tracks.emplace_back();
    track.id = id;
    for (const auto& row : rows) track.points.push_back({row.time_s - params.tracks_from_s, {row.x, row.y}});
  }
  return out;
}

}  // namespace sidestep
