// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/world_record.h"

#include <algorithm>
#include <cmath>

#include "evaluation/metrics/collision_index.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr double kFigurePeriod_s = 0.1, kStanding = 0.01;

}  // namespace

WorldRecorder::WorldRecorder(const World& world) : world_(world) {
  figure_.period_s = kFigurePeriod_s;
  figure_.goal = {world.underTest().goal.x, world.underTest().goal.y};
  figure_.walls.assign(world.walls().walls().begin(), world.walls().walls().end());
  for (size_t i = 0; i < world.robots().size(); ++i)
    figure_.paths.push_back(
        {world.params().robot_names[i], world.robots()[i].radius_m, i == world.robotUnderTest(), {}});
  for (const Person& p : world.people()) figure_.paths.push_back({std::to_string(p.id), p.radius_m, false, {}});
  largest_index_ = index_ = collisionIndexNow();
  notePlaces();
}

void WorldRecorder::note() {
  clearance_m_ = std::min(clearance_m_, world_.contacts(world_.robotUnderTest()).clearance());
  const double index = collisionIndexNow(), step_s = world_.params().step_s;
  largest_index_ = std::max(largest_index_, index);
  index_ = std::max(index_, index);
  if (index > kCollisionIndexThreshold) above_s_ += step_s;
  if (std::abs(world_.underTest().twist.vx) < kStanding) standing_s_ += step_s;
  notePlaces();
}

/// The index falls with the distance, so that the nearest one has the largest.
double WorldRecorder::collisionIndexNow() const {
  const auto& robots = world_.robots();
  const TPoint2D self(world_.underTest().pose.x, world_.underTest().pose.y);
  TPoint2D nearest(std::numeric_limits<double>::infinity(), 0);
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const TPoint2D& p) {
    const TPoint2D d = p - self;
    if (const double d2 = d.x * d.x + d.y * d.y; d2 < least) least = d2, nearest = p;
  };
  for (const Person& p : world_.people())
    if (p.present) look(p.position);
  for (size_t i = 0; i < robots.size(); ++i)
    if (i != world_.robotUnderTest()) look({robots[i].pose.x, robots[i].pose.y});
  if (!std::isfinite(least)) return 0;
  return collisionIndex(self, {&nearest, 1});
}

void WorldRecorder::notePlaces() {
  if (world_.time() + 1e-9 < next_s_) return;
  next_s_ += kFigurePeriod_s;
  size_t k = 0;
  for (const RobotState& r : world_.robots()) figure_.paths[k++].places.emplace_back(r.pose.x, r.pose.y);
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  for (const Person& p : world_.people())
    figure_.paths[k++].places.push_back(p.present ? p.position : TPoint2D(kNowhere, kNowhere));
  const RobotState& robot = world_.underTest();
  timeline_.push_back({world_.time(), deltaMin(clearance_m_), robot.twist.vx, robot.twist.omega, index_});
  index_ = 0;
  clearance_m_ = std::numeric_limits<double>::infinity();
}

}  // namespace sidestep
