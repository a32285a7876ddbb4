// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <vector>

#include "core/params.h"
#include "maps/distance_field.h"

namespace sidestep {

struct SmoothingParams {
  double step_m = 0.1;    ///< between the points of the smooth path [m]
  double margin_m = 0.2;  ///< clearance that is sought beyond the one that is kept [m]
  int rounds = 200;

  void visit(ParamVisitor& v);
};

/// Rounds a path off: a rod under tension that obstacles push away.
///
///   p_i <- p_i - a (p_{i-2} - 4 p_{i-1} + 6 p_i - 4 p_{i+1} + p_{i+2}) - b (2 p_i - p_{i-1} - p_{i+1})
///              + c max(0, clearance + margin - d(p_i)) grad d(p_i),                  a = 0.1, b = 0.05, c = 0.3
///
/// point after point, `rounds` times. A point moves only if both pieces beside it keep the clearance
/// (`DistanceField::visible`), so the result keeps it wherever the path did. The ends stay.
/// @param poses  map frame, straight in between; each piece keeps `clearance_m`
/// @return headings along the way, the last one as it was
std::vector<mrpt::math::TPose2D> smoothPath(const DistanceField& field, double clearance_m,
                                            const SmoothingParams& params,
                                            const std::vector<mrpt::math::TPose2D>& poses);

/// How good a path is, whoever planned it.
struct PathQuality {
  double length_m = 0;
  double clearance_m = 0;       ///< the least anywhere on it [m], exact for the interpolated field
  double mean_clearance_m = 0;  ///< over its length [m]
  double turning_rad = 0;       ///< sum of all changes of direction [rad]
  double bending = 0;           ///< mean squared curvature of the path sampled every 0.1 m [1/m^2]; 0 = straight
};

PathQuality pathQuality(const DistanceField& field, const std::vector<mrpt::math::TPose2D>& poses);

}  // namespace sidestep
