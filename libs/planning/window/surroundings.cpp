// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/window/surroundings.h"

#include <algorithm>
#include <cmath>

#include "core/geometry.h"
#include "maps/distance_field.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

/// The robot and what it keeps away from, as one radius; less where it is nearer already, so that only coming nearer
/// still counts, and a robot that was touched may leave.
double radiusWith(double bare, double margin, double distance_now) {
  constexpr double kSlack_m = 1e-3;
  return std::min(bare + margin, distance_now - kSlack_m);
}

double largestSd(const Eigen::Matrix2d& P) {
  const double mean = 0.5 * (P(0, 0) + P(1, 1)), half = 0.5 * (P(0, 0) - P(1, 1));
  return std::sqrt(std::max(0.0, mean + std::sqrt(half * half + P(0, 1) * P(1, 0))));
}

/// Where the obstacle is after `t`, and how well that is known [m, sd].
struct Forecast {
  TPoint2D position;
  double sd;
};
Forecast forecast(const MovingObstacle& m, double t) {
  TPoint2D from = m.position;
  double since = 0, sd = largestSd(m.covariance);
  for (const auto& p : m.predicted) {
    if (p.after_s >= t && p.after_s > since) {
      const double share = (t - since) / (p.after_s - since);
      return {from + (p.position - from) * share, sd + (largestSd(p.covariance) - sd) * share};
    }
    from = p.position;
    since = p.after_s;
    sd = largestSd(p.covariance);
  }
  return {from + m.velocity * (t - since), sd};
}

/// Distances less radii; Eigen takes four or eight at a time.
auto gaps(const float* px, const float* py, const float* r, Eigen::Index n, double x, double y) {
  using Row = Eigen::Map<const Eigen::ArrayXf>;
  const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
  return ((Row(px, n) - fx).square() + (Row(py, n) - fy).square()).sqrt() - Row(r, n);
}

}  // namespace

TPoint2D Surroundings::local(const TPoint2D& map) const {
  const double dx = map.x - pose_.x, dy = map.y - pose_.y;
  return {cos_ * dx + sin_ * dy, -sin_ * dx + cos_ * dy};
}

void Surroundings::look(const PlanInput& input, double look_ahead_s, double step_s, double margin_m, bool predict,
                        double sigmas) {
  pose_ = input.pose;
  cos_ = std::cos(pose_.phi);
  sin_ = std::sin(pose_.phi);
  steps_ = static_cast<int>(std::ceil(look_ahead_s / step_s - 1e-9));
  step_s_ = look_ahead_s / steps_;
  reach_m_ = input.limits.v_max * look_ahead_s + input.limits.radius_m + margin_m;
  addMoving(input, margin_m, predict, sigmas);
  addStatic(input, margin_m);
}

void Surroundings::addMoving(const PlanInput& input, double margin_m, bool predict, double sigmas) {
  const double bare = input.limits.radius_m, horizon = steps_ * step_s_;
  mover_id_.clear();
  fastest_ = 0;
  for (size_t i = 0; i < input.moving.size(); ++i) {
    const auto& m = input.moving[i];
    double speed = predict ? m.velocity.norm() : 0;
    for (size_t p = 0; predict && p < m.predicted.size(); ++p) {
      const auto& from = p > 0 ? m.predicted[p - 1].position : m.position;
      const double dt = m.predicted[p].after_s - (p > 0 ? m.predicted[p - 1].after_s : 0);
      if (dt > 0) speed = std::max(speed, (m.predicted[p].position - from).norm() / dt);
    }
    const TPoint2D offset{m.position.x - pose_.x, m.position.y - pose_.y};
    if (offset.norm() - m.radius_m > reach_m_ + speed * horizon + sigmas * forecast(m, horizon).sd) continue;
    mover_id_.push_back(static_cast<int>(i));
    fastest_ = std::max(fastest_, speed);
  }
  movers_ = static_cast<int>(mover_id_.size());
  mover_x_.clear();
  mover_y_.clear();
  mover_r_.clear();
  for (int k = 0; k <= steps_; ++k)
    for (int id : mover_id_) {
      const auto& m = input.moving[static_cast<size_t>(id)];
      const Forecast f = forecast(m, predict ? k * step_s_ : 0);
      const TPoint2D p = local(f.position);
      const double now = std::hypot(m.position.x - pose_.x, m.position.y - pose_.y);
      mover_x_.push_back(static_cast<float>(p.x));
      mover_y_.push_back(static_cast<float>(p.y));
      mover_r_.push_back(static_cast<float>(radiusWith(bare + m.radius_m, margin_m + sigmas * f.sd, now)));
    }
}

void Surroundings::addStatic(const PlanInput& input, double margin_m) {
  const double bare = input.limits.radius_m;
  point_x_.clear();
  point_y_.clear();
  point_r_.clear();
  for (const auto& map : input.points) {
    const TPoint2D p = local(map);
    const double d = p.norm();
    if (d > reach_m_) continue;
    point_x_.push_back(static_cast<float>(p.x));
    point_y_.push_back(static_cast<float>(p.y));
    point_r_.push_back(static_cast<float>(radiusWith(bare, margin_m, d)));
  }
  walls_.clear();
  wall_r_.clear();
  for (const auto& map : input.walls) {
    const Segment w{local(map.a), local(map.b)};
    const double d = nearestPoint(w, {0, 0}).norm();
    if (d > reach_m_) continue;
    walls_.push_back(w);
    wall_r_.push_back(radiusWith(bare, margin_m, d));
  }
  field_ = input.field;
  if (field_ != nullptr) field_r_ = radiusWith(bare, margin_m, field_->clearance(pose_.x, pose_.y));
}

