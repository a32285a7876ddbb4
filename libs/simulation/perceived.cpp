// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/perceived.h"

#include <cmath>

#include "core/geometry.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

/// Whether the line from a to b comes within the disc.
bool crosses(const TPoint2D& a, const TPoint2D& b, const TPoint2D& centre, double radius_m) {
  const TPoint2D d = nearestPoint({a, b}, centre) - centre;
  return d.x * d.x + d.y * d.y < radius_m * radius_m;
}

}  // namespace

void PerceptionParams::visit(ParamVisitor& v) {
  v.number("range_m", range_m, {0, 1e6}, "m", "who is farther away is not perceived");
  v.angle("field_deg", field, {0, 360}, "field of view, about the robot's heading");
  v.flag("occlusion", occlusion, "who is hidden by walls or others is not perceived");
  v.number("position_sd_m", position_sd_m, {0, 10}, "m", "noise of x and of y");
  v.number("velocity_sd", velocity_sd, {0, 10}, "m/s", "noise of vx and of vy");
}

bool Perception::inView(const mrpt::math::TPose2D& pose, const MovingObstacle& o) const {
  const double dx = o.position.x - pose.x, dy = o.position.y - pose.y;
  const double bearing = std::remainder(std::atan2(dy, dx) - pose.phi, 2 * M_PI);
  return std::abs(bearing) <= 0.5 * params_.field + 1e-12;
}

bool Perception::hidden(const TPoint2D& eye, size_t index, std::span<const MovingObstacle> all,
                        const WallIndex& walls) {
  const MovingObstacle& o = all[index];
  const TPoint2D to = o.position - eye;
  const double distance = to.norm();
  if (distance <= o.radius_m) return false;
  const TPoint2D across(-to.y / distance * 0.95 * o.radius_m, to.x / distance * 0.95 * o.radius_m);
  for (const double side : {0.0, 1.0, -1.0}) {
    const TPoint2D edge(o.position.x + side * across.x, o.position.y + side * across.y);
    bool blocked = walls.blocks(eye, edge, scratch_);
    for (const uint32_t k : near_) {
      if (blocked) break;
      blocked = k != index && (all[k].position - eye).norm() < distance &&
                crosses(eye, edge, all[k].position, all[k].radius_m);
    }
    if (!blocked) return false;
  }
  return true;
}

void Perception::perceive(const mrpt::math::TPose2D& pose, std::span<const MovingObstacle> all, const WallIndex& walls,
                          std::vector<MovingObstacle>& out) {
  out.clear();
  near_.clear();
  for (uint32_t i = 0; i < all.size(); ++i)
    if (std::hypot(all[i].position.x - pose.x, all[i].position.y - pose.y) <= params_.range_m) near_.push_back(i);
  for (const uint32_t i : near_) {
    if (!inView(pose, all[i])) continue;
    if (params_.occlusion && hidden({pose.x, pose.y}, i, all, walls)) continue;
    MovingObstacle& seen = out.emplace_back(all[i]);
    if (params_.position_sd_m > 0) {
      seen.position.x += params_.position_sd_m * random_.gaussian();
      seen.position.y += params_.position_sd_m * random_.gaussian();
      seen.covariance = Eigen::Matrix2d::Identity() * params_.position_sd_m * params_.position_sd_m;
    }
    if (params_.velocity_sd > 0) {
      seen.velocity.x += params_.velocity_sd * random_.gaussian();
      seen.velocity.y += params_.velocity_sd * random_.gaussian();
    }
  }
}

}  // namespace sidestep
