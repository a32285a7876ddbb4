// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/velocity/hrvo_sight.h"

#include <algorithm>
#include <cmath>

#include "core/geometry.h"
#include "maps/distance_field.h"

namespace sidestep {

using mrpt::math::TPoint2D;

HrvoSight::HrvoSight(const HrvoParams& params) : params_(params), hrvo_(params) {}

HrvoAnswer HrvoSight::velocity(const PlanInput& input, const TPoint2D& target, double speed) {
  const TPoint2D here{input.pose.x, input.pose.y};
  const TPoint2D own{input.twist.vx * std::cos(input.pose.phi), input.twist.vx * std::sin(input.pose.phi)};
  hrvo_.begin(own, input.limits.radius_m + params_.margin_m, input.period_s);
  for (const auto& m : input.moving) {
    DiscView disc = hrvo_.view(m, here);
    // A robot inside the margin is not driven back by force: the margin gives way to what there is.
    const double bare = input.limits.radius_m + m.radius_m, d = disc.offset.norm();
    disc.radius_sum = std::max(bare, std::min(disc.radius_sum, d - 1e-3));
    hrvo_.disc(disc);
  }
  for (const auto& w : input.walls) hrvo_.wall({w.a - here, w.b - here});
  nearest_m_.fill(std::numeric_limits<double>::infinity());
  addPoints(input);
  addField(input);
  addNearest();
  const TPoint2D way = target - here;
  const double distance = way.norm();
  return hrvo_.solve(distance > 0 ? way * (params_.eagerness * speed / distance) : TPoint2D(0, 0), speed);
}

void HrvoSight::addPoints(const PlanInput& input) {
  const double reach = input.limits.v_max * params_.wall_horizon_s + input.limits.radius_m + params_.margin_m;
  for (const auto& p : input.points) {
    const double dx = p.x - input.pose.x, dy = p.y - input.pose.y, d = std::hypot(dx, dy);
    if (d > reach) continue;
    const int i = static_cast<int>((std::atan2(dy, dx) + M_PI) / (2 * M_PI) * kDirections);
    auto& nearest = nearest_m_[static_cast<size_t>(std::clamp(i, 0, kDirections - 1))];
    nearest = std::min(nearest, d);
  }
}

/// The first obstacle of the map in each direction, by stepping as far as the clearance allows.
void HrvoSight::addField(const PlanInput& input) {
  if (input.field == nullptr) return;
  constexpr double kHit_m = 0.02;
  const double reach = input.limits.v_max * params_.wall_horizon_s + input.limits.radius_m + params_.margin_m;
  if (input.field->clearance(input.pose.x, input.pose.y) > reach) return;
  for (int i = 0; i < kDirections; ++i) {
    const double a = (i + 0.5) / kDirections * 2 * M_PI - M_PI, c = std::cos(a), s = std::sin(a);
    double d = 0, gap = 0;
    do {
      gap = input.field->clearance(input.pose.x + d * c, input.pose.y + d * s);
      d += std::max(gap, kHit_m);
    } while (gap > kHit_m && d < reach);
    auto& nearest = nearest_m_[static_cast<size_t>(i)];
    if (gap <= kHit_m) nearest = std::min(nearest, d);
  }
}

void HrvoSight::addNearest() {
  for (int i = 0; i < kDirections; ++i) {
    const double d = nearest_m_[static_cast<size_t>(i)];
    if (!std::isfinite(d)) continue;
    const double a = (i + 0.5) / kDirections * 2 * M_PI - M_PI, half = d * M_PI / kDirections;
    const TPoint2D at{d * std::cos(a), d * std::sin(a)}, side{-half * std::sin(a), half * std::cos(a)};
    hrvo_.wall({at - side, at + side});
  }
}

}  // namespace sidestep
