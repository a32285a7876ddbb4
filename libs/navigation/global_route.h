// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <vector>

#include "core/params.h"
#include "navigation/situation.h"
#include "planning/global/global_planner.h"

namespace sidestep {

struct GlobalRouteParams {
  std::string planner = "none";  ///< none, or a global planner that draws no random numbers
  double margin_m = 0.3;         ///< wanted between the robot's rim and walls
  double resolution_m = 0.05;    ///< of the map made of the walls
  double spacing_m = 0.5;        ///< between the path's points
  double off_m = 1.5;            ///< farther from the path than this, it is planned anew
  double patience_s = 4;         ///< so is it if the robot has not got on for so long
  double standing_s = 2;         ///< who has not moved for so long stands, and is planned around

  void visit(ParamVisitor& v);
};

/// The global path of a robot among the walls it is told of, to whatever goal it has at the time.
///
/// Start and goal without room, beside a wall, are joined by the shortest way that leads through no wall.
/// Planned when the goal is another one, when the robot is far off, and when it does not get on; around walls, and
/// around those that it has seen standing (if there is a way around them). The same situations give the same paths.
class GlobalRoute {
 public:
  GlobalRoute(const GlobalRouteParams& params, double radius_m) : params_(params), radius_m_(radius_m) {}

  /// The path for this situation, points every `spacing_m`; empty without walls, or if there is none. Valid until the
  /// next call.
  const std::vector<mrpt::math::TPose2D>& at(const Situation& now);

 private:
  /// Where somebody, or the robot, was when it last moved.
  struct Rest {
    mrpt::math::TPoint2D position;
    double since_s = 0;
    double radius_m = 0;
  };
  void note(const Situation& now);
  bool isDue(const Situation& now) const;
  std::vector<mrpt::math::TPoint2D> plan(const Situation& now, bool around_standing) const;
  void setPath(const std::vector<mrpt::math::TPoint2D>& points, const Situation& now);

  GlobalRouteParams params_;
  double radius_m_;
  std::vector<mrpt::math::TPose2D> path_;
  mrpt::math::TPose2D goal_;
  bool planned_ = false;
  Rest own_;
  std::map<int, Rest> others_;
};

}  // namespace sidestep
