// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "maps/nearest_reachable.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <tuple>

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

struct Cell {
  int x = 0, y = 0;
  bool operator<(const Cell& o) const { return std::tie(y, x) < std::tie(o.y, o.x); }
};

/// Dijkstra's algorithm over the free cells around a position.
class Search {
 public:
  Search(const DistanceField& field, double max_distance_m) : field_(field), most_m_(max_distance_m) {}

  std::vector<TPoint2D> run(const TPoint2D& from, double clearance_m) {
    const Cell first = cellOf(from);
    if (!isFree(first)) return {};
    reach(first, first, (field_.frame().centre(first.x, first.y) - from).norm());
    while (!open_.empty()) {
      const auto [distance, cell] = open_.top();
      open_.pop();
      if (distance > best_.at(cell).distance) continue;
      if (static_cast<double>(field_.atCell(cell.x, cell.y)) >= clearance_m) return wayTo(cell, from);
      expand(cell, distance);
    }
    return {};
  }
  /// Neighbours of a wall thinner than a cell keep off it by no more than half a cell.
  bool isFree(const Cell& c) const {
    const GridFrame& f = field_.frame();
    return c.x >= 0 && c.y >= 0 && c.x < f.width &&
           c.y<f.height&& static_cast<double>(field_.atCell(c.x, c.y))> 0.501 * f.resolution_m;
  }
  Cell cellOf(const TPoint2D& p) const {
    const GridFrame& f = field_.frame();
    const TPoint2D local = f.T_map_grid.inverseComposePoint(p);
    return {static_cast<int>(std::floor(local.x / f.resolution_m)),
            static_cast<int>(std::floor(local.y / f.resolution_m))};
  }

 private:
  struct Reached {
    double distance;
    Cell before;
  };
  struct Entry {
    double distance;
    Cell cell;
    bool operator<(const Entry& o) const {  // the queue's top is the largest
      return distance > o.distance || (distance == o.distance && o.cell < cell);
    }
  };
  void reach(const Cell& cell, const Cell& before, double distance) {
    if (distance > most_m_) return;
    const auto [it, is_new] = best_.try_emplace(cell, Reached{distance, before});
    if (!is_new && it->second.distance <= distance) return;
    it->second = {distance, before};
    open_.push({distance, cell});
  }
  void expand(const Cell& c, double distance) {
    const double side = field_.frame().resolution_m;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell next{c.x + dx, c.y + dy};
        if ((dx == 0 && dy == 0) || !isFree(next)) continue;
        if (dx != 0 && dy != 0 && !(isFree({c.x + dx, c.y}) && isFree({c.x, c.y + dy}))) continue;
        reach(next, c, distance + side * std::hypot(dx, dy));
      }
  }
  std::vector<TPoint2D> wayTo(Cell cell, const TPoint2D& from) const {
    std::vector<TPoint2D> out;
    for (;;) {
      out.push_back(field_.frame().centre(cell.x, cell.y));
      const Cell before = best_.at(cell).before;
      if (before.x == cell.x && before.y == cell.y) break;
      cell = before;
    }
    out.push_back(from);
    std::reverse(out.begin(), out.end());
    return out;
  }

  const DistanceField& field_;
  double most_m_;
  std::map<Cell, Reached> best_;
  std::priority_queue<Entry> open_;
};

}  // namespace

std::vector<TPoint2D> wayToClearance(const DistanceField& field, const TPoint2D& from, double clearance_m,
                                     double max_distance_m) {
  if (field.clearance(from.x, from.y) >= clearance_m) return {from};
  Search search(field, max_distance_m);
  if (search.isFree(search.cellOf(from))) return search.run(from, clearance_m);
  const double least_m = std::min(clearance_m, field.frame().resolution_m);
  const auto out_of_it = field.nearestFree(from, least_m, max_distance_m);
  if (!out_of_it) return {};
  auto way = Search(field, max_distance_m - (*out_of_it - from).norm()).run(*out_of_it, clearance_m);
  if (!way.empty()) way.insert(way.begin(), from);
  return way;
}

}  // namespace sidestep
