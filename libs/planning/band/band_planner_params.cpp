// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/errors.h"
#include "planning/band/band_planner.h"

namespace sidestep {

void BandViewParams::visit(ParamVisitor& v) {
  v.choice(
      "obstacles", obstacles, {"now", "as_printed", "in_time"},
      "moving obstacles: where they are; beside that one predicted position; where they will be at each pose's time");
  v.number("predicted_after_s", predicted_after_s, {0, 60}, "s", "as_printed: when the one predicted position is");
  v.number("prediction_horizon_s", prediction_horizon_s, {0.5, 120}, "s", "in_time: beyond it nothing is predicted");
  v.number("sigmas", sigmas, {0, 10}, "-", "in_time: standard deviations that widen an obstacle");
  v.number("widening_max_m", widening_max_m, {0, 5}, "m", "in_time: most by which an obstacle is widened");
  v.flag("heading_of_hrvo", heading_of_hrvo, "classes pay for leaving the direction of the HRVO model (4.10)");
}

MovingView BandViewParams::movingView() const {
  using Kind = MovingView::Kind;
  MovingView out;
  out.kind = obstacles == "in_time" ? Kind::kInTime : obstacles == "as_printed" ? Kind::kNowAndOne : Kind::kNow;
  out.one_after_s = predicted_after_s;
  out.horizon_s = prediction_horizon_s;
  out.sigmas = sigmas;
  out.widening_max_m = widening_max_m;
  return out;
}

void FootprintParams::visit(ParamVisitor& v) {
  v.number("length_m", length_m, {0, 10}, "m", "of the rectangle; 0: the robot is a disc");
  v.number("width_m", width_m, {0, 10}, "m", "of the rectangle");
  v.number("ahead_m", ahead_m, {-5, 5}, "m", "of the rectangle's middle, from the middle between the wheels");
}

void SelectionParams::visit(ParamVisitor& v) {
  v.number("hysteresis", hysteresis, {0, 0.9}, "-", "share by which a class must be cheaper than the last choice");
  v.number("clearance_share", clearance_share, {0, 10}, "-", "share of the clearance cost that counts in the choice");
  v.number("delta_hrvo", delta_hrvo, {0, 1e3}, "1/rad", "weight of the angle to the HRVO direction (4.10)");
  v.flag("hrvo_speed", hrvo_speed, "pteb, but not pteb+eteb: drive no faster than the HRVO velocity is long");
  v.number("goal_tolerance_m", goal_tolerance_m, {0.01, 5}, "m", "distance at which the goal is reached");
  v.angle("goal_tolerance_deg", goal_tolerance_rad, {0.1, 180}, "heading at which it is, where that matters");
  v.number("horizon_m", horizon_m, {1, 100}, "m", "length of a band along a global path");
  v.number("oscillation_s", oscillation_s, {0.5, 60}, "s", "time in which changes of mind are counted");
}

void BandPlannerParams::visit(ParamVisitor& v) {
  v.section("weights", "weights of the band's cost terms", [this](ParamVisitor& s) { weights.visit(s); });
  v.section("band", "the band and its optimizer", [this](ParamVisitor& s) { band.visit(s); });
  v.section("exploration", "search for classes", [this](ParamVisitor& s) { exploration.visit(s); });
  v.section("view", "how moving obstacles are seen", [this](ParamVisitor& s) { view.visit(s); });
  v.section("selection", "choice among the classes", [this](ParamVisitor& s) { selection.visit(s); });
  v.section("check", "what must be clear before a command leaves", [this](ParamVisitor& s) { check.visit(s); });
  v.section("evasion", "what is done when somebody comes and no band is clear",
            [this](ParamVisitor& s) { evasion.visit(s); });
  v.section("footprint", "a robot longer than wide", [this](ParamVisitor& s) { footprint.visit(s); });
  v.section("hrvo", "the HRVO model of pteb", [this](ParamVisitor& s) { hrvo.visit(s); });
}

const std::vector<std::string>& bandPlannerNames() {
  static const std::vector<std::string> names = {"teb", "pteb", "eteb", "eteb-printed", "pteb+eteb"};
  return names;
}

BandPlannerParams bandPlannerParams(const std::string& planner) {
  BandPlannerParams out;
  if (planner == "eteb" || planner == "pteb+eteb") out.view.obstacles = "in_time";
  if (planner == "eteb-printed") out.view.obstacles = "as_printed";
  out.view.heading_of_hrvo = planner == "pteb" || planner == "pteb+eteb";
  const auto& names = bandPlannerNames();
  if (std::find(names.begin(), names.end(), planner) == names.end())
    throw ConfigError("no band planner '" + planner + "'; did you mean '" + nearestWord(planner, names) + "'?");
  return out;
}

std::unique_ptr<LocalPlanner> makeBandPlanner(BandPlannerParams params, const std::string& planner) {
  const auto view = bandPlannerParams(planner).view;
  params.view.obstacles = view.obstacles;
  params.view.heading_of_hrvo = view.heading_of_hrvo;
  return std::make_unique<BandPlanner>(params);
}

}  // namespace sidestep
