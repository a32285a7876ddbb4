// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/simple_planners.h"

#include <algorithm>
#include <cmath>

#include "planning/goal_approach.h"

namespace sidestep {
namespace {

class Stand final : public LocalPlanner {
 public:
  void reset() override {}
  void plan(const PlanInput& input, PlanOutput& out) override {
    beginOutput(out);
    if (!refusesInput(input, out)) out.status = PlanOutput::Status::kBraking;
  }
};

class Straight final : public LocalPlanner {
 public:
  void reset() override {}
  void plan(const PlanInput& input, PlanOutput& out) override {
    constexpr double kThere_m = 0.1, kFacing_rad = 0.5;
    beginOutput(out);
    if (refusesInput(input, out)) return;
    const auto& limits = input.limits;
    const double dx = input.goal.x - input.pose.x, dy = input.goal.y - input.pose.y, distance = std::hypot(dx, dy);
    const double turn = std::remainder(std::atan2(dy, dx) - input.pose.phi, 2 * M_PI);
    const double w = std::copysign(std::min(limits.w_max, std::sqrt(limits.turn_accel * std::abs(turn))), turn);
    const double v = std::min(limits.v_max, std::sqrt(2 * 0.8 * limits.brake * distance));
    out.command = {std::abs(turn) > kFacing_rad ? 0 : v, 0, distance > kThere_m ? w : 0};
    out.status = distance > kThere_m ? PlanOutput::Status::kMoving : PlanOutput::Status::kGoalReached;
  }
};

}  // namespace

std::unique_ptr<LocalPlanner> makeStraightPlanner() { return std::make_unique<Straight>(); }
std::unique_ptr<LocalPlanner> makeStandPlanner() { return std::make_unique<Stand>(); }

}  // namespace sidestep
