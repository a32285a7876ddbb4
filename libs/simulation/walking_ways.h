// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "maps/distance_field.h"
#include "simulation/wall_index.h"

namespace sidestep {

/// How people find round walls: a coarse map of free space, and on it the distances to each goal that somebody cannot
/// see. Who sees the goal walks straight to it.
class WalkingWays {
 public:
  /// Where to walk from a place to get to `goal`: the goal itself if it is in sight or if no way leads there, else the
  /// farthest point in sight on a shortest way. The same questions give the same answers.
  mrpt::math::TPoint2D towards(const mrpt::math::TPoint2D& from, const mrpt::math::TPoint2D& goal,
                               const WallIndex& walls);

 private:
  using Distances = std::vector<float>;  ///< to the goal, a cell; infinity: no way
  bool inSight(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b, const WallIndex& walls);
  const Distances& distancesTo(size_t cell);
  std::optional<size_t> freeCellAt(const mrpt::math::TPoint2D& p) const;
  void buildMap(const WallIndex& walls);
  size_t nextCell(size_t cell, const Distances& distances) const;
  double roomAt(size_t cell) const;
  mrpt::math::TPoint2D centre(size_t cell) const;
  template <class Use>
  void eachNeighbour(size_t cell, const Use& use) const;

  std::unique_ptr<DistanceField> field_;
  std::map<size_t, Distances> distances_;  ///< by the goal's cell
  std::vector<uint32_t> near_;
};

}  // namespace sidestep
