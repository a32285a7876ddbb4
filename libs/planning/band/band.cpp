// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/band.h"

#include <algorithm>
#include <cmath>

#include "core/kinematics.h"

namespace sidestep {
namespace {

constexpr double kShortest_s = 0.02;  ///< of an interval

/// Index of the interval that holds time `t`.
size_t intervalAt(const Band& band, double t) {
  const auto above = std::upper_bound(band.begin(), band.end(), t, [](double x, const BandPose& p) { return x < p.t; });
  const auto at = std::clamp<std::ptrdiff_t>(above - band.begin() - 1, 0, static_cast<std::ptrdiff_t>(band.size()) - 2);
  return static_cast<size_t>(at);
}

/// What a retiming knows of an interval: way, turn and time.
struct Piece {
  double way = 0, turn = 0, dt = 0;
};

Piece pieceOf(const BandPose& a, const BandPose& b) {
  const Interval i = intervalBetween(a, b);
  return {i.ahead * i.arc, i.turn, i.dt};
}

/// Least dt so that the change from `before` (mean over dt_before) to way / dt, taken over half of both times, is no
/// larger than `limit`:   way / dt - before <= limit (dt_before + dt) / 2,   for way > 0.
double leastTime(double way, double before, double dt_before, double limit) {
  const double b = before + limit * dt_before / 2;
  const double root = std::sqrt(b * b + 2 * limit * way);
  return b < 0 ? (root - b) / limit : 2 * way / (b + root);  // the form that does not cancel
}

/// Lengthens `piece` until it does not speed up more than allowed from the neighbour's speeds. @return whether it did
bool slow(Piece& piece, double v, double w, double dt, double accel, double turn_accel) {
  const double sign_v = piece.way < 0 ? -1 : 1, sign_w = piece.turn < 0 ? -1 : 1;
  double least = piece.dt;
  if (piece.way != 0) least = std::max(least, leastTime(sign_v * piece.way, sign_v * v, dt, accel));
  if (piece.turn != 0) least = std::max(least, leastTime(sign_w * piece.turn, sign_w * w, dt, turn_accel));
  const bool longer = least > piece.dt * (1 + 1e-7);
  if (longer) piece.dt = least;
  return longer;
}

double leastBySpeed(const Piece& p, const RobotLimits& limits) {
  const double v_max = p.way >= 0 ? limits.v_max : std::max(limits.v_reverse, 1e-2);
  const double wheel = outerWheelSpeed(p.way, p.turn, limits.track_m) / limits.wheel_speed_max;
  return std::max({std::abs(p.way) / v_max, std::abs(p.turn) / limits.w_max, wheel, kShortest_s});
}

bool sweepForward(std::vector<Piece>& pieces, const RobotLimits& limits, const BandEnds& ends) {
  bool changed = false;
  double v = ends.v, w = ends.w, dt = 0;
  for (auto& p : pieces) {
    changed |= slow(p, v, w, dt, limits.accel, limits.turn_accel);
    v = p.way / p.dt;
    w = p.turn / p.dt;
    dt = p.dt;
  }
  return changed;
}

bool sweepBackward(std::vector<Piece>& pieces, const RobotLimits& limits, const BandEnds& ends) {
  bool changed = false;
  double v = 0, w = 0, dt = 0;
  for (size_t k = pieces.size(); k-- > 0;) {
    auto& p = pieces[k];
    if (k + 1 < pieces.size() || ends.goal_stops) changed |= slow(p, v, w, dt, limits.brake, limits.turn_accel);
    v = p.way / p.dt;
    w = p.turn / p.dt;
    dt = p.dt;
  }
  return changed;
}

}  // namespace

BandExtremes extremesOf(const Band& band, const BandEnds& ends) {
  BandExtremes out;
  double v = ends.v, w = ends.w, dt = 0;
  const auto step = [&](double v_next, double w_next, double dt_next) {
    const double k = 2 / (dt + dt_next);
    out.a = std::max(out.a, std::abs(v_next - v) * k);
    out.turn_accel = std::max(out.turn_accel, std::abs(w_next - w) * k);
    v = v_next;
    w = w_next;
    dt = dt_next;
  };
  for (size_t k = 0; k + 1 < band.size(); ++k) {
    const Interval i = intervalBetween(band[k], band[k + 1]);
    step(i.v, i.w, i.dt);
    out.v = std::max(out.v, std::abs(i.v));
    out.w = std::max(out.w, std::abs(i.w));
  }
  if (ends.goal_stops && band.size() > 1) step(0, 0, 0);
  return out;
}

BandPose bandAt(const Band& band, double t) {
  if (t <= band.front().t || band.size() < 2) return band.front();
  if (t >= band.back().t) return band.back();
  const size_t k = intervalAt(band, t);
  const Interval i = intervalBetween(band[k], band[k + 1]);
  const double share = (t - band[k].t) / i.dt, turn = share * i.turn;
  // the part of the arc: its chord is share * sinc(turn / 2) / sinc(whole / 2) of the whole chord, at heading + turn /
  // 2
  const double whole = sinc(i.turn / 2), scale = std::abs(whole) > 0.1 ? share * sinc(turn / 2) / whole : share;
  const double swing = (turn - i.turn) / 2, c = scale * std::cos(swing), s = scale * std::sin(swing);
  const double dx = band[k + 1].x - band[k].x, dy = band[k + 1].y - band[k].y;
  return {band[k].x + c * dx - s * dy, band[k].y + s * dx + c * dy, band[k].theta + turn, t};
}

TrajectorySpeed speedAt(const Band& band, const BandEnds& ends, double t) {
  if (band.size() < 2) return {};
  double at = 0, v = ends.v, w = ends.w;
  const auto between = [&](double next, double v_next, double w_next) -> TrajectorySpeed {
    const double share = next > at ? std::clamp((t - at) / (next - at), 0.0, 1.0) : 1;
    return {v + share * (v_next - v), w + share * (w_next - w)};
  };
  for (size_t k = 0; k + 1 < band.size(); ++k) {
    const Interval i = intervalBetween(band[k], band[k + 1]);
    const double middle = 0.5 * (band[k].t + band[k + 1].t);
    if (t < middle) return between(middle, i.v, i.w);
    at = middle;
    v = i.v;
    w = i.w;
  }
  return ends.goal_stops ? between(band.back().t, 0, 0) : TrajectorySpeed{v, w};
}

void resample(const Band& band, double from_s, int intervals, Band& out) {
  out.clear();
  const double step = (band.back().t - from_s) / intervals;
  for (int k = 0; k <= intervals; ++k) {
    BandPose p = bandAt(band, k < intervals ? from_s + k * step : band.back().t);
    p.t = k * step;
    out.push_back(p);
  }
}

void retime(Band& band, const RobotLimits& limits, const BandEnds& ends, Retiming kind) {
  thread_local std::vector<Piece> pieces;
  pieces.clear();
  for (size_t k = 0; k + 1 < band.size(); ++k) {
    Piece p = pieceOf(band[k], band[k + 1]);
    p.dt = kind == Retiming::kQuickest ? leastBySpeed(p, limits) : std::max(p.dt, leastBySpeed(p, limits));
    pieces.push_back(p);
  }
  constexpr int kSweeps = 40;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const bool forward = sweepForward(pieces, limits, ends), backward = sweepBackward(pieces, limits, ends);
    if (!forward && !backward) break;
  }
  for (size_t k = 0; k < pieces.size(); ++k) band[k + 1].t = band[k].t + pieces[k].dt;
}

