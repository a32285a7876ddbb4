// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/window/window_planner.h"

#include <array>
#include <optional>

#include "core/geometry.h"
#include "core/kinematics.h"
#include "planning/velocity/hrvo_sight.h"
#include "planning/window/clearance_scorer.h"
#include "planning/window/heading_scorer.h"
#include "planning/window/hrvo_heading_scorer.h"
#include "planning/window/hrvo_speed_scorer.h"
#include "planning/window/speed_scorer.h"
#include "planning/window/surroundings.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

/// So many of the best pairs are looked at for a safe place to stop; after that only the slowest ones.
constexpr int kMostFailures = 30;

struct WeightedScorer {
  double weight;
  std::unique_ptr<Scorer> scorer;
};

/// The engine; DWA and EDWA differ in a scorer and in having an adviser.
class WindowPlanner final : public LocalPlanner {
 public:
  WindowPlanner(const WindowParams& params, std::unique_ptr<Scorer> heading, std::unique_ptr<Scorer> speed)
      : params_(params) {
    scorers_[0] = {params.heading_weight, std::move(heading)};
    scorers_[1] = {params.clearance_weight, std::make_unique<ClearanceScorer>()};
    scorers_[2] = {params.speed_weight, std::move(speed)};
  }
  void adviseBy(const HrvoParams& hrvo) { adviser_ = std::make_unique<HrvoSight>(hrvo); }
  void reset() override {}

  void plan(const PlanInput& input, PlanOutput& out) override {
    beginOutput(out);
    if (answeredAtDoor(input, params_.goal, out)) return;
    surroundings_.look(input, params_.look_ahead_s, params_.step_s, params_.margin_m, params_.moving == "predicted",
                       params_.sigmas);
    takeView(input);
    sampleWindow(input);
    const Rollout& best = choose(input);
    order(input, best, out);
    if (explain_) explainRollouts(input, best, out);
  }

 private:
  /// Goal and adviser, in the robot's frame.
  void takeView(const PlanInput& input) {
    const TPoint2D target = targetPoint(input, params_.goal.lookahead_m);
    const double c = std::cos(input.pose.phi), s = std::sin(input.pose.phi);
    const double dx = target.x - input.pose.x, dy = target.y - input.pose.y;
    view_ = {c * dx + s * dy, -s * dx + c * dy, input.limits.v_max, params_.look_ahead_s, 0, 0};
    if (!adviser_) return;
    const auto advice = adviser_->velocity(input, target, input.limits.v_max);
    view_.adviser_speed = advice.velocity.norm();
    const double still = 1e-3 * input.limits.v_max;  // a velocity of nearly nothing has no direction: the goal's
    const double heading = view_.adviser_speed > still ? std::atan2(advice.velocity.y, advice.velocity.x)
                                                       : std::atan2(target.y - input.pose.y, target.x - input.pose.x);
    view_.adviser_heading = wrapped(heading - input.pose.phi);
  }

  /// V_s and V_d, (2.23) and (2.25), each pair followed and scored.
  void sampleWindow(const PlanInput& input) {
    auto reach = reachableTwists(input);
    reach.v_high = std::max(reach.v_low, std::min(reach.v_high, goalSpeed(input)));
    rollouts_.clear();
    for (int j = 0; j < params_.w_samples; ++j) {
      const double w = sample(reach.w_low, reach.w_high, j, params_.w_samples);
      unitArc(w);
      for (int i = 0; i < params_.v_samples; ++i) {
        Rollout r;
        r.v = sample(reach.v_low, reach.v_high, i, params_.v_samples);
        r.w = w;
        const bool slowest = i == 0 && j == params_.w_samples / 2;  // stays, so that there is always one
        if (outerWheelSpeed(r.v, w, input.limits.track_m) > input.limits.wheel_speed_max && !slowest) continue;
        surroundings_.follow(unit_x_, unit_y_, r);
        r.stops = r.admissible = admissible(input, r);
        for (const auto& s : scorers_) r.total += s.weight * (1 - s.scorer->score(r, view_));
        rollouts_.push_back(r);
      }
    }
  }

