// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/local_goal.h"

#include <cmath>

#include "core/geometry.h"

namespace sidestep {

void findLocalGoal(const PlanInput& input, double horizon_m, LocalGoal& out) {
  out.way.clear();
  out.pose = input.goal;
  out.is_goal = true;
  out.heading_free = !input.goal_heading_matters;
  const auto& path = input.path;
  if (path.empty()) return;
  const size_t at = nearestPose(path, pointOf(input.pose));
  out.way.push_back({input.pose.x, input.pose.y});
  double length = std::hypot(path[at].x - input.pose.x, path[at].y - input.pose.y);
  for (size_t i = at; i < path.size(); ++i) {
    if (i > at) length += std::hypot(path[i].x - path[i - 1].x, path[i].y - path[i - 1].y);
    out.way.push_back({path[i].x, path[i].y});
    if (length < horizon_m || i + 1 == path.size()) continue;
    const auto& next = path[i + 1];
    out.pose = {path[i].x, path[i].y, std::atan2(next.y - path[i].y, next.x - path[i].x)};
    out.is_goal = false;
    out.heading_free = true;
    return;
  }
  out.way.push_back({input.goal.x, input.goal.y});
}

}  // namespace sidestep
