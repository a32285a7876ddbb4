// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/global/grid_search.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"

namespace sidestep {
namespace {

constexpr uint32_t kNumberShift = 6, kClosed = 32, kMoveMask = 31, kNoMove = 31;
constexpr uint32_t kLastNumber = (1u << (32 - kNumberShift)) - 1;
constexpr uint32_t kCostLimit = UINT32_MAX - BucketQueue::kRange;

constexpr uint32_t bit(uint32_t move) { return 1u << (move & 7); }

/// Moves worth trying after `d` if all around is free: a straight one goes on, a diagonal one also turns by 45 deg.
constexpr uint32_t naturalMoves(uint32_t d) { return d % 2 == 0 ? bit(d) : bit(d) | bit(d + 1) | bit(d - 1); }

}  // namespace

void GridSearchParams::visit(ParamVisitor& v) {
  v.integer("neighbours", neighbours, {8, 16}, "8 or 16 moves from each cell");
  v.number("clearance_weight", clearance_weight, {0, 10}, "",
           "price of tight places: a move at the least clearance costs 1 + this, a move at comfort_m 1");
  v.number("comfort_m", comfort_m, {0, 1000}, "m", "clearance from which there is no price");
}

GridSearch::GridSearch(std::shared_ptr<const PlanningGrid> grid, const GridSearchParams& params)
    : grid_(std::move(grid)), params_(params), nodes_(grid_->size(), Node{0, 0}) {
  if (params.neighbours != 8 && params.neighbours != 16)
    throw ConfigError("neighbours = " + std::to_string(params.neighbours) + ", allowed 8, 16");
  constexpr int kX[8] = {1, 1, 0, -1, -1, -1, 0, 1}, kY[8] = {0, 1, 1, 1, 0, -1, -1, -1};
  for (int k = 0; k < 16; ++k) {
    const int next = (k + 1) % 8;
    dx_[k] = k < 8 ? kX[k] : kX[k - 8] + kX[next];
    dy_[k] = k < 8 ? kY[k] : kY[k - 8] + kY[next];
    steps_[k] = dy_[k] * grid_->stride() + dx_[k];
  }
  if (params.clearance_weight > 0) setPrices();
}

void GridSearch::setPrices() {
  prices_.assign(grid_->size(), 0);
  const double least = grid_->clearance(), comfort = params_.comfort_m;
  for (uint32_t cell = 0; cell < grid_->size(); ++cell) {
    if (!grid_->isFree(cell)) continue;
    const double lack = (comfort - grid_->distanceAt(cell)) / std::max(1e-9, comfort - least);
    if (lack > 0) prices_[cell] = static_cast<uint16_t>(std::lround(256 * params_.clearance_weight * lack * lack));
  }
}

/// Costs on an empty grid. Knights: with a >= b the displacements, b knight's and a - 2b straight moves if a >= 2b,
/// else a - b knight's and 2b - a diagonal ones.
template <bool kAstar, bool kKnights>
inline uint32_t GridSearch::estimate(int x, int y, const Goal& goal) const {
  if constexpr (!kAstar) return 0;
  const auto dx = static_cast<uint32_t>(std::abs(x - goal.x)), dy = static_cast<uint32_t>(std::abs(y - goal.y));
  const uint32_t a = std::max(dx, dy), b = std::min(dx, dy);
  if constexpr (!kKnights) return kStraight * (a - b) + kDiagonal * b;
  return a >= 2 * b ? kKnight * b + kStraight * (a - 2 * b) : kKnight * (a - b) + kDiagonal * (2 * b - a);
}

/// The moves after `d` that no other way of the same length, diagonal first and round this cell, makes needless. Beside
/// a straight move a turn is needed only where the cell beside the one before is blocked.
inline uint32_t GridSearch::canonicalMoves(uint32_t cell, uint32_t d) const {
  if (d == kNoMove) return 0xff;
  uint32_t out = naturalMoves(d);
  if (d % 2 != 0) return out;
  const uint32_t before = grid_->allMoves()[cell - static_cast<uint32_t>(steps_[d])];
  if ((before & bit(d + 2)) == 0) out |= bit(d + 2) | bit(d + 1);
  if ((before & bit(d - 2)) == 0) out |= bit(d - 2) | bit(d - 1);
  return out;
}

/// Bit 8 + k: the move between moves k and k + 1. It stays inside of two squares of centres, free if their diagonals
/// are.
inline uint32_t GridSearch::knightMoves(uint32_t cell) const {
  const uint8_t* moves = grid_->allMoves();
  uint32_t out = 0;
  for (uint32_t k = 0; k < 8; ++k) {
    const uint32_t diagonal = k % 2 != 0 ? k : k + 1, straight = (k % 2 != 0 ? k + 1 : k) & 7;
    if ((moves[cell] & bit(diagonal)) == 0) continue;
    if ((moves[cell + static_cast<uint32_t>(steps_[straight])] & bit(diagonal)) != 0) out |= 256u << k;
  }
  return out;
}

void GridSearch::startNumber() {
  if (number_ == kLastNumber) {
    std::fill(nodes_.begin(), nodes_.end(), Node{0, 0});
    number_ = 0;
  }
  ++number_;
  expanded_ = 0;
}

template <bool kAstar, bool kCanonical, bool kKnights, bool kPriced>
bool GridSearch::run(uint32_t start, uint32_t goal_cell) {
  const auto stride = static_cast<uint32_t>(grid_->stride());
  const Goal goal{goal_cell, static_cast<int>(goal_cell % stride), static_cast<int>(goal_cell / stride)};
  const uint8_t* moves = grid_->allMoves();
  const uint32_t tag = number_ << kNumberShift;
  const uint32_t first =
      estimate<kAstar, kKnights>(static_cast<int>(start % stride), static_cast<int>(start / stride), goal);
  nodes_[start] = {0, tag | kNoMove};
  queue_.clear(first);
  queue_.push(first, start);
  while (!queue_.empty()) {
    const uint32_t cell = queue_.pop().value;
    Node& node = nodes_[cell];
    if ((node.tag & kClosed) != 0) continue;
    const uint32_t g = node.g, came = node.tag & kMoveMask;
    node.tag |= kClosed;
    if (cell == goal.cell) return true;
    ++expanded_;
    uint32_t mask = moves[cell];
    if constexpr (kCanonical) mask &= canonicalMoves(cell, came);
    if constexpr (kKnights) mask |= knightMoves(cell);
    const int y = static_cast<int>(cell / stride), x = static_cast<int>(cell) - y * static_cast<int>(stride);
    for (; mask != 0; mask &= mask - 1) {
      const auto move = static_cast<uint32_t>(std::countr_zero(mask));
      const uint32_t next = cell + static_cast<uint32_t>(steps_[move]);
      uint32_t cost = kKnights && move >= 8 ? kKnight : (move % 2 == 0 ? kStraight : kDiagonal);
      if constexpr (kPriced) cost += cost * (uint32_t{prices_[cell]} + prices_[next]) / 512;
      const uint32_t g_next = g + cost;
      Node& n = nodes_[next];
      if ((n.tag >> kNumberShift) == number_ && n.g <= g_next) continue;
      if (g_next > kCostLimit) continue;
      n = {g_next, tag | move};
      queue_.push(g_next + estimate<kAstar, kKnights>(x + dx_[move], y + dy_[move], goal), next);
    }
  }
  return false;
}

bool GridSearch::search(uint32_t start, uint32_t goal, bool heuristic, std::vector<uint32_t>& cells) {
  startNumber();
  cells.clear();
  const bool priced = !prices_.empty(), knights = params_.neighbours == 16;
  bool found = false;
  if (!heuristic)
    found = knights
                ? (priced ? run<false, false, true, true>(start, goal) : run<false, false, true, false>(start, goal))
                : (priced ? run<false, false, false, true>(start, goal) : run<false, false, false, false>(start, goal));
  else
    found = knights
                ? (priced ? run<true, false, true, true>(start, goal) : run<true, false, true, false>(start, goal))
                : (priced ? run<true, false, false, true>(start, goal) : run<true, true, false, false>(start, goal));
  if (!found) return false;
  cost_ = nodes_[goal].g;
  for (uint32_t cell = goal;;) {
    cells.push_back(cell);
    const uint32_t move = nodes_[cell].tag & kMoveMask;
    if (move == kNoMove) break;
    cell -= static_cast<uint32_t>(steps_[move]);
  }
  std::reverse(cells.begin(), cells.end());
  return true;
}

GridPlanner::GridPlanner(std::shared_ptr<const PlanningGrid> grid, const GridSearchParams& params, bool heuristic)
    : search_(std::move(grid), params), heuristic_(heuristic) {}

GlobalPath GridPlanner::plan(const mrpt::math::TPose2D& start, const mrpt::math::TPose2D& goal) {
  const PlanningGrid& grid = search_.grid();
  auto ends = grid.ends(start, goal);
  if (!ends.ok) return ends.refusal;
  GlobalPath out;
  const bool found = search_.search(ends.start, ends.goal, heuristic_, cells_);
  out.expanded = search_.expanded();
  if (!found) {
    out.reason = "the goal is farther than costs can be counted; use larger cells";
    return out;
  }
  std::vector<mrpt::math::TPoint2D> points = {{start.x, start.y}};
  for (const uint32_t cell : cells_) points.push_back(grid.centre(cell));
  points.emplace_back(goal.x, goal.y);
  out.status = GlobalPath::Status::kFound;
  out.cost = search_.costInCells() * grid.field().frame().resolution_m + (points[1] - points[0]).norm() +
             (points.back() - points[points.size() - 2]).norm();
  out.poses = posesAlong(points, goal.phi);
  return out;
}

}  // namespace sidestep
