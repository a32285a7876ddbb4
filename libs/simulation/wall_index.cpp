// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/wall_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

}  // namespace

WallIndex::WallIndex(std::vector<Segment> walls, double cell_m) : walls_(std::move(walls)), cell_m_(cell_m) {
  if (walls_.empty()) return;
  double x_max = -std::numeric_limits<double>::infinity(), y_max = x_max;
  x_ = y_ = -x_max;
  for (const auto& w : walls_) {
    x_ = std::min({x_, w.a.x, w.b.x}), x_max = std::max({x_max, w.a.x, w.b.x});
    y_ = std::min({y_, w.a.y, w.b.y}), y_max = std::max({y_max, w.a.y, w.b.y});
  }
  cell_m_ = std::max({cell_m_, std::sqrt((x_max - x_) * (y_max - y_) / 1e6), (x_max - x_) / 1e6, (y_max - y_) / 1e6});
  columns_ = static_cast<int>((x_max - x_) / cell_m_) + 1;
  rows_ = static_cast<int>((y_max - y_) / cell_m_) + 1;
  first_.assign(static_cast<size_t>(columns_) * static_cast<size_t>(rows_) + 1, 0);
  for (const bool fill : {false, true}) {
    auto at = first_;  // where the next wall of each cell goes
    for (uint32_t i = 0; i < walls_.size(); ++i) {
      const auto& w = walls_[i];
      const Cells c =
          cells(std::min(w.a.x, w.b.x), std::max(w.a.x, w.b.x), std::min(w.a.y, w.b.y), std::max(w.a.y, w.b.y));
      for (int y = c.y0; y <= c.y1; ++y)
        for (int x = c.x0; x <= c.x1; ++x) {
          if (fill)
            of_cell_[at[cell(x, y)]++] = i;
          else
            ++first_[cell(x, y) + 1];
        }
    }
    if (fill) break;
    for (size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
    of_cell_.resize(first_.back());
  }
}

WallIndex::Cells WallIndex::cells(double x_min, double x_max, double y_min, double y_max) const {
  const auto index = [this](double at, double origin, int count) {
    return static_cast<int>(std::clamp(std::floor((at - origin) / cell_m_), 0.0, static_cast<double>(count - 1)));
  };
  return {index(x_min, x_, columns_), index(x_max, x_, columns_), index(y_min, y_, rows_), index(y_max, y_, rows_)};
}

void WallIndex::box(double x_min, double x_max, double y_min, double y_max, std::vector<uint32_t>& out) const {
  out.clear();
  if (walls_.empty()) return;
  const Cells c = cells(x_min, x_max, y_min, y_max);
  for (int y = c.y0; y <= c.y1; ++y)
    for (int x = c.x0; x <= c.x1; ++x)
      out.insert(out.end(), of_cell_.begin() + first_[cell(x, y)], of_cell_.begin() + first_[cell(x, y) + 1]);
  if (c.x0 == c.x1 && c.y0 == c.y1) return;
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

void WallIndex::near(const TPoint2D& p, double radius_m, std::vector<uint32_t>& out) const {
  box(p.x - radius_m, p.x + radius_m, p.y - radius_m, p.y + radius_m, out);
}

bool WallIndex::blocks(const TPoint2D& a, const TPoint2D& b, std::vector<uint32_t>& scratch) const {
  box(std::min(a.x, b.x), std::max(a.x, b.x), std::min(a.y, b.y), std::max(a.y, b.y), scratch);
  return std::any_of(scratch.begin(), scratch.end(), [&](uint32_t i) { return intersect(walls_[i], {a, b}); });
}

}  // namespace sidestep
