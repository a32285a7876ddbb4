// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/velocity/hrvo.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr int kHalvings = 6;       // of the horizons, before they are given up
constexpr int kGiveWaySteps = 30;  // of the bisection for the shield

double gap(const DiscView& d) { return d.offset.norm() - d.radius_sum; }

}  // namespace

void HrvoParams::visit(ParamVisitor& v) {
  v.choice("kind", kind, {"vo", "rvo", "hrvo"}, "velocity obstacle, reciprocal, or hybrid reciprocal (2.28)");
  v.number("horizon_s", horizon_s, {0.1, 1e6}, "s", "moving obstacles: collisions later than this do not count");
  v.number("wall_horizon_s", wall_horizon_s, {0.1, 1e6}, "s", "the same for walls");
  v.number("separate_s", separate_s, {0.01, 100}, "s", "an overlap is to end within this time");
  v.number("margin_m", margin_m, {0, 10}, "m", "kept free around each obstacle");
  v.number("sigmas", sigmas, {0, 10}, "sd", "moving obstacles grow by this many sd of their position");
  v.number("velocity_sd", velocity_sd, {0, 5}, "m/s", "doubt about moving obstacles' velocities: widens their cones");
  v.number("share", share, {0, 1}, "", "of the avoiding that is the robot's; 1: obstacles are taken to be blind");
  v.number("keep_right", keep_right, {0, 5}, "m/s", "how fast it must already be passing left to do so");
  v.integer("neighbours", neighbours, {1, 100000}, "the nearest moving obstacles that count");
  v.flag("shield", shield, "never order a velocity that could end in an obstacle within the period");
}

RegionKind HrvoParams::regionKind() const {
  return kind == "vo" ? RegionKind::kVo : kind == "rvo" ? RegionKind::kRvo : RegionKind::kHrvo;
}

Hrvo::Hrvo(const HrvoParams& params) : params_(params), kind_(params.regionKind()) {}

void Hrvo::begin(const TPoint2D& own, double radius_m, double period_s) {
  own_ = own;
  radius_m_ = radius_m;
  period_s_ = period_s;
  discs_.clear();
  walls_.clear();
}

DiscView Hrvo::view(const MovingObstacle& obstacle, const TPoint2D& position) const {
  DiscView d;
  d.offset = obstacle.position - position;
  d.velocity = obstacle.velocity;
  const auto& P = obstacle.covariance;  // its larger eigenvalue, in closed form
  const double mean = 0.5 * (P(0, 0) + P(1, 1)), half = 0.5 * (P(0, 0) - P(1, 1));
  const double variance = mean + std::sqrt(half * half + P(0, 1) * P(1, 0));
  d.radius_sum = radius_m_ + obstacle.radius_m + params_.margin_m + params_.sigmas * std::sqrt(std::max(0.0, variance));
  d.velocity_sd = params_.velocity_sd;
  d.share = params_.share;
  return d;
}

void Hrvo::keepNearest() {
  const auto n = static_cast<size_t>(params_.neighbours);
  if (discs_.size() <= n) return;
  std::nth_element(discs_.begin(), discs_.begin() + static_cast<std::ptrdiff_t>(n), discs_.end(),
                   [](const DiscView& a, const DiscView& b) { return gap(a) < gap(b); });
  discs_.resize(n);
}

void Hrvo::build(double horizon_share) {
  query_.clear();
  for (const auto& d : discs_)
    query_.add(discRegion(kind_, d, own_, params_.horizon_s * horizon_share, params_.separate_s, params_.keep_right));
  for (const auto& w : walls_)
    query_.add(wallRegion(w, radius_m_, params_.wall_horizon_s * horizon_share, params_.separate_s));
}

/// Shields that forbid something, moved back by `give_way` [m/s].
void Hrvo::addShields(double v_max, double give_way) {
  for (const auto& d : discs_) {
    VelocityRegion r = shieldRegion(d, period_s_);
    for (auto& s : r.sides) s.c += give_way;
    if (r.sides[0].c >= v_max) continue;
    r.edges[0].from = {r.sides[0].nx * r.sides[0].c, r.sides[0].ny * r.sides[0].c};
    query_.add(r);
  }
}

HrvoAnswer Hrvo::solve(const TPoint2D& preferred, double v_max) {
  preferred_ = preferred;
  v_max_ = v_max;
  keepNearest();
  VelocityCandidate best;
  double horizon_share = 1;
  for (int i = 0; i < kHalvings; ++i, horizon_share /= 2) {
    build(horizon_share);
    if (params_.shield) addShields(v_max, 0);
    if (query_.nearest(preferred, v_max, best)) return {best.velocity, best.distance, horizon_share, 0};
  }
  return giveWay(preferred, v_max);
}

/// Only the shield is left, and if that excludes all, as little less of it as leaves a velocity.
HrvoAnswer Hrvo::giveWay(const TPoint2D& preferred, double v_max) {
  VelocityCandidate best;
  const auto holds = [&](double give_way) {
    query_.clear();
    addShields(v_max, give_way);
    return query_.nearest(preferred, v_max, best);
  };
  if (holds(0)) return {best.velocity, best.distance, 0, 0};
  double low = 0, high = v_max;
  while (!holds(high) && high < 1e6) high *= 2;
  for (int i = 0; i < kGiveWaySteps; ++i) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? high : low) = middle;
  }
  holds(high);
  return {best.velocity, best.distance, 0, high};
}

void Hrvo::candidates(std::vector<VelocityCandidate>& out) { query_.candidates(preferred_, v_max_, out); }

std::string Hrvo::regionName(int region) const {
  const int discs = static_cast<int>(discs_.size()), walls = static_cast<int>(walls_.size());
  if (region < 0) return "";
  if (region < discs) return "moving obstacle " + std::to_string(region);
  return region < discs + walls ? "wall " + std::to_string(region - discs) : "shield";
}

}  // namespace sidestep
