// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/trajectory_check.h"

#include <algorithm>
#include <cmath>

#include "core/kinematics.h"

namespace sidestep {
namespace {

/// The nearest edge to the robot's own at a pose, uncertainty left out.
struct Nearest {
  double clearance = 1e9;
  int obstacle = -1;
};

Nearest nearestTo(double x, double y, double theta, double t, const Footprint& robot, const ObstacleView& obstacles) {
  constexpr double kWidest_m = 0.2;  // farther than this nobody asks
  Nearest out;
  const double c = robot.isDisc() ? 0 : std::cos(theta), s = robot.isDisc() ? 0 : std::sin(theta);
  for (int i = 0; i < robot.discs; ++i) {
    const double ahead = robot.along(i);
    obstacles.near(x + ahead * c, y + ahead * s, t, robot.radius_m + kWidest_m, [&](const Proximity& p) {
      const double clearance = p.distance + p.widening - robot.radius_m;
      if (clearance < out.clearance) out = {clearance, p.id};
    });
  }
  return out;
}

void note(const Nearest& nearest, double t, double allowed, CheckResult& out) {
  out.least_m = std::min(out.least_m, nearest.clearance);
  if (!out.clear || nearest.clearance >= allowed) return;
  out.clear = false;
  out.contact_s = t;
  out.obstacle = nearest.obstacle;
}

/// One step of an arc at constant speeds.
void drive(TrajectoryPoint& p, double dt) {
  p.pose = alongChord(p.pose, p.v * dt, p.w * dt);
  p.after_s += dt;
}

}  // namespace

void CheckParams::visit(ParamVisitor& v) {
  v.number("ahead_s", ahead_s, {0.1, 10}, "s", "part of the trajectory that is checked before a command leaves");
  v.number("step_s", step_s, {0.01, 1}, "s", "time between the poses that are checked");
}

CheckResult checkStart(const Band& band, const BandEnds& ends, const RobotLimits& limits, const Footprint& robot,
                       const ObstacleView& obstacles, const CheckParams& params, std::vector<TrajectoryPoint>& driven) {
  CheckResult out;
  driven.clear();
  TrajectoryPoint p{0, {band.front().x, band.front().y, band.front().theta}, ends.v, ends.w};
  const double start = nearestTo(p.pose.x, p.pose.y, p.pose.phi, 0, robot, obstacles).clearance;
  const double allowed = std::min(start, 0.0) - 1e-6;
  driven.push_back(p);
  const int steps = static_cast<int>(std::ceil(params.ahead_s / params.step_s));
  for (int k = 0; k < steps && out.clear; ++k) {
    const auto speed = speedAt(band, ends, (k + 0.5) * params.step_s);
    p.v = speed.v;
    p.w = speed.w;
    drive(p, params.step_s);
    driven.push_back(p);
    note(nearestTo(p.pose.x, p.pose.y, p.pose.phi, p.after_s, robot, obstacles), p.after_s, allowed, out);
  }
  const double bend = std::abs(p.v) > 0.05 ? p.w / p.v : 0;
  while (out.clear && std::abs(p.v) > 1e-3) {
    p.v = std::copysign(std::max(std::abs(p.v) - limits.brake * params.step_s, 0.0), p.v);
    p.w = std::clamp(bend * p.v, -limits.w_max, limits.w_max);
    drive(p, params.step_s);
    note(nearestTo(p.pose.x, p.pose.y, p.pose.phi, -1, robot, obstacles), p.after_s, allowed, out);
  }
  return out;
}

CheckResult checkWhole(const Band& band, const Footprint& robot, const ObstacleView& obstacles) {
  constexpr int kPartsLeast = 3;
  constexpr double kStep_s = 0.1;       // between looks, where something moves
  constexpr double kBetween_m = 0.015;  // what chords and coarse steps may hide
  CheckResult out;
  for (size_t k = 0; k + 1 < band.size(); ++k) {
    const BandPose& a = band[k];
    const BandPose& b = band[k + 1];
    const int parts = obstacles.movesInTime() ? std::clamp(static_cast<int>((b.t - a.t) / kStep_s) + 1, kPartsLeast, 20)
                                              : kPartsLeast;
    const bool turns = !robot.isDisc() && std::abs(b.theta - a.theta) > 0.02;
    const bool short_way = std::abs(b.x - a.x) + std::abs(b.y - a.y) < 0.02 && !turns && !obstacles.movesInTime();
    for (int i = 1; i <= parts; ++i) {
      if (short_way && i < parts) continue;
      const double share = static_cast<double>(i) / parts, t = a.t + share * (b.t - a.t);
      const double x = a.x + share * (b.x - a.x), y = a.y + share * (b.y - a.y);
      const double theta = a.theta + share * (b.theta - a.theta);
      note(nearestTo(x, y, theta, t, robot, obstacles), t, kBetween_m, out);
    }
  }
  return out;
}

}  // namespace sidestep
