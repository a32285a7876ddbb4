// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/space_time_search.h"

#include <algorithm>
#include <cmath>

#include "maps/distance_field.h"

namespace sidestep {
namespace {

constexpr double kPixel_m = 0.05;       ///< of the map in which a layer's obstacles are drawn
constexpr size_t kTable = 1 << 15;      ///< places for cells
constexpr double kTurn_s = M_PI / 2;    ///< half of what it costs to face away from the goal
constexpr double kStraight_rad = 0.12;  ///< the goal may be so far off the heading for a straight end

/// Into [-pi, pi], if not more than a turn out of it.
double wrapped(double angle) { return angle > M_PI ? angle - 2 * M_PI : angle < -M_PI ? angle + 2 * M_PI : angle; }

}  // namespace

void SpaceTimeSearch::start(const Query& query) {
  setLevels(query);
  layMap(query);
  keys_.resize(kTable);
  held_.resize(kTable);
  stamps_.assign(kTable, 0);
  const int v = std::clamp(static_cast<int>(std::lround(query.ends.v / v_step_)), v_low_, v_most_);
  const int w = std::clamp(static_cast<int>(std::lround(query.ends.w / w_step_)), -w_most_, w_most_);
  states_.clear();
  states_.push_back({query.start.x, query.start.y, std::remainder(query.start.phi, 2 * M_PI), 0,
                     static_cast<int16_t>(v), static_cast<int16_t>(w), -1});
  first_.assign({0, 1});
}

bool SpaceTimeSearch::grow(const Query& query, int layer) {
  if (layer == 0) return true;
  const double t = layer * kStep_s;
  if (t > query.horizon_s || states_.size() > static_cast<size_t>(query.work_max) ||
      (query.stop != nullptr && *query.stop && (*query.stop)()))
    return false;
  stamp(query, t - kStep_s / 2, half_);
  stamp(query, t, full_);
  const size_t at = static_cast<size_t>(layer), first = first_[at - 1], last = first_[at];
  growFrom(query, first, last);
  thin(query.states_max, last);
  first_.push_back(states_.size());
  return states_.size() > last;
}

int SpaceTimeSearch::arrival(const Query& query, int layer) const {
  const size_t at = static_cast<size_t>(layer);
  for (size_t i = first_[at]; i < first_[at + 1]; ++i)
    if (straightOn(query, states_[i], layer * kStep_s)) return static_cast<int>(i);
  return -1;
}

void SpaceTimeSearch::setLevels(const Query& query) {
  constexpr double kMost = 6, kMostTurns = 4;
  const auto& l = query.limits;
  double n = std::ceil(l.v_max / (std::min(l.accel, l.brake) * kStep_s) - 1e-9);
  if (l.v_reverse > 0) n = std::max(n, std::ceil(l.v_max / l.v_reverse - 1e-9));
  v_most_ = static_cast<int>(std::clamp(n, 2.0, kMost));
  v_step_ = l.v_max / v_most_;
  v_low_ = l.v_reverse >= v_step_ * (1 - 1e-9) ? -1 : 0;
  w_step_ = std::min(0.9 * l.turn_accel * kStep_s, l.w_max);
  w_most_ = static_cast<int>(std::clamp(std::floor(l.w_max / w_step_ + 1e-9), 1.0, kMostTurns));
  tabulateSteps();
}

void SpaceTimeSearch::tabulateSteps() {
  constexpr int kParts = 8;
  const double h = kStep_s / kParts;
  steps_.clear();
  for (int v = v_low_; v <= v_most_; ++v)
    for (int w = -w_most_; w <= w_most_; ++w)
      for (int dv = -1; dv <= 1; ++dv)
        for (int dw = -1; dw <= 1; ++dw) {
          Step s{};
          double theta = 0, x = 0, y = 0;
          for (int k = 0; k < kParts; ++k) {
            const double share = (k + 0.5) / kParts, speed = v_step_ * (v + share * dv),
                         turn = w_step_ * (w + share * dw);
            x += h * speed * std::cos(theta + h * turn / 2);
            y += h * speed * std::sin(theta + h * turn / 2);
            theta += h * turn;
            if (k + 1 == kParts / 2) s.x_half = x, s.y_half = y;
          }
          s.x = x;
          s.y = y;
          s.theta = theta;
          s.c = std::cos(theta);
          s.s = std::sin(theta);
          steps_.push_back(s);
        }
}

namespace {

struct Pixels {
  int columns, rows;
  double x0, y0;
  /// Draws a disc.
  void disc(double x, double y, double radius, std::vector<uint8_t>& map) const {
    const double cx = (x - x0) / kPixel_m - 0.5, cy = (y - y0) / kPixel_m - 0.5, r = radius / kPixel_m;
    if (!(std::abs(cx) < 1e6 && std::abs(cy) < 1e6 && r < 1e4)) return;
    const int low = std::max(0, static_cast<int>(std::ceil(cy - r))),
              high = std::min(rows - 1, static_cast<int>(cy + r));
    for (int row = low; row <= high; ++row) {
      const double half = std::sqrt(std::max(r * r - (row - cy) * (row - cy), 0.0));
      const int from = std::max(0, static_cast<int>(std::ceil(cx - half)));
      const int to = std::min(columns - 1, static_cast<int>(std::floor(cx + half)));
      if (from <= to) std::fill_n(&map[static_cast<size_t>(row * columns + from)], to - from + 1, uint8_t{1});
    }
  }
};

Pixels pixelsOf(const SpaceTimeSearch::Query& q) {
  return {static_cast<int>((q.bounds.x_max - q.bounds.x_min) / kPixel_m),
          static_cast<int>((q.bounds.y_max - q.bounds.y_min) / kPixel_m), q.bounds.x_min, q.bounds.y_min};
}

}  // namespace

/// What stands is drawn once.
void SpaceTimeSearch::layMap(const Query& query) {
  const Pixels pixels = pixelsOf(query);
  columns_ = pixels.columns;
  rows_ = pixels.rows;
  still_.assign(static_cast<size_t>(columns_ * rows_), 0);
  for (const auto& o : query.obstacles->still()) {
    const int pieces = static_cast<int>(std::hypot(o.ex, o.ey) / kPixel_m);
    for (int i = 0; i <= pieces; ++i) {
      const double share = pieces > 0 ? static_cast<double>(i) / pieces : 0;
      pixels.disc(o.x + share * o.ex, o.y + share * o.ey, o.radius + query.keep_out_m, still_);
    }
  }
}

void SpaceTimeSearch::stamp(const Query& query, double t, std::vector<uint8_t>& map) const {
  const Pixels pixels = pixelsOf(query);
  map = still_;
  for (const auto& o : query.obstacles->movingIn(t))
    pixels.disc(o.x + o.vx * (t - o.middle), o.y + o.vy * (t - o.middle), o.radius + query.keep_out_m, map);
}

bool SpaceTimeSearch::clear(const Query& query, double x, double y, const std::vector<uint8_t>& map) const {
  const double column = (x - query.bounds.x_min) / kPixel_m, row = (y - query.bounds.y_min) / kPixel_m;
  if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_)) return false;
  if (map[static_cast<size_t>(row) * static_cast<size_t>(columns_) + static_cast<size_t>(column)] != 0) return false;
  const auto* field = query.obstacles->field();
  return field == nullptr || field->clearance(x, y) >= query.keep_out_m;
}

