// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/laser.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLegRadius_m = 0.07, kLegsApart_m = 0.24, kStride_m = 1.4, kSwing_m = 0.3;

}  // namespace

void LaserParams::visit(ParamVisitor& v) {
  v.number("rate_hz", rate_hz, {0, 1000}, "Hz", "scans a second; 0: no laser");
  v.angle("field_deg", field, {1, 360}, "field of view, about the laser's x axis");
  v.integer("beams", beams, {2, 100000}, "in the field, the first and the last at its edges");
  v.number("range_m", range_m, {0.1, 1000}, "m", "nothing farther away is seen");
  v.number("range_sd_m", range_sd_m, {0, 1}, "m", "noise of a range");
  v.number("dropout", dropout, {0, 1}, "", "share of beams that get no echo");
  v.number("x_m", x_m, {-10, 10}, "m", "place on the robot");
  v.number("y_m", y_m, {-10, 10}, "m", "place on the robot");
  v.angle("yaw_deg", yaw, {-360, 360}, "place on the robot");
  v.choice("people", people, {"legs", "discs"}, "what is seen of people");
}

void addLegs(const Person& person, std::vector<SeenDisc>& out) {
  const double phase = 2 * M_PI * person.walked_m / kStride_m;
  const double swing = person.velocity.norm() > 0.05 ? kSwing_m * std::sin(phase) : 0;
  const double c = std::cos(person.heading), s = std::sin(person.heading);
  for (const double side : {0.5, -0.5}) {
    const double across = side * kLegsApart_m, along = 2 * side * swing;
    out.push_back(
        {{person.position.x + c * along - s * across, person.position.y + s * along + c * across}, kLegRadius_m});
  }
}

LaserScanner::LaserScanner(const LaserParams& params) : params_(params), increment_(params.field / (params.beams - 1)) {
  const auto n = static_cast<size_t>(params.beams);
  ranges_.resize(n), cos_.resize(n), sin_.resize(n);
  for (size_t i = 0; i < n; ++i) cos_[i] = std::cos(bearing(i)), sin_[i] = std::sin(bearing(i));
}

/// Calls hit(beam) for the beams between two bearings, which may lie up to a turn apart and beyond +-pi.
template <class Hit>
void LaserScanner::cover(double from, double to, const Hit& hit) {
  const double first_beam = -0.5 * params_.field, margin = 1e-9;
  for (const double turn : {-2 * M_PI, 0.0, 2 * M_PI}) {
    const double a = (from + turn - first_beam) / increment_ - margin,
                 b = (to + turn - first_beam) / increment_ + margin;
    if (b < 0 || a > params_.beams - 1) continue;
    const auto begin = static_cast<size_t>(std::ceil(std::max(a, 0.0)));
    const auto end = static_cast<size_t>(std::floor(std::min(b, static_cast<double>(params_.beams - 1))));
    for (size_t i = begin; i <= end; ++i) hit(i);
  }
}

/// Points in the laser's frame. Along a ray d the wall a + u (b - a) is hit at (a x e) / (d x e), e = b - a.
void LaserScanner::castWall(const TPoint2D& a, const TPoint2D& b) {
  const TPoint2D e = b - a;
  const double top = a.x * e.y - a.y * e.x;
  double from = std::atan2(a.y, a.x), to = std::atan2(b.y, b.x);
  double width = std::remainder(to - from, 2 * M_PI);  // a wall never covers more than half a turn
  if (width < 0) std::swap(from, to), width = -width;
  cover(from, from + width, [&](size_t i) {
    const double down = cos_[i] * e.y - sin_[i] * e.x;
    const double range = down == 0 ? std::min(a.norm(), b.norm()) : top / down;
    if (range >= 0 && range < ranges_[i]) ranges_[i] = range;
  });
}

void LaserScanner::castDisc(const TPoint2D& centre, double radius_m) {
  const double d = centre.norm();
  if (d - radius_m >= params_.range_m) return;
  if (d <= radius_m) {  // inside: everything is at hand
    std::fill(ranges_.begin(), ranges_.end(), 0);
    return;
  }
  const double middle = std::atan2(centre.y, centre.x), half = std::asin(radius_m / d);
  cover(middle - half, middle + half, [&](size_t i) {
    const double along = cos_[i] * centre.x + sin_[i] * centre.y, across = cos_[i] * centre.y - sin_[i] * centre.x;
    const double range = along - std::sqrt(std::max(0.0, radius_m * radius_m - across * across));
    if (range < ranges_[i]) ranges_[i] = range;
  });
}

const std::vector<double>& LaserScanner::cast(const mrpt::math::TPose2D& T_map_base, const WallIndex& walls,
                                              std::span<const SeenDisc> discs) {
  const mrpt::math::TPose2D T_map_laser = T_map_base + mrpt::math::TPose2D(params_.x_m, params_.y_m, params_.yaw);
  const double c = std::cos(T_map_laser.phi), s = std::sin(T_map_laser.phi);
  const auto local = [&](const TPoint2D& p) {
    const double x = p.x - T_map_laser.x, y = p.y - T_map_laser.y;
    return TPoint2D(c * x + s * y, -s * x + c * y);
  };
  std::fill(ranges_.begin(), ranges_.end(), kInfinity);
  walls.near({T_map_laser.x, T_map_laser.y}, params_.range_m, near_);
  for (const uint32_t i : near_) castWall(local(walls.walls()[i].a), local(walls.walls()[i].b));
  for (const auto& disc : discs) castDisc(local(disc.position), disc.radius_m);
  for (double& r : ranges_)
    if (r > params_.range_m) r = kInfinity;
  return ranges_;
}

void LaserScanner::disturb(Random& random) {
  for (double& r : ranges_) {
    if (r == kInfinity) continue;
    if (params_.range_sd_m > 0) r = std::max(0.0, r + params_.range_sd_m * random.gaussian());
    if (params_.dropout > 0 && random.uniform() < params_.dropout) r = kInfinity;
  }
}

}  // namespace sidestep
