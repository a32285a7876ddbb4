// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/world_params.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"

namespace sidestep {

void RouteParams::visit(ParamVisitor& v) {
  v.number("length_m", length_m, {0, 1e5}, "m", "between start and goal; 0: both as given, not drawn");
  v.number("x_low_m", x_low_m, {-1e5, 1e5}, "m", "both lie within this rectangle");
  v.number("x_high_m", x_high_m, {-1e5, 1e5}, "m", "both lie within this rectangle");
  v.number("y_low_m", y_low_m, {-1e5, 1e5}, "m", "both lie within this rectangle");
  v.number("y_high_m", y_high_m, {-1e5, 1e5}, "m", "both lie within this rectangle");
  v.number("clear_m", clear_m, {0, 100}, "m", "no wall so near to start and goal, nobody so near to the start");
  v.number("clear_s", clear_s, {0, 100}, "s", "nor so near to the start within this time, going straight on");
}

void RobotParams::visit(ParamVisitor& v) {
  v.number("x_m", x_m, {-1e5, 1e5}, "m", "start");
  v.number("y_m", y_m, {-1e5, 1e5}, "m", "start");
  v.angle("yaw_deg", yaw, {-360, 360}, "start");
  v.number("start_shift_m", start_shift_m, {0, 1e5}, "m", "start: at random within so much in x and y");
  v.angle("start_turn_deg", start_turn, {0, 180}, "start: heading at random within so much to either side");
  v.number("start_speed", start_speed, {-50, 50}, "m/s", "speed at the start");
  v.number("goal_x_m", goal_x_m, {-1e5, 1e5}, "m", "goal");
  v.number("goal_y_m", goal_y_m, {-1e5, 1e5}, "m", "goal");
  v.number("goal_tolerance_m", goal_tolerance_m, {0.001, 100}, "m", "so near, the goal is reached");
  v.table("goals", {"x", "y"}, goals, "goals to reach one after the other, instead of goal_x_m, goal_y_m [m]");
  v.section("route", "start and goal at random", [this](ParamVisitor& w) { route.visit(w); });
  v.text("planner", planner, "who drives: straight (turns to the goal and goes), stand, or a local planner");
  v.flag("sees_robot", sees_robot, "false: drives as if the robot under test were not there");
  v.section("limits", "what the base can do", [this](ParamVisitor& w) { limits.visit(w); });
  v.section("drive", "how the base answers to commands", [this](ParamVisitor& w) { drive.visit(w); });
  v.section("perception", "whom it perceives", [this](ParamVisitor& w) { perception.visit(w); });
}

void WallParams::visit(ParamVisitor& v) {
  v.table("points", {"x", "y"}, points, "corners [m]");
  v.flag("closed", closed, "the last corner joins the first");
}

std::vector<Segment> WallParams::segments() const {
  const auto corner = [&](size_t i) { return mrpt::math::TPoint2D(points[i][0], points[i][1]); };
  std::vector<Segment> out;
  for (size_t i = 0; i + 1 < points.size(); ++i) out.push_back({corner(i), corner(i + 1)});
  if (closed) out.push_back({corner(points.size() - 1), corner(0)});
  return out;
}

WorldParams::WorldParams() {
  encoders.v_sd = encoders.w_sd = 0;
  imu.rate_hz = 0;
  gps.rate_hz = 0;
}

void WorldParams::visit(ParamVisitor& v) {
  v.number("step_s", step_s, {1e-4, 0.1}, "s", "of the simulation: motion, contacts, clearance");
  v.number("control_period_s", control_period_s, {1e-4, 2}, "s",
           "between two commands to a robot; a whole number of steps");
  v.number("duration_s", duration_s, {0.01, 1e5}, "s",
           "the run ends then, if the robot under test has not arrived before");
  v.number("people_record_hz", people_record_hz, {0, 1000}, "Hz", "how often people are written to the log; 0: never");
  v.text("map", map,
         "walls from a map (ROS map.yaml, MRPT .gridmap, .simplemap), as seen from here or from the scenario; empty: "
         "none");
  v.text("tracks", tracks, "recorded people, a CSV of t,id,x,y; empty: none");
  v.number("tracks_from_s", tracks_from_s, {-1e9, 1e9}, "s", "time of that file at which the run begins");
  v.number("tracks_shift_s", tracks_shift_s, {0, 1e9}, "s", "the run begins up to so much later, at random");
  v.groups("walls", wall_names, "walls, by name",
           [this](const std::string& name, ParamVisitor& w) { walls[name].visit(w); });
  v.groups("robots", robot_names, "robots, by name",
           [this](const std::string& name, ParamVisitor& w) { robots[name].visit(w); });
  v.text("under_test", under_test, "name of the robot that the run is about; empty: the first");
  v.groups("people", people_names, "people, by name of a person or a crowd",
           [this](const std::string& name, ParamVisitor& w) { people[name].visit(w); });
  v.section("social_force", "(Helbing & Molnar 1995)", [this](ParamVisitor& w) { social_force.visit(w); });
  v.section("encoders", "of the robot under test", [this](ParamVisitor& w) { encoders.visit(w); });
  v.section("imu", "of the robot under test", [this](ParamVisitor& w) { imu.visit(w); });
  v.section("gps", "of the robot under test", [this](ParamVisitor& w) { gps.visit(w); });
  v.section("laser", "of the robot under test", [this](ParamVisitor& w) { laser.visit(w); });
}

void WorldParams::check() const {
  const double steps = control_period_s / step_s;
  if (steps < 1 - 1e-9 || std::abs(steps - std::round(steps)) > 1e-6)
    throw ConfigError("control_period_s = " + shortestNumber(control_period_s) +
                      " s: is no whole number of step_s = " + shortestNumber(step_s) + " s");
  if (robot_names.empty()) throw ConfigError("robots: there is none; name at least one");
  if (!under_test.empty() && std::find(robot_names.begin(), robot_names.end(), under_test) == robot_names.end()) {
    const auto near = nearestWord(under_test, robot_names);
    throw ConfigError("under_test = " + under_test + ": is no robot" +
                      (near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
  for (const auto& name : wall_names)
    if (walls.at(name).points.size() < 2) throw ConfigError("walls." + name + ".points: has fewer than two corners");
  for (const auto& name : robot_names) {
    const RouteParams& r = robots.at(name).route;
    if (r.length_m > 0 && !(std::hypot(r.x_high_m - r.x_low_m, r.y_high_m - r.y_low_m) > r.length_m &&
                            r.x_high_m >= r.x_low_m && r.y_high_m >= r.y_low_m))
      throw ConfigError("robots." + name + ".route.length_m = " + shortestNumber(r.length_m) +
                        " m: does not fit into the rectangle x_low_m .. x_high_m, y_low_m .. y_high_m");
  }
  for (const auto& [rate, key] : {std::pair{imu.rate_hz, "imu"}, {gps.rate_hz, "gps"}, {laser.rate_hz, "laser"}})
    if (rate * step_s > 1 + 1e-6)
      throw ConfigError(std::string(key) + ".rate_hz: faster than one reading a step; make step_s shorter");
}

size_t WorldParams::underTest() const {
  const auto it = std::find(robot_names.begin(), robot_names.end(), under_test);
  return it == robot_names.end() ? 0 : static_cast<size_t>(it - robot_names.begin());
}

}  // namespace sidestep
