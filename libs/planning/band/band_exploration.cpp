// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Where the bands of a plan come from: the gap graph, the global path, and ways that are timed among what moves.
#include <algorithm>
#include <cmath>

#include "planning/band/band_planner.h"

namespace sidestep {
namespace {

constexpr int kPatience = 4;          ///< plans after which a band that touches something makes room for another
constexpr double kMuchShorter = 0.9;  ///< a fresh band of a known class is tried if it takes less than this part
constexpr int kWorkMost = 60000;      ///< states of one search in space and time
constexpr double kTryAgainMost_s = 4;
constexpr double kTryAgain_s = 0.25;  ///< after having found no way among what moves
constexpr double kNarrow_m = 0.03;    ///< least clearance of a drive that is searched
constexpr double kSpare_m = 0.05;     ///< over the least clearance, for what the optimizer and chords take

}  // namespace

void BandPlanner::explore(const PlanInput& input) {
  const BandCandidate* last = chosen();
  const bool single = params_.exploration.classes_max == 1;
  if (single && last != nullptr && last->whole.clear) return;
  if (!goal_.way.empty()) addAlong(goal_.way, {goal_.pose.x, goal_.pose.y}, 1, input);
  exploreAt(1, params_.exploration.classes_max, input);
  // passing behind may mean to be slower: the same graph for a robot that takes its time
  constexpr double kPaces[] = {0.85, 0.7, 0.5};
  for (const double pace : kPaces)
    if (view_.movesInTime() && !single) exploreAt(pace, 1, input);
  const bool nothing = std::none_of(pool_.begin(), pool_.end(), [](const auto& c) { return c.alive; });
  const mrpt::math::TPoint2D straight[] = {{input.pose.x, input.pose.y}, {goal_.pose.x, goal_.pose.y}};
  if (nothing) addAlong(straight, straight[1], 1, input);
}

/// Adds the classes that the gap graph holds for a robot at a part of its speed.
void BandPlanner::exploreAt(double pace, int most, const PlanInput& input) {
  const double radius = problem_.robot.radius_m, wished = radius + params_.band.distance_m;
  RobotLimits limits = input.limits;
  limits.v_max *= pace;
  const SpeedProfile profile(frame_.length, std::max(input.twist.vx, 0.0), limits, goal_.is_goal);
  const std::vector<GapPath>* paths =
      &graph_.search({frame_, &view_, radius + params_.band.distance_least_m, wished, profile});
  if (graph_.found() == 0) paths = &graph_.search({frame_, &view_, radius + 0.01, wished, profile});
  const size_t n = std::min(graph_.found(), static_cast<size_t>(most));
  for (size_t k = 0; k < n; ++k) addAlong((*paths)[k].points, (*paths)[k].beside, pace, input);
}

/// A slot without a band, or that of one that was not chosen and touches something.
BandCandidate* BandPlanner::freeSlot() {
  for (auto& c : pool_)
    if (!c.alive) return &c;
  for (auto& c : pool_)
    if (!c.fresh && c.touching > kPatience && (!c.chosen || pool_.size() == 1)) return &c;
  return nullptr;
}

void BandPlanner::addAlong(std::span<const mrpt::math::TPoint2D> way, const mrpt::math::TPoint2D& beside, double pace,
                           const PlanInput& input) {
  BandCandidate* slot = freeSlot();
  if (slot == nullptr) return;
  BandStart spec{
      input.pose, goal_.pose, problem_.ends, goal_.heading_free, params_.band.interval_s, params_.band.poses_max};
  RobotLimits limits = input.limits;
  limits.v_max *= pace;
  maker_.along(way, spec, limits, fresh_);
  auto& reader = workers_[0].signature;
  const uint64_t signature = classOf(reader, fresh_);
  for (auto& c : pool_) {
    if (!c.alive || &c == slot || classOf(reader, c.band) != signature) continue;
    if (!c.fresh) c.beside = beside;
    // a band that was bent around something since gone is tried against a fresh one of its class
    if (c.fresh || fresh_.back().t > kMuchShorter * c.band.back().t) return;
  }
  slot->band = fresh_;
  slot->beside = beside;
  slot->chosen = slot->chosen && slot->alive;
  slot->alive = slot->fresh = true;
}

/// Where every band touches something.
void BandPlanner::rescue(const PlanInput& input) {
  const auto clear = [](const BandCandidate& c) { return c.alive && c.whole.clear && !c.result.diverged; };
  if (input.time_s < rescue_again_ || !goalIsFree() || std::any_of(pool_.begin(), pool_.end(), clear)) return;
  const bool rescued = view_.movesInTime() ? letPass(input) : keepToTheGraph(input);
  // each time in vain doubles the time until the next
  rescue_wait_s_ = rescued ? kTryAgain_s : std::min(2 * rescue_wait_s_, kTryAgainMost_s);
  rescue_again_ = input.time_s + rescue_wait_s_;
}

/// The optimizer gives up clearance for time; the ways of the graph have it. @return whether one is clear
bool BandPlanner::keepToTheGraph(const PlanInput& input) {
  const double radius = problem_.robot.radius_m;
  const SpeedProfile profile(frame_.length, std::max(input.twist.vx, 0.0), input.limits, goal_.is_goal);
  const auto& ways = graph_.search(
      {frame_, &view_, radius + params_.band.distance_least_m, radius + params_.band.distance_m, profile, true});
  TimedBand& timed = timed_[0];
  for (size_t k = 0; k < graph_.found(); ++k) {
    const BandStart spec{
        input.pose, goal_.pose, problem_.ends, goal_.heading_free, params_.band.interval_s, params_.band.poses_max};
    maker_.along(ways[k].points, spec, input.limits, timed.band);
    timed.beside = ways[k].beside;
    if (becomesClear(input, timed) && place(passing_)) return true;
  }
  return false;
}

/// Among what moves: a drive searched in space and time, and ways around and through that wait, let pass or back off.
/// Those that stay clear when optimized take the places of bands that touch. @return whether there is any
bool BandPlanner::letPass(const PlanInput& input) {
  const double radius = problem_.robot.radius_m, least = radius + params_.band.distance_least_m + kSpare_m;
  int placed = searchInTime(input) && place(passing_) ? 1 : 0;
  timed_count_ = 0;
  timeWays(input, std::max(radius + params_.band.distance_moving_m, least));
  if (timed_count_ == 0 && placed == 0) timeWays(input, least);
  const auto end = timed_.begin() + static_cast<std::ptrdiff_t>(timed_count_);
  std::sort(timed_.begin(), end, [](const auto& a, const auto& b) { return a.band.back().t < b.band.back().t; });
  for (auto t = timed_.begin(); t != end && placed < params_.exploration.classes_max; ++t) {
    if (input.out_of_time && input.out_of_time()) break;
    if (becomesClear(input, *t) && place(passing_)) ++placed;
  }
  return placed > 0;
}

/// Whether nothing stands on the goal.
bool BandPlanner::goalIsFree() const {
  bool free = true;
  view_.near(goal_.pose.x, goal_.pose.y, -1, problem_.robot.radius_m, [&](const Proximity&) { free = false; });
  return free;
}

/// Puts a clear band in the place of none, or of the one that touches something first; @return whether there is any
bool BandPlanner::place(BandCandidate& c) {
  const auto rank = [](const BandCandidate& b) { return !b.alive ? -1 : b.whole.clear ? 1e9 : b.whole.contact_s; };
  BandCandidate& slot = *std::min_element(
      pool_.begin(), pool_.end(), [&](const BandCandidate& a, const BandCandidate& b) { return rank(a) < rank(b); });
  if (slot.alive && slot.whole.clear) return false;
  std::swap(slot, c);
  return true;
}

/// Along the ways that the standing obstacles leave, the global path, and bows to both sides.
void BandPlanner::timeWays(const PlanInput& input, double keep_out) {
  if (!goal_.way.empty()) timeWay(goal_.way, {goal_.pose.x, goal_.pose.y}, keep_out, input);
  const double radius = problem_.robot.radius_m;
  const SpeedProfile profile(frame_.length, std::max(input.twist.vx, 0.0), input.limits, goal_.is_goal);
  const auto& ways = graph_.search(
      {frame_, &view_, radius + params_.band.distance_least_m, radius + params_.band.distance_m, profile, true});
  for (size_t k = 0; k < graph_.found(); ++k) timeWay(ways[k].points, ways[k].beside, keep_out, input);
  const double widest = std::max(params_.exploration.detour_least_m, params_.exploration.detour_share * frame_.length);
  for (const double share : {0.2, -0.2, 0.4, -0.4, 0.7, -0.7, 1.0, -1.0}) {
    constexpr int kPieces = 32;
    bow_.clear();
    for (int i = 0; i <= kPieces; ++i) {
      const double u = static_cast<double>(i) / kPieces, bulge = std::sin(M_PI * u);
      bow_.push_back(frame_.point(u * frame_.length, share * widest * bulge * bulge));
    }
    timeWay(bow_, bow_[kPieces / 2], keep_out, input);
  }
}

void BandPlanner::timeWay(std::span<const mrpt::math::TPoint2D> way, const mrpt::math::TPoint2D& beside,
                          double keep_out, const PlanInput& input) {
  if (timed_count_ == timed_.size() || (input.out_of_time && input.out_of_time())) return;
  TimedBand& timed = timed_[timed_count_];
  const BandStart spec{
      input.pose, goal_.pose, problem_.ends, goal_.heading_free, params_.band.interval_s, params_.band.poses_max};
  WayTiming::Query query;
  query.limits = input.limits;
  query.keep_out_m = keep_out;
  query.reach_m = reach_m_;
  query.horizon_s = params_.view.prediction_horizon_s;
  query.obstacles = &view_;
  if (!maker_.alongWhenClear(way, spec, query, timed.band)) return;
  timed.beside = beside;
  ++timed_count_;
}

/// Whether a drive was found that is clear when optimized; it is in `passing_` then. One raster of states misses drives
/// that another one finds.
bool BandPlanner::searchInTime(const PlanInput& input) {
  SpaceTimeSearch::Query query;
  query.start = input.pose;
  query.goal = {goal_.pose.x, goal_.pose.y};
  query.ends = problem_.ends;
  query.limits = input.limits;
  query.keep_out_m = problem_.robot.radius_m + kNarrow_m;
  query.horizon_s = params_.view.prediction_horizon_s;
  query.states_max = params_.exploration.states_max;
  query.bounds = bounds_;
  query.obstacles = &view_;
  query.stop = &input.out_of_time;
  constexpr int kTrials = 8;
  int trials = 0;
  TimedBand& timed = timed_[0];
  timed.beside = query.goal;
  const auto accept = [&](const Band& band) {
    const auto n = static_cast<int>(std::lround(band.back().t / params_.band.interval_s));
    if (n > params_.band.poses_max || ++trials > kTrials) return false;
    resample(band, 0, std::max(n, 3), timed.band);
    return becomesClear(input, timed);
  };
  struct Raster {
    double cell_m;
    int headings;
  };
  int work = kWorkMost;
  for (const Raster& raster : {Raster{0.1, 24}, Raster{0.07, 36}, Raster{0.15, 20}}) {
    query.work_max = work;
    query.cell_m = raster.cell_m;
    query.headings = raster.headings;
    if (search_.search(query, fresh_, accept)) return true;
    work -= static_cast<int>(search_.work());
    if (work <= 0 || trials > kTrials) break;
  }
  return false;
}

/// Optimizes a band, into `passing_`; where the optimizer drives it into something, the band as it was.
bool BandPlanner::becomesClear(const PlanInput& input, const TimedBand& timed) {
  BandCandidate& c = passing_;
  c.band = timed.band;
  c.beside = timed.beside;
  c.alive = c.fresh = true;
  c.chosen = false;
  c.rejected = "";
  optimizeOne(input, workers_[0], c);
  if (c.whole.clear && !c.result.diverged) return true;
  c.band = timed.band;
  retime(c.band, input.limits, c.ends);
  c.shares = workers_[0].optimizer.shares(problem_, c.band);
  c.result.cost = 0;
  for (const double share : c.shares) c.result.cost += share;
  c.result.diverged = !std::isfinite(c.result.cost);
  examine(workers_[0], c);
  return c.whole.clear && !c.result.diverged;
}

}  // namespace sidestep