void SpaceTimeSearch::growFrom(const Query& query, size_t first, size_t last) {
  for (size_t i = first; i < last; ++i) {
    const State s = states_[i];
    const double x = s.x, y = s.y, c = std::cos(s.theta), sn = std::sin(s.theta);
    for (int dv = -1; dv <= 1; ++dv)
      for (int dw = -1; dw <= 1; ++dw) {
        if (s.v + dv < v_low_ || s.v + dv > v_most_ || std::abs(s.w + dw) > w_most_) continue;
        const Step& step = stepOf(s.v, s.w, dv, dw);
        const auto moved = [&](double ahead, double left) {
          return mrpt::math::TPoint2D(x + c * ahead - sn * left, y + sn * ahead + c * left);
        };
        const auto half = moved(step.x_half, step.y_half), full = moved(step.x, step.y);
        if (!clear(query, half.x, half.y, half_) || !clear(query, full.x, full.y, full_)) continue;
        State next{full.x,
                   full.y,
                   wrapped(s.theta + step.theta),
                   0,
                   static_cast<int16_t>(s.v + dv),
                   static_cast<int16_t>(s.w + dw),
                   static_cast<int>(i)};
        const double dx = query.goal.x - full.x, dy = query.goal.y - full.y, d = std::sqrt(dx * dx + dy * dy);
        const double ahead = (c * dx + sn * dy) * step.c + (c * dy - sn * dx) * step.s;  // of the goal, d cos(off)
        next.left = d / query.limits.v_max + kTurn_s * (1 - ahead / std::max(d, 1e-9)) +
                    0.3 * std::abs(next.w) * w_step_ - 0.3 * next.v / v_most_;
        keep(query, next);
      }
  }
}

