// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "maps/wall_clearances.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr double kAround_m = 1, kMostCells = 4e6;

}  // namespace

WallClearances::WallClearances(std::span<const Segment> walls, std::span<const TPoint2D> also, double resolution_m,
                               double cap_m)
    : cap_m_(cap_m) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  double x_min = kFar, x_max = -kFar, y_min = kFar, y_max = -kFar;
  const auto include = [&](const TPoint2D& p) {
    x_min = std::min(x_min, p.x), x_max = std::max(x_max, p.x);
    y_min = std::min(y_min, p.y), y_max = std::max(y_max, p.y);
  };
  for (const auto& p : also) include(p);
  for (const auto& wall : walls) include(wall.a), include(wall.b);
  if (x_min > x_max) x_min = x_max = y_min = y_max = 0;
  const double wide = x_max - x_min + 2 * kAround_m, high = y_max - y_min + 2 * kAround_m;
  frame_.resolution_m = std::max(resolution_m, std::sqrt(wide * high / kMostCells));
  frame_.T_map_grid = {x_min - kAround_m, y_min - kAround_m, 0};
  frame_.width = 1 + static_cast<int>(wide / frame_.resolution_m);
  frame_.height = 1 + static_cast<int>(high / frame_.resolution_m);
  values_.assign(static_cast<size_t>(frame_.width) * static_cast<size_t>(frame_.height), static_cast<float>(cap_m));
  for (const auto& wall : walls)
    lower(wall.a, wall.b, 0, [&](const TPoint2D& p) { return (nearestPoint(wall, p) - p).norm(); });
}

void WallClearances::addDisc(const TPoint2D& centre, double radius_m) {
  lower(centre, centre, radius_m, [&](const TPoint2D& p) { return (p - centre).norm() - radius_m; });
}

DistanceField WallClearances::field() const {
  DistanceFieldParams params;
  params.cap_m = cap_m_;
  return DistanceField(frame_, std::span<const float>(values_), params);
}

int WallClearances::cell(double off_m, int count) const {
  return static_cast<int>(std::clamp(std::floor(off_m / frame_.resolution_m), 0.0, count - 1.0));
}

/// The cells that something between two corners may bring below the cap.
template <class Distance>
void WallClearances::lower(const TPoint2D& a, const TPoint2D& b, double radius_m, const Distance& distance) {
  const double reach = cap_m_ + radius_m;
  const int x0 = column(std::min(a.x, b.x) - reach), x1 = column(std::max(a.x, b.x) + reach);
  const int y0 = row(std::min(a.y, b.y) - reach), y1 = row(std::max(a.y, b.y) + reach);
  for (int iy = y0; iy <= y1; ++iy)
    for (int ix = x0; ix <= x1; ++ix) {
      float& value = values_[static_cast<size_t>(iy) * static_cast<size_t>(frame_.width) + static_cast<size_t>(ix)];
      value = std::min(value, static_cast<float>(distance(frame_.centre(ix, iy))));
    }
}

}  // namespace sidestep
