// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <span>
#include <string>
#include <vector>

#include "core/params.h"
#include "core/random.h"
#include "simulation/crowd.h"
#include "simulation/wall_index.h"

namespace sidestep {

/// A 2D laser scanner.
struct LaserParams {
  double rate_hz = 0;
  double field = 4.71238898038469;  // rad
  int beams = 1081;
  double range_m = 30;
  double range_sd_m = 0.01;
  double dropout = 0;                // share of beams without echo
  double x_m = 0, y_m = 0, yaw = 0;  // T_base_laser
  std::string people = "legs";

  void visit(ParamVisitor& v);
};

/// A disc that a laser sees.
struct SeenDisc {
  mrpt::math::TPoint2D position;
  double radius_m = 0;
};

/// The legs of somebody who walks: two discs of 7 cm, 24 cm apart, swinging fore and aft with a stride of 1.4 m; close
/// together when standing.
void addLegs(const Person& person, std::vector<SeenDisc>& out);

/// Casts rays, exactly, by what each wall and disc covers: costs by what is in range, not by beams times things.
class LaserScanner {
 public:
  explicit LaserScanner(const LaserParams& params);
  /// Ranges [m] of all beams, right to left; infinity: no echo. Exact, without noise.
  const std::vector<double>& cast(const mrpt::math::TPose2D& T_map_base, const WallIndex& walls,
                                  std::span<const SeenDisc> discs);
  /// Noise and lost echoes onto what was cast.
  void disturb(Random& random);
  const std::vector<double>& ranges() const { return ranges_; }
  const LaserParams& params() const { return params_; }
  /// Direction of a beam in the laser's frame [rad].
  double bearing(size_t beam) const { return -0.5 * params_.field + static_cast<double>(beam) * increment_; }

 private:
  void castWall(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b);
  void castDisc(const mrpt::math::TPoint2D& centre, double radius_m);
  template <class Hit>
  void cover(double from, double to, const Hit& hit);

  LaserParams params_;
  double increment_;
  std::vector<double> ranges_, cos_, sin_;
  std::vector<uint32_t> near_;
};

}  // namespace sidestep