  static double sample(double low, double high, int i, int n) {
    return n > 1 ? low + (high - low) * i / (n - 1) : 0.5 * (low + high);
  }

  void unitArc(double w) {
    unit_x_.resize(static_cast<size_t>(surroundings_.steps()) + 1);
    unit_y_.resize(unit_x_.size());
    for (size_t k = 0; k < unit_x_.size(); ++k) {
      const double t = static_cast<double>(k) * surroundings_.step();
      const auto p = arcFromOrigin(t, w * t);
      unit_x_[k] = p.x;
      unit_y_[k] = p.y;
    }
  }

  /// V_a (2.24): after this period there is still way enough to stop, straight and in turning.
  bool admissible(const PlanInput& input, const Rollout& r) const {
    if (!(r.free_s < params_.look_ahead_s)) return true;
    const double left_s = std::max(0.0, r.free_s - input.period_s);
    return r.v * r.v <= 2 * input.limits.brake * r.v * left_s &&
           std::abs(r.w) <= 2 * input.limits.turn_accel * left_s + 1e-9;
  }

  /// V_r (2.22) and the best of it; if it is empty, what stays free longest, and the slowest of that.
  const Rollout& choose(const PlanInput& input) {
    by_total_.clear();
    double slowest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < rollouts_.size(); ++i) {
      if (rollouts_[i].admissible) by_total_.push_back(i);
      slowest = std::min(slowest, rollouts_[i].v);
    }
    std::sort(by_total_.begin(), by_total_.end(), [this](size_t a, size_t b) {
      return rollouts_[a].total != rollouts_[b].total ? rollouts_[a].total < rollouts_[b].total : a < b;
    });
    int failed = 0;
    for (const size_t i : by_total_) {
      Rollout& r = rollouts_[i];
      r.admissible = leavesSafePlace(input, r, failed < kMostFailures || r.v <= slowest);
      if (r.admissible) return r;
      ++failed;
    }
    return *std::max_element(rollouts_.begin(), rollouts_.end(), [](const Rollout& a, const Rollout& b) {
      return a.free_s != b.free_s ? a.free_s < b.free_s : a.v != b.v ? a.v > b.v : a.total > b.total;
    });
  }

  /// That the robot can stop before it touches somebody who moves is not enough: it must also be able to stand there.
  /// So a pair that touches something within the look-ahead is admissible only if braking after this period leaves the
  /// robot where nobody comes; then there is such a way out in the next period too.
  /// @param look  false: it is taken to leave none
  bool leavesSafePlace(const PlanInput& input, const Rollout& r, bool look) {
    if (!(r.free_s < params_.look_ahead_s)) return true;
    if (!look) return false;
    unitArc(r.w);
    return surroundings_.canStop(unit_x_, unit_y_, r, input.period_s, input.limits.brake);
  }

  void order(const PlanInput& input, const Rollout& best, PlanOutput& out) const {
    out.status = PlanOutput::Status::kMoving;
    out.command = {best.v, 0, best.w};
    for (const auto& s : scorers_)
      out.costs.emplace_back(s.scorer->name(), s.weight * (1 - s.scorer->score(best, view_)));
    trajectory(input, best, out.trajectory);
    if (best.admissible) return;
    out.status = PlanOutput::Status::kBraking;
    out.reason =
        "no velocity from which the robot can stop in time and in a safe place: the one that stays free longest";
  }

  void trajectory(const PlanInput& input, const Rollout& r, std::vector<TrajectoryPoint>& out) const {
    const double c = std::cos(input.pose.phi), s = std::sin(input.pose.phi);
    for (int k = 0; k <= surroundings_.steps(); ++k) {
      const double t = k * surroundings_.step();
      const auto p = arcFromOrigin(r.v * t, r.w * t);
      out.push_back(
          {t, {input.pose.x + c * p.x - s * p.y, input.pose.y + s * p.x + c * p.y, input.pose.phi + p.phi}, r.v, r.w});
    }
  }

  void explainRollouts(const PlanInput& input, const Rollout& best, PlanOutput& out) const {
    for (const auto& r : rollouts_) {
      PlanCandidate shown;
      trajectory(input, r, shown.trajectory);
      for (const auto& s : scorers_)
        shown.costs.emplace_back(s.scorer->name(), s.weight * (1 - s.scorer->score(r, view_)));
      shown.total = r.total;
      if (&r != &best) shown.rejected = whyNot(r, best);
      out.candidates.push_back(std::move(shown));
    }
  }

  static std::string whyNot(const Rollout& r, const Rollout& best) {
    if (r.admissible) return "costs more";
    if (!best.admissible && r.free_s == best.free_s) return "touches as early, and is faster or costs more";
    const std::string what = r.touched < 0 ? "a static obstacle" : "moving obstacle " + std::to_string(r.touched);
    const char* how = r.stops ? "leaves no safe place to stop before " : "cannot stop before ";
    return how + what + ", which it touches after " + shortestNumber(r.free_s) + " s";
  }

  WindowParams params_;
  std::array<WeightedScorer, 3> scorers_;
  std::unique_ptr<HrvoSight> adviser_;
  Surroundings surroundings_;
  ScoringView view_;
  std::vector<double> unit_x_, unit_y_;
  std::vector<Rollout> rollouts_;
  std::vector<size_t> by_total_;
};

}  // namespace

