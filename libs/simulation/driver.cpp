// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/driver.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/params.h"

namespace sidestep {
namespace {

class Stand final : public Driver {
 public:
  mrpt::math::TTwist2D drive(const DriverView&) override { return {0, 0, 0}; }
};

class Straight final : public Driver {
 public:
  explicit Straight(const RobotLimits& limits) : limits_(limits) {}
  mrpt::math::TTwist2D drive(const DriverView& view) override {
    const double dx = view.goal.x - view.pose.x, dy = view.goal.y - view.pose.y, distance = std::hypot(dx, dy);
    const double turn = std::remainder(std::atan2(dy, dx) - view.pose.phi, 2 * M_PI);
    const double w = std::copysign(std::min(limits_.w_max, std::sqrt(limits_.turn_accel * std::abs(turn))), turn);
    const double v = std::min(limits_.v_max, std::sqrt(2 * 0.8 * limits_.brake * distance));
    return {std::abs(turn) > 0.5 ? 0 : v, 0, distance > 0.1 ? w : 0};
  }

 private:
  RobotLimits limits_;
};

}  // namespace

std::unique_ptr<Driver> makeSimpleDriver(const std::string& planner, const RobotLimits& limits) {
  if (planner == "straight") return std::make_unique<Straight>(limits);
  if (planner == "stand") return std::make_unique<Stand>();
  const auto near = nearestWord(planner, {"straight", "stand"});
  throw ConfigError("planner = " + planner + ": not known, allowed straight, stand" +
                    (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

}  // namespace sidestep
