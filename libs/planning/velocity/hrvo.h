// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "core/params.h"
#include "planning/velocity/velocity_query.h"
#include "planning/velocity/velocity_region.h"

namespace sidestep {

/// Parameters of the velocity obstacles.
struct HrvoParams {
  std::string kind = "hrvo";
  double horizon_s = 8;
  double wall_horizon_s = 2;
  double separate_s = 1;
  double margin_m = 0.1;
  double sigmas = 1;
  double velocity_sd = 0;  // m/s
  double share = 0.5;
  double keep_right = 0;  // m/s
  int neighbours = 20;
  bool shield = true;

  void visit(ParamVisitor& v);
  RegionKind regionKind() const;
};

/// The velocity that was found, and how.
struct HrvoAnswer {
  mrpt::math::TPoint2D velocity;  ///< [m/s, map axes]
  double distance = 0;            ///< to the preferred velocity [m/s]
  double horizon_share = 1;       ///< of the horizons that could be held; 0: only the shield
  double penetration = 0;         ///< by how much even the shield had to give way [m/s]; 0: it holds
};

/// The model of section 2.3.2: from the discs and walls around a disc-shaped robot to the velocity (2.29).
///
/// Usage: `begin`, `disc` and `wall` for each obstacle, `solve`. When every velocity is forbidden, all horizons are
/// halved until one is free: the collision that cannot be excluded is put off as far as possible. The shield
/// (`shieldRegion`) holds all the while: two robots that both obey it never touch. If overlaps make even that
/// impossible, it gives way evenly, by the least that leaves a velocity. Allocates nothing once it has seen its largest
/// number of obstacles.
class Hrvo {
 public:
  explicit Hrvo(const HrvoParams& params);

  /// @param own       the robot's velocity [m/s, map axes]
  /// @param radius_m  the robot's
  /// @param period_s  how long the answer will be driven
  void begin(const mrpt::math::TPoint2D& own, double radius_m, double period_s);
  /// A moving disc; `radius_sum` and `velocity_sd` with all that belongs in them (`view` fills them).
  void disc(const DiscView& view) { discs_.push_back(view); }
  /// A wall, its points relative to the robot's centre.
  void wall(const Segment& s) { walls_.push_back(s); }
  /// A moving obstacle as seen from `position`, with margins, doubt and share as the parameters say.
  DiscView view(const MovingObstacle& obstacle, const mrpt::math::TPoint2D& position) const;

  HrvoAnswer solve(const mrpt::math::TPoint2D& preferred, double v_max);
  /// After `solve`: what came into question; `names` says which obstacle a region belongs to.
  void candidates(std::vector<VelocityCandidate>& out);
  std::string regionName(int region) const;
  int coveredBy(const mrpt::math::TPoint2D& v) const { return query_.coveredBy(v); }

 private:
  void keepNearest();
  void build(double horizon_share);
  void addShields(double v_max, double give_way);
  HrvoAnswer giveWay(const mrpt::math::TPoint2D& preferred, double v_max);

  HrvoParams params_;
  RegionKind kind_;
  mrpt::math::TPoint2D own_, preferred_;
  double radius_m_ = 0.3, period_s_ = 0.1, v_max_ = 1;
  std::vector<DiscView> discs_;
  std::vector<Segment> walls_;
  VelocityQuery query_;
};

}  // namespace sidestep
