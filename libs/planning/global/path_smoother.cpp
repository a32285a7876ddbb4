// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/global/path_smoother.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kBend = 0.1, kTension = 0.05, kPush = 0.3;
constexpr double kSampling = 0.1;  // [m]

TPoint2D at(const TPose2D& p) { return {p.x, p.y}; }

/// Points on the path, corners included, none farther apart than `step`.
std::vector<TPoint2D> subdivided(const std::vector<TPose2D>& poses, double step) {
  std::vector<TPoint2D> out = {at(poses.front())};
  for (size_t i = 1; i < poses.size(); ++i) {
    const TPoint2D a = at(poses[i - 1]), d = at(poses[i]) - a;
    const int n = std::max(1, static_cast<int>(std::ceil(d.norm() / step)));
    for (int k = 1; k <= n; ++k) out.push_back(a + d * (static_cast<double>(k) / n));
  }
  return out;
}

/// Leaves out points that crowd, where the piece over them keeps the clearance.
std::vector<TPoint2D> thinned(const std::vector<TPoint2D>& points, double step, const DistanceField& field,
                              double clearance_m) {
  std::vector<TPoint2D> out = {points.front()};
  for (size_t i = 1; i + 1 < points.size(); ++i) {
    const bool crowds = (points[i + 1] - out.back()).norm() < 1.5 * step;
    if (!crowds || !field.visible(out.back(), points[i + 1], clearance_m)) out.push_back(points[i]);
  }
  out.push_back(points.back());
  return out;
}

/// Points every `step` along the path, the end as well.
std::vector<TPoint2D> sampled(const std::vector<TPose2D>& poses, double step) {
  std::vector<TPoint2D> out = {at(poses.front())};
  double left = step;
  for (size_t i = 1; i < poses.size(); ++i) {
    const TPoint2D a = at(poses[i - 1]), d = at(poses[i]) - a;
    const double length = d.norm();
    double s = left;
    for (; s <= length; s += step) out.push_back(a + d * (s / length));
    left = s - length;
  }
  out.push_back(at(poses.back()));
  return out;
}

TPoint2D moved(const std::vector<TPoint2D>& p, size_t i, const DistanceField& field, double wanted) {
  TPoint2D gradient;
  const double lack = std::max(0.0, wanted - field.clearance(p[i].x, p[i].y, gradient));
  TPoint2D out = p[i] - (p[i] * 2.0 - p[i - 1] - p[i + 1]) * kTension + gradient * (kPush * lack);
  if (i >= 2 && i + 2 < p.size())
    out = out - (p[i - 2] - p[i - 1] * 4.0 + p[i] * 6.0 - p[i + 1] * 4.0 + p[i + 2]) * kBend;
  return out;
}

double turn(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c) {
  const TPoint2D u = b - a, v = c - b;
  return std::abs(std::atan2(u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y));
}

}  // namespace

void SmoothingParams::visit(ParamVisitor& v) {
  v.number("step_m", step_m, {0.01, 10}, "m", "between the points of the smooth path");
  v.number("margin_m", margin_m, {0, 10}, "m", "clearance that is sought beyond the one that is kept");
  v.integer("rounds", rounds, {0, 10000}, "of moving all points once");
}

std::vector<TPose2D> smoothPath(const DistanceField& field, double clearance_m, const SmoothingParams& params,
                                const std::vector<TPose2D>& poses) {
  if (poses.size() < 2) return poses;
  auto points = thinned(subdivided(poses, params.step_m), params.step_m, field, clearance_m);
  for (int round = 0; round < params.rounds; ++round)
    for (size_t i = 1; i + 1 < points.size(); ++i) {
      const TPoint2D next = moved(points, i, field, clearance_m + params.margin_m);
      if (field.visible(points[i - 1], next, clearance_m) && field.visible(next, points[i + 1], clearance_m))
        points[i] = next;
    }
  std::vector<TPose2D> out;
  for (size_t i = 0; i + 1 < points.size(); ++i) {
    const TPoint2D d = points[i + 1] - points[i];
    out.emplace_back(points[i].x, points[i].y, std::atan2(d.y, d.x));
  }
  out.push_back(poses.back());
  return out;
}

PathQuality pathQuality(const DistanceField& field, const std::vector<TPose2D>& poses) {
  PathQuality out;
  if (poses.empty()) return out;
  out.clearance_m = field.clearance(poses[0].x, poses[0].y);
  for (size_t i = 1; i < poses.size(); ++i) {
    out.length_m += (at(poses[i]) - at(poses[i - 1])).norm();
    out.clearance_m = field.lowestAlong(at(poses[i - 1]), at(poses[i]), out.clearance_m);
    if (i + 1 < poses.size()) out.turning_rad += turn(at(poses[i - 1]), at(poses[i]), at(poses[i + 1]));
  }
  const auto points = sampled(poses, kSampling);
  for (const auto& p : points) out.mean_clearance_m += field.clearance(p.x, p.y) / static_cast<double>(points.size());
  for (size_t i = 1; i + 1 < points.size(); ++i) {
    const double curvature = turn(points[i - 1], points[i], points[i + 1]) / kSampling;
    out.bending += curvature * curvature / static_cast<double>(points.size() - 2);
  }
  return out;
}

}  // namespace sidestep
