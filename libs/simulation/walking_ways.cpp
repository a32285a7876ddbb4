// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/walking_ways.h"

#include <cmath>
#include <limits>
#include <queue>

#include "maps/nearest_reachable.h"
#include "maps/wall_clearances.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr double kCell_m = 0.2;
constexpr double kLeastRoom_m = 0.15;  ///< from a person's middle to a wall: shoulders turn in narrow places
constexpr double kComfort_m = 0.5;     ///< below this a way is up to twice as dear
constexpr double kShoulder_m = 0.2;    ///< sight is as wide as this to both sides
constexpr double kToFree_m = 2;        ///< so far is a free cell looked for
constexpr int kAhead = 15;             ///< cells of the way that are looked at: 3 m
constexpr size_t kMostGoals = 256;     ///< whose distances are kept

}  // namespace

TPoint2D WalkingWays::towards(const TPoint2D& from, const TPoint2D& goal, const WallIndex& walls) {
  if (inSight(from, goal, walls)) return goal;
  if (!field_) buildMap(walls);
  const auto goal_cell = freeCellAt(goal), start = freeCellAt(from);
  if (!goal_cell || !start) return goal;
  const Distances& distances = distancesTo(*goal_cell);
  if (!std::isfinite(distances[*start])) return goal;
  size_t cell = *start;
  TPoint2D out = centre(cell);
  for (int k = 0; k < kAhead && cell != *goal_cell; ++k) {
    cell = nextCell(cell, distances);
    if (!inSight(from, centre(cell), walls)) break;
    out = centre(cell);
  }
  return out;
}

/// Whether somebody can walk straight from a to b.
bool WalkingWays::inSight(const TPoint2D& a, const TPoint2D& b, const WallIndex& walls) {
  if (walls.walls().empty()) return true;
  const TPoint2D along = b - a;
  const double length = along.norm();
  if (length < 1e-9) return true;
  const TPoint2D side(-along.y * kShoulder_m / length, along.x * kShoulder_m / length);
  return !walls.blocks(a, b, near_) && !walls.blocks(a + side, b + side, near_) &&
         !walls.blocks(a - side, b - side, near_);
}

void WalkingWays::buildMap(const WallIndex& walls) {
  field_ = std::make_unique<DistanceField>(WallClearances(walls.walls(), {}, kCell_m, kComfort_m).field());
}

/// The cell of a position, or the one from which there is a way to it through no wall.
std::optional<size_t> WalkingWays::freeCellAt(const TPoint2D& p) const {
  const GridFrame& f = field_->frame();
  const auto inside = [&f](double v, double low, int cells) {
    return std::clamp(v, low + 0.5 * f.resolution_m, low + (cells - 0.5) * f.resolution_m);
  };
  const TPoint2D at(inside(p.x, f.T_map_grid.x, f.width), inside(p.y, f.T_map_grid.y, f.height));
  const auto way = wayToClearance(*field_, at, kLeastRoom_m, kToFree_m);
  if (way.empty()) return std::nullopt;
  const auto cell = [](double off_m, double side_m, int cells) {
    return static_cast<size_t>(std::clamp(std::floor(off_m / side_m), 0.0, cells - 1.0));
  };
  const size_t x = cell(way.back().x - f.T_map_grid.x, f.resolution_m, f.width);
  const size_t y = cell(way.back().y - f.T_map_grid.y, f.resolution_m, f.height);
  return y * static_cast<size_t>(f.width) + x;
}

TPoint2D WalkingWays::centre(size_t cell) const {
  const auto width = static_cast<size_t>(field_->frame().width);
  return field_->frame().centre(static_cast<int>(cell % width), static_cast<int>(cell / width));
}

double WalkingWays::roomAt(size_t cell) const {
  const auto width = static_cast<size_t>(field_->frame().width);
  return static_cast<double>(field_->atCell(static_cast<int>(cell % width), static_cast<int>(cell / width)));
}

/// Calls use(neighbour, length [cells]) for the cells to which a step leads, round no corner.
template <class Use>
void WalkingWays::eachNeighbour(size_t cell, const Use& use) const {
  const GridFrame& f = field_->frame();
  const int x = static_cast<int>(cell) % f.width, y = static_cast<int>(cell) / f.width;
  const auto is_free = [&](int ix, int iy) {
    return ix >= 0 && iy >= 0 && ix < f.width && iy < f.height &&
           static_cast<double>(field_->atCell(ix, iy)) >= kLeastRoom_m;
  };
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      if ((dx == 0 && dy == 0) || !is_free(x + dx, y + dy)) continue;
      if (dx != 0 && dy != 0 && !(is_free(x + dx, y) && is_free(x, y + dy))) continue;
      use(static_cast<size_t>((y + dy) * f.width + x + dx), dx != 0 && dy != 0 ? std::sqrt(2.0) : 1.0);
    }
}

/// Dijkstra's algorithm from the goal; steps in tight places cost more.
const WalkingWays::Distances& WalkingWays::distancesTo(size_t goal) {
  const auto known = distances_.find(goal);
  if (known != distances_.end()) return known->second;
  if (distances_.size() >= kMostGoals) distances_.clear();
  const GridFrame& f = field_->frame();
  Distances& out = distances_[goal];
  out.assign(static_cast<size_t>(f.width) * static_cast<size_t>(f.height), std::numeric_limits<float>::infinity());
  using Entry = std::pair<float, size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  out[goal] = 0;
  open.emplace(0.0F, goal);
  while (!open.empty()) {
    const auto [distance, cell] = open.top();
    open.pop();
    if (distance > out[cell]) continue;
    eachNeighbour(cell, [&, from = distance](size_t next, double length) {
      const double lack = std::max(0.0, 1 - roomAt(next) / kComfort_m);
      const auto there = from + static_cast<float>(length * (1 + lack));
      if (there >= out[next]) return;
      out[next] = there;
      open.emplace(there, next);
    });
  }
  return out;
}

size_t WalkingWays::nextCell(size_t cell, const Distances& distances) const {
  size_t out = cell;
  eachNeighbour(cell, [&](size_t next, double) {
    if (distances[next] < distances[out]) out = next;
  });
  return out;
}

}  // namespace sidestep
