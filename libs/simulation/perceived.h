// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <span>
#include <vector>

#include "core/obstacles.h"
#include "core/params.h"
#include "core/random.h"
#include "simulation/wall_index.h"

namespace sidestep {

/// How much of the moving obstacles a robot knows.
struct PerceptionParams {
  double range_m = 8;
  double field = 4.71238898038469;  // rad
  bool occlusion = true;
  double position_sd_m = 0, velocity_sd = 0;

  void visit(ParamVisitor& v);
};

/// Takes of all that moves what a robot perceives: near enough, within its field of view, and not hidden. Somebody is
/// hidden if the lines of sight to the middle and to both edges are each crossed by a wall or by somebody else.
class Perception {
 public:
  Perception(const PerceptionParams& params, Random random) : params_(params), random_(random) {}
  /// @param out  keeps its memory; in the order of `all`
  void perceive(const mrpt::math::TPose2D& pose, std::span<const MovingObstacle> all, const WallIndex& walls,
                std::vector<MovingObstacle>& out);

 private:
  bool inView(const mrpt::math::TPose2D& pose, const MovingObstacle& o) const;
  bool hidden(const mrpt::math::TPoint2D& eye, size_t index, std::span<const MovingObstacle> all,
              const WallIndex& walls);

  PerceptionParams params_;
  Random random_;
  std::vector<uint32_t> near_, scratch_;
};

}  // namespace sidestep