void WindowParams::visit(ParamVisitor& v) {
  v.section("goal", "when the goal is reached", [&](ParamVisitor& s) { goal.visit(s); });
  v.integer("v_samples", v_samples, {1, 1001}, "speeds in the window");
  v.integer("w_samples", w_samples, {1, 1001}, "turn rates in the window");
  v.number("look_ahead_s", look_ahead_s, {0.1, 60}, "s", "length of the rollouts");
  v.number("step_s", step_s, {0.01, 10}, "s", "their steps");
  v.number("heading_weight", heading_weight, {0, 1e6}, "", "alpha of (2.26)");
  v.number("clearance_weight", clearance_weight, {0, 1e6}, "", "beta of (2.26)");
  v.number("speed_weight", speed_weight, {0, 1e6}, "", "gamma of (2.26)");
  v.number("heading_after_s", heading_after_s, {0, 60}, "s", "the heading that counts is that after this long");
  v.number("margin_m", margin_m, {0, 10}, "m", "kept free around each obstacle");
  v.number("sigmas", sigmas, {0, 10}, "sd", "moving obstacles grow by this many sd of their position");
  v.choice("moving", moving, {"predicted", "still"}, "moving obstacles go on, or stand still as in the dissertation");
}

void EdwaParams::visit(ParamVisitor& v) {
  v.section("window", "the dynamic window", [&](ParamVisitor& s) { window.visit(s); });
  v.section("hrvo", "the velocity obstacles that advise it", [&](ParamVisitor& s) { hrvo.visit(s); });
  v.choice("heading", heading, {"printed", "aligned"},
           "what is compared with the HRVO direction, see HrvoHeadingScorer");
  v.choice("speed", speed, {"largest", "advised"}, "what vel(v, w) rewards: speed, or that of the HRVO velocity");
}

std::unique_ptr<LocalPlanner> makeDwa(const WindowParams& params) {
  return std::make_unique<WindowPlanner>(params, std::make_unique<HeadingScorer>(params.heading_after_s),
                                         std::make_unique<SpeedScorer>());
}

std::unique_ptr<LocalPlanner> makeEdwa(const EdwaParams& params) {
  std::unique_ptr<Scorer> speed = std::make_unique<SpeedScorer>();
  if (params.speed == "advised") speed = std::make_unique<HrvoSpeedScorer>();
  auto heading = std::make_unique<HrvoHeadingScorer>(params.window.heading_after_s, params.heading == "printed");
  auto planner = std::make_unique<WindowPlanner>(params.window, std::move(heading), std::move(speed));
  planner->adviseBy(params.hrvo);
  return planner;
}

}  // namespace sidestep