SpeedProfile::SpeedProfile(double length_m, double v_start, const RobotLimits& limits, bool stops)
    : length_(length_m), v0_(std::clamp(v_start, 0.0, limits.v_max)), accel_(limits.accel), brake_(limits.brake) {
  const double reach = 2 * length_m + v0_ * v0_ / accel_;  // speed^2 that is reached and lost again on the way
  const double both = stops ? 1 / accel_ + 1 / brake_ : 1 / accel_;
  peak_ = std::min(limits.v_max, std::max(v0_, std::sqrt(reach / both)));
  s_up_ = (peak_ * peak_ - v0_ * v0_) / (2 * accel_);
  const double s_down = stops ? std::min(peak_ * peak_ / (2 * brake_), length_m - s_up_) : 0;
  s_flat_ = std::max(length_m - s_up_ - std::max(s_down, 0.0), 0.0);
  t_up_ = (peak_ - v0_) / accel_;
  t_flat_ = s_flat_ / std::max(peak_, 1e-3);
  total_ = t_up_ + t_flat_ + (stops ? peak_ / brake_ : 0);
}

double SpeedProfile::wayAt(double t) const {
  if (t <= 0) return 0;
  if (t >= total_) return length_;
  if (t <= t_up_) return v0_ * t + accel_ * t * t / 2;
  const double flat = std::min(t - t_up_, t_flat_), down = t - t_up_ - flat;
  return std::min(s_up_ + flat * peak_ + down * peak_ - brake_ * down * down / 2, length_);
}

}  // namespace sidestep
