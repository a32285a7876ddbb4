// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/scenario.h"

#include <fstream>
#include <sstream>

#include "core/errors.h"
#include "evaluation/experiments/world_check.h"

namespace sidestep {

std::string textOf(const std::string& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

Scenario Scenario::exampleOf(const std::string& kind) {
  Scenario out;
  out.kind = kind;
  if (kind != "world") return out;
  WorldParams& w = out.world.world;
  w.wall_names = {"room"};
  w.walls["room"] = {{{0, 0}, {8, 0}, {8, 5}, {0, 5}}, true};
  w.robot_names = {"robot"};
  RobotParams& robot = w.robots["robot"];
  robot.planner = "eteb";
  robot.x_m = 1, robot.y_m = 2.5, robot.goal_x_m = 7, robot.goal_y_m = 2.5;
  w.people_names = {"anna"};
  PeopleParams& anna = w.people["anna"];
  anna.x_m = 6, anna.y_m = 1, anna.goal_x_m = 2, anna.goal_y_m = 4;
  return out;
}

void Scenario::visit(ParamVisitor& v) {
  v.choice("kind", kind, {"localization", "world"}, "what the scenario is about");
  v.integer("seed", seed, {0, 2e9}, "of the random numbers");
  if (kind == "world")
    world.visit(v);
  else
    localization.visit(v);
}

void Scenario::check() const {
  if (kind == "world")
    world.check();
  else
    localization.check();
}

Scenario Scenario::read(const std::string& file) {
  Scenario out;
  checkKind(textOf(file), file);
  readYaml(file, [&](ParamVisitor& v) { out.visit(v); });
  return out;
}

WorldScenario readWorldScenario(const std::string& file) {
  Scenario out;
  out.kind = "world";
  readYaml(file, [&](ParamVisitor& v) { out.visit(v); });
  if (out.kind != "world") throw ConfigError(file + ": kind = " + out.kind + ": is no world");
  return std::move(out.world);
}

}  // namespace sidestep