/// A state takes the place of one of the same cell that is farther from the goal.
void SpaceTimeSearch::keep(const Query& query, const State& s) {
  const auto cell = [&](double value) {
    return static_cast<uint64_t>(static_cast<int64_t>(value / query.cell_m + 32768));
  };
  const double turn = 2 * M_PI / query.headings;
  const auto heading = static_cast<uint64_t>((s.theta + M_PI) / turn);
  const uint64_t fast = s.v <= 0 ? 0 : 2 * s.v <= v_most_ ? 1 : 2, turns = s.w < 0 ? 0 : s.w > 0 ? 2 : 1;
  const uint64_t key = ((cell(s.x) * 65536 + cell(s.y)) * 256 + heading) * 9 + fast * 3 + turns;
  const auto layer = static_cast<uint32_t>(first_.size());
  constexpr size_t kTries = 64;
  size_t at = static_cast<size_t>((key * 0x9e3779b97f4a7c15ULL) >> 49);  // 15 bits
  for (size_t tried = 0; tried < kTries; ++tried, at = (at + 1) % kTable) {
    if (stamps_[at] != layer) {
      stamps_[at] = layer;
      keys_[at] = key;
      held_[at] = static_cast<int>(states_.size());
      states_.push_back(s);
      return;
    }
    if (keys_[at] != key) continue;
    State& held = states_[static_cast<size_t>(held_[at])];
    if (s.left < held.left) held = s;
    return;
  }
}

void SpaceTimeSearch::thin(int most, size_t first) {
  if (states_.size() - first <= static_cast<size_t>(most)) return;
  const auto begin = states_.begin() + static_cast<std::ptrdiff_t>(first);
  std::nth_element(begin, begin + most, states_.end(),
                   [](const State& a, const State& b) { return a.left != b.left ? a.left < b.left : a.from < b.from; });
  states_.resize(first + static_cast<size_t>(most));
}

/// Whether the rest can be driven straight, from the state's speed on.
bool SpaceTimeSearch::straightOn(const Query& query, const State& s, double t) const {
  constexpr double kReach_m = 3;
  if (s.v < 0 || s.w != 0) return false;
  const double dx = query.goal.x - s.x, dy = query.goal.y - s.y, d = std::hypot(dx, dy);
  if (d > kReach_m) return false;
  if (d > 0.05 && std::abs(std::remainder(std::atan2(dy, dx) - s.theta, 2 * M_PI)) > kStraight_rad) return false;
  const double v = s.v * v_step_;
  if (query.ends.goal_stops && v * v / (2 * query.limits.brake) > d + 0.05) return false;
  const SpeedProfile profile(d, v, query.limits, query.ends.goal_stops);
  if (t + profile.duration() > query.horizon_s) return false;
  for (double after = 0; after <= profile.duration() + 0.1; after += 0.1) {
    const double share = d > 1e-6 ? profile.wayAt(after) / d : 1, x = s.x + share * dx, y = s.y + share * dy;
    bool free = query.obstacles->field() == nullptr || query.obstacles->field()->clearance(x, y) >= query.keep_out_m;
    query.obstacles->near(x, y, t + after, query.keep_out_m, [&](const Proximity&) { free = false; });
    if (!free) return false;
  }
  return true;
}

void SpaceTimeSearch::trace(const Query& query, int state, Band& out) const {
  out.clear();
  for (int i = state; i >= 0; i = states_[static_cast<size_t>(i)].from) {
    const State& s = states_[static_cast<size_t>(i)];
    out.push_back({s.x, s.y, s.theta, 0});
  }
  std::reverse(out.begin(), out.end());
  for (size_t k = 0; k < out.size(); ++k) out[k].t = static_cast<double>(k) * kStep_s;
  out.front() = {query.start.x, query.start.y, query.start.phi, 0};
  for (size_t k = 1; k < out.size(); ++k)
    out[k].theta = out[k - 1].theta + std::remainder(out[k].theta - out[k - 1].theta, 2 * M_PI);
  const BandPose from = out.back();
  const double dx = query.goal.x - from.x, dy = query.goal.y - from.y, d = std::hypot(dx, dy);
  const SpeedProfile profile(d, states_[static_cast<size_t>(state)].v * v_step_, query.limits, query.ends.goal_stops);
  const int n = std::max(3, static_cast<int>(std::lround(profile.duration() / kStep_s)));
  const double heading = d > 0.05 ? from.theta + std::remainder(std::atan2(dy, dx) - from.theta, 2 * M_PI) : from.theta;
  for (int k = 1; k <= n; ++k) {
    const double after = std::max(profile.duration(), 0.1) * k / n;
    const double share = d > 1e-6 ? profile.wayAt(after) / d : 1;
    out.push_back({from.x + share * dx, from.y + share * dy, heading, from.t + after});
  }
  out.back().x = query.goal.x;
  out.back().y = query.goal.y;
}

}  // namespace sidestep
