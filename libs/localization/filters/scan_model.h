// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/params.h"
#include "core/random.h"
#include "localization/sensors/scan.h"
#include "maps/grid_map.h"

namespace sidestep {

/// How likely a scan is, seen from a pose in a map.
struct ScanModelParams {
  std::string model = "field";
  double sd_m = 0.12;
  double hit_share = 0.5;
  double short_share = 0.1;  // beam model only
  double short_m = 2;        // mean length of a short range
  double field_reach_m = 1;
  double beam_weight = 0.15;

  void visit(ParamVisitor& v);
};

/// Likelihood of a scan in an occupancy map (Thrun, Burgard & Fox 2005, tables 6.3 and 6.1).
///
/// `field`: the log-likelihood of a beam's end by its distance to the nearest obstacle, computed once for each cell;
/// a pose then costs one look-up a beam. `beam`: each beam is followed through the map, which knows of what is hidden
/// behind walls and costs some twenty times as much. Beams of one scan err together (people, map errors), so that a
/// scan counts as `beam_weight` times its beams. Const and free of locks: any number of threads may ask.
class ScanModel {
 public:
  /// @throws ConfigError if the map has no free or no occupied cell.
  ScanModel(const GridMap& map, const ScanModelParams& params);

  /// Log-likelihood of all the scan's beams from each of `n` poses (map frame), not yet weighted.
  void logLikelihoods(const Scan& scan, const double* x, const double* y, const double* yaw, size_t n,
                      double* out) const;
  /// Share of the beams that end within one and a half sd of an obstacle.
  double explained(const Scan& scan, const mrpt::math::TPose2D& pose) const;
  /// How well a scan and a place go together, for telling places apart.
  struct Judgement {
    double fit = 0;      ///< log-likelihood of all beams; one that ends short is excused, one through a wall is not
    double through = 0;  ///< share of the beams that went through a wall of the map to where they ended
  };
  /// Things that the map does not know shorten many beams at once and say little against a place. Nothing excuses a
  /// beam that is longer than the map allows.
  /// @param least  a place that fits worse than this needs no closer look: its fit may then be told too well, but
  ///               below `least`, and no beam counts as through a wall
  Judgement judge(const Scan& scan, const mrpt::math::TPose2D& pose, double least = -1e300) const;
  /// What a scan of `beams` beams weighs, as a factor of its log-likelihood.
  double weight() const { return params_.beam_weight; }
  /// A pose drawn evenly from the free cells and all headings.
  mrpt::math::TPose2D drawFree(Random& random) const;
  double freeArea() const;

 private:
  struct GridPose {
    float x, y, c, s;  // position in cells, direction, in the grid's frame
  };
  GridPose toGrid(double x, double y, double sine, double cosine) const;
  GridPose toGrid(const mrpt::math::TPose2D& pose) const;
  int ends(const GridPose& p, const Scan& scan, int32_t* at) const;
  float field(const GridPose& p, const Scan& scan) const;
  float beams(const GridPose& p, const Scan& scan) const;
  float castRay(float x, float y, float dx, float dy, float reach) const;

  ScanModelParams params_;
  GridFrame frame_;
  double cos_ = 1, sin_ = 0, per_m_ = 1;  // the raster's direction, cells in a metre
  int stride_ = 0;
  float right_ = 0, top_ = 0;          // largest coordinates, in cells of the padded raster
  std::vector<float> log_likelihood_;  // by cell, with a ring of "nothing near" around the raster
  std::vector<float> distance_;        // to the nearest obstacle in cells, padded alike
  std::vector<uint32_t> free_;         // numbers of the free cells
};

}  // namespace sidestep