Surroundings::Gap Surroundings::movingGap(int k, double x, double y) const {
  if (movers_ == 0) return {std::numeric_limits<double>::infinity(), -1};
  const auto at = static_cast<size_t>(k) * static_cast<size_t>(movers_);
  const auto all = gaps(mover_x_.data() + at, mover_y_.data() + at, mover_r_.data() + at, movers_, x, y);
  const double least = static_cast<double>(all.minCoeff());
  if (least >= 0) return {least, -1};
  Eigen::Index which = 0;
  all.minCoeff(&which);
  return {least, mover_id_[static_cast<size_t>(which)]};
}

double Surroundings::staticGap(double x, double y) const {
  double gap = std::numeric_limits<double>::infinity();
  const auto n = static_cast<Eigen::Index>(point_x_.size());
  if (n > 0) gap = static_cast<double>(gaps(point_x_.data(), point_y_.data(), point_r_.data(), n, x, y).minCoeff());
  for (size_t i = 0; i < walls_.size(); ++i)
    gap = std::min(gap, (nearestPoint(walls_[i], {x, y}) - TPoint2D(x, y)).norm() - wall_r_[i]);
  if (field_ != nullptr)
    gap = std::min(gap, field_->clearance(pose_.x + cos_ * x - sin_ * y, pose_.y + sin_ * x + cos_ * y) - field_r_);
  return gap;
}

void Surroundings::follow(std::span<const double> unit_x, std::span<const double> unit_y, Rollout& r) const {
  r.free_s = r.gap_m = std::numeric_limits<double>::infinity();
  r.touched = -1;
  int next_static = 1, next_moving = 1;
  for (int k = 1; k <= steps_; k = std::min(next_static, next_moving)) {
    const auto i = static_cast<size_t>(k);
    const double x = r.v * unit_x[i], y = r.v * unit_y[i];
    const auto after = [&](double gap, double speed) {
      const double steps = gap / (speed * step_s_);
      return steps < steps_ ? k + std::max(1, static_cast<int>(steps)) : steps_ + 1;
    };
    if (k == next_moving) {
      const Gap gap = movingGap(k, x, y);
      r.gap_m = std::min(r.gap_m, gap.m);
      if (gap.m < 0) r.touched = gap.index;
      next_moving = after(gap.m, r.v + fastest_);
    }
    if (k == next_static) {
      const double gap = staticGap(x, y);
      r.gap_m = std::min(r.gap_m, gap);
      if (gap < 0) r.touched = -1;
      next_static = after(gap, r.v);
    }
    if (r.gap_m < 0) {
      r.free_s = (k - 1) * step_s_;
      return;
    }
  }
}

/// Whether a moving obstacle that goes on as in the last step of the look-ahead comes over a place within as much time.
bool Surroundings::isPassed(double x, double y) const {
  const auto end = static_cast<size_t>(steps_) * static_cast<size_t>(movers_),
             before = end - static_cast<size_t>(movers_);
  for (size_t i = 0; i < static_cast<size_t>(movers_); ++i) {
    const TPoint2D at(mover_x_[end + i], mover_y_[end + i]), from(mover_x_[before + i], mover_y_[before + i]);
    const TPoint2D to = at + (at - from) * static_cast<double>(steps_);
    const double r = mover_r_[end + i];
    const TPoint2D d = nearestPoint({at, to}, {x, y}) - TPoint2D(x, y);
    if (d.x * d.x + d.y * d.y < r * r) return true;
  }
  return false;
}

bool Surroundings::canStop(std::span<const double> unit_x, std::span<const double> unit_y, const Rollout& r,
                           double period_s, double brake) const {
  const double braking_s = r.v / brake;
  // Where on the arc after so many steps: as far as at speed v in `at` steps.
  const auto place = [&](double steps) {
    const double braked_s = std::clamp(steps * step_s_ - period_s, 0.0, braking_s);
    const double lost_s = r.v > 0 ? 0.5 * brake * braked_s * braked_s / r.v : 0;
    const double at = std::min((std::min(steps * step_s_, period_s + braking_s) - lost_s) / step_s_, 1.0 * steps_);
    const size_t i = std::min(static_cast<size_t>(at), unit_x.size() - 2);
    const double part = at - static_cast<double>(i);
    return TPoint2D(r.v * (unit_x[i] + part * (unit_x[i + 1] - unit_x[i])),
                    r.v * (unit_y[i] + part * (unit_y[i + 1] - unit_y[i])));
  };
  int next_static = 1, next_moving = 1;
  for (int k = 1; k <= steps_; k = std::min(next_static, next_moving)) {
    const TPoint2D p = place(k);
    const auto after = [&](double gap, double speed) {
      const double steps = gap / (speed * step_s_);
      return steps < steps_ ? k + std::max(1, static_cast<int>(steps)) : steps_ + 1;
    };
    const double v = std::clamp(r.v - brake * (k * step_s_ - period_s), 0.0, r.v);
    if (k == next_moving) {
      const double gap = movingGap(k, p.x, p.y).m;
      if (gap < 0) return false;
      next_moving = after(gap, v + fastest_);
    }
    if (k == next_static) {
      const double gap = staticGap(p.x, p.y);
      if (gap < 0) return false;
      next_static = after(gap, v);
    }
  }
  const TPoint2D end = place(steps_);
  return !isPassed(end.x, end.y);
}

}  // namespace sidestep
