// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "core/params.h"
#include "planning/global/bucket_queue.h"
#include "planning/global/planning_grid.h"

namespace sidestep {

struct GridSearchParams {
  int neighbours = 8;           ///< or 16: with the knight's moves, which keep off corners like the others
  double clearance_weight = 0;  ///< price of going where it is tight: a move at the least clearance costs 1 + this
  double comfort_m = 1;         ///< clearance from which there is no price [m]

  void visit(ParamVisitor& v);
};

/// Shortest paths from cell to cell, by A* (Hart, Nilsson & Raphael 1968) or Dijkstra's algorithm.
///
/// Costs are whole numbers, 985 a straight cell, 1393 diagonal (985 sqrt(2) = 1393.0003) and 2203 for a knight's move
/// (985 sqrt(5) = 2202.53), so that sums are exact and ties are ties. The heuristic is the cost on an empty grid, a
/// metric below all costs, hence admissible and consistent: no cell is opened twice. Without a price and with eight
/// neighbours, A* follows canonical orderings only (diagonal moves first; Harabor & Grastien 2011): of all equally long
/// ways through the open it looks at one.
///
/// The price of clearance: cost = base (1 + weight p), p = mean over both ends of ((comfort - d) / (comfort -
/// clearance))^2 where d < comfort, else 0.
class GridSearch {
 public:
  GridSearch(std::shared_ptr<const PlanningGrid> grid, const GridSearchParams& params);

  /// Whether there is a path; `cells` are then those of the cheapest, start and goal included. The same cells for the
  /// same query, whatever was asked before.
  bool search(uint32_t start, uint32_t goal, bool heuristic, std::vector<uint32_t>& cells);
  double costInCells() const { return static_cast<double>(cost_) / kStraight; }  ///< of the last path found
  uint64_t expanded() const { return expanded_; }                                ///< by the last search
  const PlanningGrid& grid() const { return *grid_; }

  static constexpr uint32_t kStraight = 985, kDiagonal = 1393, kKnight = 2203;

 private:
  struct Node {
    uint32_t g, tag;  ///< tag: number of the search, whether closed, the move that led here
  };
  struct Goal {
    uint32_t cell;
    int x, y;
  };
  template <bool kAstar, bool kCanonical, bool kKnights, bool kPriced>
  bool run(uint32_t start, uint32_t goal);
  template <bool kAstar, bool kKnights>
  uint32_t estimate(int x, int y, const Goal& goal) const;
  uint32_t canonicalMoves(uint32_t cell, uint32_t from_move) const;
  uint32_t knightMoves(uint32_t cell) const;
  void setPrices();
  void startNumber();

  std::shared_ptr<const PlanningGrid> grid_;
  GridSearchParams params_;
  std::vector<Node> nodes_;
  std::vector<uint16_t> prices_;  ///< 256 weight p, a cell; empty without weight
  BucketQueue queue_;
  uint32_t number_ = 0, cost_ = 0;
  uint64_t expanded_ = 0;
  int steps_[16], dx_[16], dy_[16];
};

/// The planners "astar" and "dijkstra".
class GridPlanner final : public GlobalPlanner {
 public:
  GridPlanner(std::shared_ptr<const PlanningGrid> grid, const GridSearchParams& params, bool heuristic);
  GlobalPath plan(const mrpt::math::TPose2D& start, const mrpt::math::TPose2D& goal) override;

 private:
  GridSearch search_;
  bool heuristic_;
  std::vector<uint32_t> cells_;
};

}  // namespace sidestep
