// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/velocity/hrvo_planner.h"

#include <algorithm>

#include "core/geometry.h"
#include "core/kinematics.h"
#include "planning/velocity/drive_conversion.h"
#include "planning/velocity/hrvo_sight.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr double kShown_s = 2, kShownStep_s = 0.1;  // length of the trajectories that are shown

class HrvoPlanner final : public LocalPlanner {
 public:
  explicit HrvoPlanner(const HrvoPlannerParams& params) : params_(params), sight_(params.hrvo) {}
  void reset() override {}

  void plan(const PlanInput& input, PlanOutput& out) override {
    beginOutput(out);
    if (answeredAtDoor(input, params_.goal, out)) return;
    const auto answer = sight_.velocity(input, targetPoint(input, params_.goal.lookahead_m), goalSpeed(input));
    command(input, answer, out);
    showArc(input, out);
    out.costs.emplace_back("detour", answer.distance);
    if (answer.penetration > 0)
      out.reason = "no velocity keeps clear: the least penetration";
    else if (answer.horizon_share < 1)
      out.reason = "every velocity meets something within the horizon: the latest collision";
    if (explain_) explainAnswer(input, answer, out);
  }

 private:
  void command(const PlanInput& input, const HrvoAnswer& answer, PlanOutput& out) const {
    const auto reach = reachableTwists(input);
    const auto wish =
        driveFor(answer.velocity, input.pose.phi, params_.align_s, input.limits.v_max, input.limits.w_max);
    out.status = PlanOutput::Status::kMoving;
    out.command.vx = std::clamp(wish.vx, reach.v_low, reach.v_high);
    out.command.omega = std::clamp(wish.omega, reach.w_low, reach.w_high);
    const double rim = outerWheelSpeed(out.command.vx, out.command.omega, input.limits.track_m);
    if (rim > input.limits.wheel_speed_max) out.command *= input.limits.wheel_speed_max / rim;
  }

  static void showArc(const PlanInput& input, PlanOutput& out) {
    const double v = out.command.vx, w = out.command.omega;
    for (double t = 0; t <= kShown_s; t += kShownStep_s) {
      out.trajectory.push_back({t, alongArc(input.pose, v * t, w * t), v, w});
    }
  }

  void explainAnswer(const PlanInput& input, const HrvoAnswer& answer, PlanOutput& out) {
    sight_.model().candidates(candidates_);
    candidates_.push_back({answer.velocity, answer.distance, -1});
    for (const auto& c : candidates_) {
      const bool chosen = &c == &candidates_.back();
      PlanCandidate shown;
      for (double t = 0; t <= kShown_s; t += kShownStep_s)
        shown.trajectory.push_back(
            {t,
             {input.pose.x + c.velocity.x * t, input.pose.y + c.velocity.y * t, std::atan2(c.velocity.y, c.velocity.x)},
             c.velocity.norm(),
             0});
      shown.costs.emplace_back("detour", c.distance);
      shown.total = c.distance;
      if (!chosen) shown.rejected = "on the edge of " + sight_.model().regionName(c.region) + ", farther from the wish";
      out.candidates.push_back(std::move(shown));
    }
  }

  HrvoPlannerParams params_;
  HrvoSight sight_;
  std::vector<VelocityCandidate> candidates_;
};

}  // namespace

void HrvoPlannerParams::visit(ParamVisitor& v) {
  v.section("goal", "when the goal is reached", [&](ParamVisitor& s) { goal.visit(s); });
  v.section("hrvo", "velocity obstacles", [&](ParamVisitor& s) { hrvo.visit(s); });
  v.number("align_s", align_s, {0.05, 20}, "s", "time in which the robot turns into the velocity's direction");
}

std::unique_ptr<LocalPlanner> makeHrvoPlanner(const HrvoPlannerParams& params) {
  return std::make_unique<HrvoPlanner>(params);
}

}  // namespace sidestep
