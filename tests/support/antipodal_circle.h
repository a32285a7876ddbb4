// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "planning/velocity/hrvo.h"

namespace sidestep::support {

struct CircleSetup {
  double radius_m = 0.3, speed = 1, apart_m = 1.5, period_s = 0.25, sight_m = 30, arrived_m = 0.25;
  double patience_s = 1000;
  HrvoParams hrvo = defaultHrvo();

  static HrvoParams defaultHrvo() {
    HrvoParams p;
    p.margin_m = 0;
    p.neighbours = 50;
    p.horizon_s = 1e6;
    return p;
  }
};

struct CircleResult {
  int arrived = 0, colliding_pairs = 0;
  double least_gap_m = std::numeric_limits<double>::infinity(), time_s = 0;
  long queries = 0, shortened = 0;
};

/// Least distance of two points that move straight during `dt` [m].
inline double leastDistance(const mrpt::math::TPoint2D& offset, const mrpt::math::TPoint2D& relative, double dt) {
  const double v2 = relative.x * relative.x + relative.y * relative.y;
  const double t = v2 > 0 ? std::clamp(-(offset.x * relative.x + offset.y * relative.y) / v2, 0.0, dt) : 0;
  return (offset + relative * t).norm();
}

/// `n` holonomic discs on a circle, neighbours `apart_m` apart, each with the opposite place as its goal; all decide at
/// once, every `period_s`, and move straight in between. Distances are exact in continuous time.
inline CircleResult antipodalCircle(int n, const CircleSetup& setup) {
  struct Agent {
    mrpt::math::TPoint2D position, velocity, goal, next;
  };
  std::vector<Agent> agents(static_cast<size_t>(n));
  const double R = 0.5 * setup.apart_m / std::sin(M_PI / n);
  for (int i = 0; i < n; ++i) {
    const double a = 2 * M_PI * i / n;
    auto& agent = agents[static_cast<size_t>(i)];
    agent.position = {R * std::cos(a), R * std::sin(a)};
    agent.goal = agent.position * -1.0;
  }
  Hrvo hrvo(setup.hrvo);
  CircleResult result;
  std::set<std::pair<size_t, size_t>> touched;
  while (result.arrived < n && result.time_s < setup.patience_s) {
    for (auto& a : agents) {
      hrvo.begin(a.velocity, setup.radius_m, setup.period_s);
      for (const auto& b : agents) {
        const auto offset = b.position - a.position;
        if (&a == &b || offset.norm() > setup.sight_m) continue;
        hrvo.disc({offset, b.velocity, 2 * setup.radius_m, 0, 0.5});
      }
      const auto to_goal = a.goal - a.position;
      const double d = to_goal.norm(), speed = std::min(setup.speed, d / setup.period_s);
      const auto answer = hrvo.solve(d > 0 ? to_goal * (speed / d) : to_goal, setup.speed);
      a.next = answer.velocity;
      ++result.queries;
      result.shortened += answer.horizon_share < 1;
    }
    result.arrived = 0;
    for (size_t i = 0; i < agents.size(); ++i)
      for (size_t j = 0; j < i; ++j) {
        const double gap =
            leastDistance(agents[i].position - agents[j].position, agents[i].next - agents[j].next, setup.period_s) -
            2 * setup.radius_m;
        result.least_gap_m = std::min(result.least_gap_m, gap);
        if (gap < 0) touched.insert({i, j});
      }
    for (auto& a : agents) {
      a.velocity = a.next;
      a.position += a.velocity * setup.period_s;
      result.arrived += (a.goal - a.position).norm() < setup.arrived_m;
    }
    result.time_s += setup.period_s;
  }
  result.colliding_pairs = static_cast<int>(touched.size());
  return result;
}

}  // namespace sidestep::support
