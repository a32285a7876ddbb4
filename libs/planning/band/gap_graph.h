// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <vector>

#include "core/params.h"
#include "planning/band/band.h"
#include "planning/band/goal_frame.h"
#include "planning/band/obstacle_view.h"

namespace sidestep {

struct ExplorationParams {
  int classes_max = 4;          ///< bands that are optimized side by side
  double column_m = 0.2;        ///< width of the graph's columns
  double detour_share = 0.6;    ///< how far beside the straight line the graph reaches, of its length
  double detour_least_m = 2.5;  ///< and at least
  double narrow_weight = 12;    ///< cost of a gap too narrow for the wished clearance, 1/m^2 per metre of way

  int states_max = 1000;  ///< of a step of the search in space and time

  void visit(ParamVisitor& v);
};

/// A way from start to goal, one for a class.
struct GapPath {
  std::vector<mrpt::math::TPoint2D> points;  ///< from start to goal, map frame
  double cost = 0;
  mrpt::math::TPoint2D beside;  ///< where it first bends around an obstacle (zeta_p of (4.8)); the goal if nowhere
};

/// The exploration graph of algorithm 2. The plane between start and goal is cut into columns across the straight line;
/// in each, what the robot's disc cannot enter leaves gaps: the nodes. Forward edges join gaps of neighbouring columns
/// that overlap. Two ways through the graph that differ have an obstacle between them, so that every way is a class of
/// its own and the cheapest of them are found without listing all, in O(columns * gaps * classes). Moving obstacles
/// stand in each column where they will be when the robot gets there: the extension in time.
class GapGraph {
 public:
  struct Query {
    GoalFrame frame;
    const ObstacleView* obstacles = nullptr;
    double keep_out = 0.35;   ///< least distance of the robot's centre to an obstacle's edge [m]
    double wished = 0.8;      ///< wished one [m]
    SpeedProfile profile;     ///< when the robot gets to a column
    bool still_only = false;  ///< as if nothing moved
  };

  explicit GapGraph(const ExplorationParams& params) : params_(params) {}

  /// The cheapest ways, cheapest first, at most `classes_max`; empty if there is none. Valid until the next call.
  const std::vector<GapPath>& search(const Query& query);
  size_t found() const { return found_; }

 private:
  struct Gap {
    double low = 0, high = 0;
    bool operator==(const Gap&) const = default;
  };
  /// A way from the start into a gap; `v` is where it enters.
  struct Way {
    double cost = 0, v = 0;
    int gap = -1, way = -1;  ///< it comes from
  };
  struct Blocked {
    int column = 0;
    double low = 0, high = 0;
  };

  void layColumns(const Query& query);
  void blockDisc(const Query& query, double u, double v, double radius, int first, int last);
  void blockStill(const Query& query);
  void blockMoving(const Query& query);
  void blockField(const Query& query);
  void sortBlocked();
  void cutGaps();
  void growWays(const Query& query);
  void offer(int gap, const Way& way);
  void trace(const Query& query, int gap, int way, GapPath& out);
  void pullTaut(size_t n);
  Gap portal(const Gap& a, const Gap& b, double margin) const;
  double columnAt(int column) const { return (column + 0.5) * width_; }

  ExplorationParams params_;
  double width_ = 0.2, side_ = 5;  ///< of a column; half the graph's reach across
  int columns_ = 0;
  std::vector<Blocked> blocked_, sorted_;
  std::vector<int> first_gap_, count_;  ///< first gap of each column; blocked ones of each column
  std::vector<Gap> gaps_, portals_;
  std::vector<Way> ways_;  ///< classes_max for each gap, cheapest first
  std::vector<int> ways_of_;
  std::vector<double> string_;
  std::vector<GapPath> paths_;
  size_t found_ = 0;
};

}  // namespace sidestep
