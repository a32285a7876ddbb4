// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/band_planner.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "planning/command_limits.h"

namespace sidestep {
namespace {

using Status = PlanOutput::Status;
constexpr double kBeside_m = 3;       ///< of the plane around start and goal, beyond the graph's reach
constexpr double kStanding = 0.05;    ///< m/s; slower than that the HRVO model stands
constexpr double kContactCost = 1e3;  ///< of a band that touches something; later is cheaper

bool finite(const PlanInput& in) {
  const double sum = in.pose.x + in.pose.y + in.pose.phi + in.twist.vx + in.twist.omega + in.goal.x + in.goal.y +
                     in.goal.phi + in.time_s + in.period_s;
  return std::isfinite(sum) &&
         std::abs(in.pose.x) + std::abs(in.pose.y) + std::abs(in.goal.x) + std::abs(in.goal.y) < 1e8;
}

/// Notes a time in a short memory; @return whether the oldest of it lies within `window`
bool often(double (&times)[4], double now, double window) {
  for (int i = 0; i < 3; ++i) times[i] = times[i + 1];
  times[3] = now;
  return now - times[0] < window;
}

}  // namespace

BandPlanner::BandPlanner(const BandPlannerParams& params)
    : params_(params), graph_(params.exploration), evasion_(params.evasion), hrvo_(params.hrvo) {
  const auto n = static_cast<size_t>(params.exploration.classes_max);
  workers_.assign(n, Worker(params));
  pool_.resize(n);
  // bands change places; all have room for the longest
  const auto room = static_cast<size_t>(2 * params.band.poses_max);
  for (auto& c : pool_) c.band.reserve(room);
  for (auto& w : workers_) w.reserve(room);
  fresh_.reserve(room);
  passing_.band.reserve(room);
  timed_.resize(kTimedMost);
  for (auto& t : timed_) t.band.reserve(room);
  checked_.reserve(room);
}

void BandPlanner::reset() {
  for (auto& c : pool_) c.alive = c.chosen = false;
  checked_.clear();
  started_ = false;
  for (auto* times : {sign_changed_, class_changed_}) std::fill(times, times + 4, -1e9);
  last_turn_ = 0;
  steady_until_ = -1e9;
  rescue_again_ = -1e9;
  rescue_wait_s_ = 0.25;
}

const BandCandidate* BandPlanner::chosen() const {
  for (const auto& c : pool_)
    if (c.alive && c.chosen) return &c;
  return nullptr;
}

void BandPlanner::plan(const PlanInput& input, PlanOutput& out) {
  out.command = {};
  out.trajectory.clear();
  out.costs.clear();
  out.candidates.clear();
  out.reason.clear();
  if (answeredAtDoor(input, out)) return;
  look(input);
  advice_ = params_.view.heading_of_hrvo ? hrvoVelocity(input) : std::nullopt;
  carryOver(input);
  explore(input);
  optimizeAll(input);
  rescue(input);
  judge(input);
  choose(input, out);
  if (explain_) explainTo(out);
  last_time_ = input.time_s;
  last_goal_ = goal_.pose;
  started_ = true;
}

bool BandPlanner::answeredAtDoor(const PlanInput& input, PlanOutput& out) {
  if (!finite(input) || !(input.period_s > 0)) {
    out.reason = "pose, twist, goal or time is not finite";
    reset();
    brake(input, out);
    return true;
  }
  findLocalGoal(input, params_.selection.horizon_m, goal_);
  const bool near =
      std::hypot(input.goal.x - input.pose.x, input.goal.y - input.pose.y) < params_.selection.goal_tolerance_m;
  const bool turned =
      !input.goal_heading_matters ||
      std::abs(std::remainder(input.goal.phi - input.pose.phi, 2 * M_PI)) < params_.selection.goal_tolerance_rad;
  if (!near || !turned) return false;
  brake(input, out);
  out.status = Status::kGoalReached;
  return true;
}

/// What this plan sees: goal, frame, obstacles.
void BandPlanner::look(const PlanInput& input) {
  const auto& p = input.pose;
  const auto& g = goal_.pose;
  frame_ = GoalFrame(p.x, p.y, g.x, g.y);
  const double side = std::max(params_.exploration.detour_least_m, params_.exploration.detour_share * frame_.length);
  const double margin = side + kBeside_m;
  bounds_ = {std::min(p.x, g.x) - margin, std::min(p.y, g.y) - margin, std::max(p.x, g.x) + margin,
             std::max(p.y, g.y) + margin};
  problem_.robot = Footprint(params_.footprint, input.limits.radius_m);
  reach_m_ = problem_.robot.radius_m + std::max({params_.band.distance_m, params_.band.distance_moving_m, 0.25});
  view_.build({input.points, input.walls, input.moving, input.field}, params_.view.movingView(), bounds_, reach_m_);
  islands_.find(input.field, frame_, side, problem_.robot.radius_m);
  problem_.limits = input.limits;
  problem_.ends = {input.twist.vx, input.twist.omega, goal_.is_goal};
  problem_.goal_heading_free = goal_.heading_free;
  problem_.obstacles = &view_;
  problem_.via_points = goal_.way;
}

void BandPlanner::carryOver(const PlanInput& input) {
  const bool moved = started_ && std::hypot(goal_.pose.x - last_goal_.x, goal_.pose.y - last_goal_.y) > 1.0;
  const double elapsed = input.time_s - last_time_;
  const bool usable = started_ && !moved && elapsed >= 0 && elapsed < 1.0;
  for (auto& c : pool_) {
    c.fresh = false;
    c.rejected = "";
    c.alive = c.alive && usable && prune(input, elapsed, c);
    c.chosen = c.chosen && c.alive;
  }
}

bool BandPlanner::prune(const PlanInput& input, double elapsed, BandCandidate& c) {
  constexpr double kFar_m = 0.4, kLookAround_s = 0.3, kShortest_s = 0.4;
  const auto off = [&](double t) {
    const BandPose p = bandAt(c.band, t);
    return std::hypot(p.x - input.pose.x, p.y - input.pose.y);
  };
  double from = elapsed;
  for (double t = std::max(elapsed - kLookAround_s, 0.0); t < elapsed + kLookAround_s; t += 0.05)
    if (off(t) < off(from) - 0.01) from = t;
  const double left = c.band.back().t - from;
  if (off(from) > kFar_m || left < kShortest_s) return false;
  const int intervals =
      std::clamp(static_cast<int>(std::lround(left / params_.band.interval_s)), 3, params_.band.poses_max);
  Band& spare = workers_[0].spare;
  resample(c.band, from, intervals, spare);
  c.band.swap(spare);
  const double turn = nearestAngle(input.pose.phi, c.band.front().theta) - input.pose.phi;
  for (auto& p : c.band) p.theta -= turn;
  c.band.front() = {input.pose.x, input.pose.y, input.pose.phi, 0};
  c.band.back().x = goal_.pose.x;
  c.band.back().y = goal_.pose.y;
  if (!goal_.heading_free) c.band.back().theta = nearestAngle(goal_.pose.phi, c.band.back().theta);
  return true;
}

void BandPlanner::optimizeAll(const PlanInput& input) {
  const auto one = [&](int k) {
    const auto i = static_cast<size_t>(k);
    if (pool_[i].alive) optimizeOne(input, workers_[i], pool_[i]);
  };
  const int n = static_cast<int>(pool_.size());
  if (run_ && n > 1)
    run_(n, one);
  else
    for (int k = 0; k < n; ++k) one(k);
}

void BandPlanner::optimizeOne(const PlanInput& input, Worker& worker, BandCandidate& c) {
  c.ends = problem_.ends;
  c.result = worker.optimizer.optimize(problem_, !c.fresh, input.out_of_time, c.band);
  retime(c.band, input.limits, c.ends);
  c.shares = worker.optimizer.shares(problem_, c.band);
  tryQuickest(input, worker, c);
  examine(worker, c);
}

uint64_t BandPlanner::classOf(SignatureReader& reader, const Band& band) const {
  return reader.read(band, frame_, view_, params_.view.prediction_horizon_s, islands_.points());
}

void BandPlanner::examine(Worker& worker, BandCandidate& c) {
  c.whole = checkWhole(c.band, problem_.robot, view_);
  c.touching = c.whole.clear ? 0 : c.fresh ? 1 : c.touching + 1;
  c.signature = classOf(worker.signature, c.band);
}

/// The same poses in the shortest time, where that costs less: the optimizer finds its way back from a wait only
/// slowly.
void BandPlanner::tryQuickest(const PlanInput& input, Worker& worker, BandCandidate& c) {
  worker.spare = c.band;
  retime(worker.spare, input.limits, c.ends, Retiming::kQuickest);
  if (worker.spare.back().t > 0.995 * c.band.back().t) return;
  const auto sum = [](const auto& shares) { return std::accumulate(shares.begin(), shares.end(), 0.0); };
  const auto quick = worker.optimizer.shares(problem_, worker.spare);
  if (!(sum(quick) < sum(c.shares))) return;
  c.band.swap(worker.spare);
  c.shares = quick;
}

/// (2.40), (4.10): what each band costs.
void BandPlanner::judge(const PlanInput& input) {
  for (auto& c : pool_) {
    if (!c.alive) continue;
    c.heading = params_.selection.delta_hrvo * angleToAdvice(input, c);
    c.total = c.heading;
    for (double share : c.shares) c.total += share;
    c.total -= (1 - params_.selection.clearance_share) * c.shares[static_cast<size_t>(BandTerm::kClearance)];
    if (!c.whole.clear) c.total += kContactCost / (1 + c.whole.contact_s);
    if (c.result.diverged || !std::isfinite(c.total)) {
      c.rejected = "diverged";
      c.alive = c.chosen = false;
    }
  }
  dropTwins();
}

/// Of two bands that ended in one class the cheaper stays.
void BandPlanner::dropTwins() {
  const auto cost = [](const BandCandidate& c) { return c.result.cost; };
  for (size_t i = 0; i < pool_.size(); ++i)
    for (size_t k = i + 1; k < pool_.size(); ++k) {
      BandCandidate& a = pool_[i];
      BandCandidate& b = pool_[k];
      if (!a.alive || !b.alive || a.signature != b.signature) continue;
      BandCandidate& worse = (a.whole.clear == b.whole.clear ? cost(b) < cost(a) : b.whole.clear) ? a : b;
      (&worse == &a ? b : a).chosen = a.chosen || b.chosen;
      worse.alive = worse.chosen = false;
      worse.rejected = "the same class as another";
    }
}

/// (2.29): the velocity that the HRVO model would take on its way to the goal, or to a point ahead on the path.
std::optional<mrpt::math::TPoint2D> BandPlanner::hrvoVelocity(const PlanInput& input) {
  constexpr double kAhead_m = 2;
  const mrpt::math::TPoint2D at(input.pose.x, input.pose.y);
  mrpt::math::TPoint2D target(goal_.pose.x, goal_.pose.y);
  for (auto p = goal_.way.rbegin(); p != goal_.way.rend() && (*p - at).norm() > kAhead_m; ++p) target = *p;
  const double c = std::cos(input.pose.phi), s = std::sin(input.pose.phi);
  hrvo_.begin({c * input.twist.vx, s * input.twist.vx}, input.limits.radius_m, input.period_s);
  for (const auto& o : input.moving) hrvo_.disc(hrvo_.view(o, at));
  const double v = input.limits.v_max;
  const auto preferred = (target - at) * (v / std::max((target - at).norm(), 1e-6));  // (2.30)
  return hrvo_.solve(preferred, v).velocity;
}

/// (4.9) with (4.7) and (4.8); 0 where the model would stand.
double BandPlanner::angleToAdvice(const PlanInput& input, const BandCandidate& c) const {
  if (!advice_ || std::hypot(advice_->x, advice_->y) < kStanding) return 0;
  const double theta_p = std::atan2(c.beside.y - input.pose.y, c.beside.x - input.pose.x);
  return std::abs(std::remainder(std::atan2(advice_->y, advice_->x) - theta_p, 2 * M_PI));
}

/// The same curve, no faster than the model would go. A planner that sees people in time knows better when to slow
/// down.
mrpt::math::TTwist2D BandPlanner::slowedByAdvice(const TrajectorySpeed& wanted) const {
  if (!advice_ || !params_.selection.hrvo_speed || view_.movesInTime() || wanted.v <= 0) return {wanted.v, 0, wanted.w};
  const double v = std::min(wanted.v, std::hypot(advice_->x, advice_->y));
  return {v, 0, wanted.w * (wanted.v > kStanding ? v / wanted.v : 1)};
}

/// (2.39): the cheapest band, the last choice favoured, of those whose beginning is clear.
void BandPlanner::choose(const PlanInput& input, PlanOutput& out) {
  order_.clear();
  for (size_t k = 0; k < pool_.size(); ++k)
    if (pool_[k].alive) order_.push_back(k);
  const double keep =
      1 - (input.time_s < steady_until_ ? std::max(params_.selection.hysteresis, 0.5) : params_.selection.hysteresis);
  const auto compared = [&](size_t k) { return pool_[k].total * (pool_[k].chosen ? keep : 1); };
  std::sort(order_.begin(), order_.end(),
            [&](size_t a, size_t b) { return compared(a) != compared(b) ? compared(a) < compared(b) : a < b; });
  const BandCandidate* before = chosen();
  CheckResult first;
  for (size_t k : order_) {
    BandCandidate& c = pool_[k];
    const CheckResult check = checkStart(c.band, c.ends, input.limits, problem_.robot, view_, params_.check, driven_);
    if (!check.clear) {
      c.rejected = "its beginning touches something";
      if (first.clear) first = check;
      continue;
    }
    const bool changed = before != nullptr && before != &c;
    for (auto& other : pool_) other.chosen = &other == &c;
    if (changed && often(class_changed_, input.time_s, params_.selection.oscillation_s)) {
      out.reason = "oscillation: the class changed four times in a short while; keeping this one";
      steady_until_ = input.time_s + params_.selection.oscillation_s;
    }
    const bool soon = !c.whole.clear && c.whole.obstacle >= 0 && c.whole.contact_s < params_.evasion.before_s;
    if (view_.movesInTime() && soon && evade(input, true, out)) return;
    follow(input, c, out);
    return;
  }
  if (order_.empty()) {
    out.reason = "no band: all diverged or there is no way";
  } else {
    out.reason = "contact with ";
    out.reason += first.obstacle >= 0 ? "obstacle " + std::to_string(first.obstacle) : std::string("something static");
    out.reason += " in " + shortestNumber(std::round(first.contact_s * 100) / 100) + " s on every band";
    if (evade(input, false, out)) return;
  }
  brake(input, out);
}

void BandPlanner::follow(const PlanInput& input, BandCandidate& c, PlanOutput& out) {
  const auto speed = speedAt(c.band, c.ends, input.period_s);
  const auto slowed = slowedByAdvice(speed);
  out.command = allowedCommand(slowed.vx, slowed.omega, input.twist, input.limits, input.period_s);
  out.status = Status::kMoving;
  for (size_t k = 0; k < c.band.size(); ++k) {
    const auto& p = c.band[k];
    const auto at = k + 1 < c.band.size() ? intervalBetween(p, c.band[k + 1]) : Interval{};
    out.trajectory.push_back({p.t, {p.x, p.y, p.theta}, at.v, at.w});
  }
  for (int i = 0; i < kBandTerms; ++i)
    out.costs.emplace_back(bandTermName(static_cast<BandTerm>(i)), c.shares[static_cast<size_t>(i)]);
  if (params_.view.heading_of_hrvo) out.costs.emplace_back("hrvo_heading", c.heading);
  checked_ = c.band;
  checked_ends_ = c.ends;
  checked_time_ = input.time_s;
  watchOscillation(input, c, out);
}

void BandPlanner::watchOscillation(const PlanInput& input, const BandCandidate&, PlanOutput& out) {
  constexpr double kTurn = 0.1;  // rad/s that count
  if (std::abs(out.command.omega) < kTurn) return;
  const bool turned_round = out.command.omega * last_turn_ < 0;
  last_turn_ = out.command.omega;
  if (turned_round && often(sign_changed_, input.time_s, params_.selection.oscillation_s)) {
    if (out.reason.empty()) out.reason = "oscillation: the turning direction changed four times in a short while";
    steady_until_ = input.time_s + params_.selection.oscillation_s;
  }
}

/// Out of the way of somebody who would walk into a robot that stands; false if standing is as good.
bool BandPlanner::evade(const PlanInput& input, bool only_if_clear, PlanOutput& out) {
  const Evasion::Answer stand = evasion_.stand(input, view_);
  if (stand.clear() && !only_if_clear) return false;
  const Evasion::Answer best = evasion_.best(input, view_, {goal_.pose.x, goal_.pose.y});
  if (only_if_clear ? !best.clear() : !best.clear() && best.contact_s < stand.contact_s + 0.2) return false;
  out.command = allowedCommand(best.command.vx, best.command.omega, input.twist, input.limits, input.period_s);
  out.status = Status::kMoving;
  out.trajectory = evasion_.trajectory();
  out.reason += out.reason.empty() ? "evades somebody" : "; evades";
  return true;
}

/// Slows down on the curve of the last band that was clear.
void BandPlanner::brake(const PlanInput& input, PlanOutput& out) {
  const double v = std::isfinite(input.twist.vx) ? input.twist.vx : 0;
  const double w = std::isfinite(input.twist.omega) ? input.twist.omega : 0;
  const double slower = std::copysign(std::max(std::abs(v) - input.limits.brake * input.period_s, 0.0), v);
  double bend = std::abs(v) > 0.05 ? w / v : 0;
  if (checked_.size() > 1 && input.time_s - checked_time_ < 3) {
    const auto speed = speedAt(checked_, checked_ends_, input.time_s - checked_time_ + input.period_s);
    if (std::abs(speed.v) > 0.05) bend = speed.w / speed.v;
  }
  const double period = input.period_s > 0 && std::isfinite(input.period_s) ? input.period_s : 0.1;
  out.command = allowedCommand(slower, bend * slower, input.twist, input.limits, period);
  out.status = std::abs(slower) > 0 || std::abs(out.command.omega) > 0 ? Status::kBraking : Status::kNoPlan;
}

void BandPlanner::explainTo(PlanOutput& out) const {
  for (const auto& c : pool_) {
    if (!c.alive && *c.rejected == 0) continue;
    PlanCandidate& e = out.candidates.emplace_back();
    for (const auto& p : c.band) e.trajectory.push_back({p.t, {p.x, p.y, p.theta}, 0, 0});
    for (int i = 0; i < kBandTerms; ++i)
      e.costs.emplace_back(bandTermName(static_cast<BandTerm>(i)), c.shares[static_cast<size_t>(i)]);
    if (params_.view.heading_of_hrvo) e.costs.emplace_back("hrvo_heading", c.heading);
    e.costs[static_cast<size_t>(BandTerm::kClearance)].second *= params_.selection.clearance_share;
    e.costs.emplace_back("touches", c.whole.clear ? 0 : kContactCost / (1 + c.whole.contact_s));
    e.total = c.total;
    e.rejected = c.chosen ? "" : *c.rejected != 0 ? c.rejected : !c.whole.clear ? "touches something" : "dearer";
  }
}

}  // namespace sidestep
