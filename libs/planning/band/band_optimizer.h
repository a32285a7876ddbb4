// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "planning/band/band.h"
#include "planning/band/band_params.h"
#include "planning/band/block_banded.h"
#include "planning/band/costs/acceleration_cost.h"
#include "planning/band/costs/clearance_cost.h"
#include "planning/band/costs/velocity_cost.h"
#include "planning/band/obstacle_view.h"

namespace sidestep {

/// What a band is to satisfy besides the weights.
struct BandProblem {
  RobotLimits limits;
  BandEnds ends;
  bool goal_heading_free = true;
  Footprint robot;
  const ObstacleView* obstacles = nullptr;
  std::span<const mrpt::math::TPoint2D> via_points;  ///< of the global path
};

/// The terms of (2.33), in the order of `BandOptimizer::shares`.
enum class BandTerm { kTime, kNonholonomic, kVelocity, kAcceleration, kClearance, kContact, kShortest, kForward, kVia };
constexpr int kBandTerms = 9;
const char* bandTermName(BandTerm term);

/// Minimizes (2.33) over a band by Levenberg-Marquardt (2.34). The first pose stays, the last keeps its place.
/// Memory is kept between uses.
class BandOptimizer {
 public:
  BandOptimizer(const BandWeights& weights, const BandParams& params) : weights_(weights), params_(params) {}

  /// Room for bands of so many poses, since bands of one length change places with those of another.
  void reserve(size_t poses) { trial_.reserve(poses); }

  struct Result {
    double cost = 0;  ///< (2.33) at the end
    int iterations = 0;
    bool converged = false;  ///< no step of note was left
    bool diverged = false;   ///< no step could be made, or something was not finite
  };
  /// @param warm  the band is that of the last plan, pruned
  /// @param stop  asked before each iteration; empty: never
  Result optimize(const BandProblem& problem, bool warm, const std::function<bool()>& stop, Band& band);

  /// Weighted cost of each term.
  std::array<double, kBandTerms> shares(const BandProblem& problem, const Band& band);

  /// The gradient and Gauss-Newton matrix at a band, for tests: pose k + 1 is block k.
  double assemble(const BandProblem& problem, const Band& band);
  const BlockBandedSystem& system() const { return system_; }

 private:
  void descend(const BandProblem& problem, int iterations, const std::function<bool()>& stop, double& lambda,
               Band& band, Result& out);
  template <class Sink>
  void visitTerms(const BandProblem& problem, const Band& band, Sink& sink);
  template <class Sink>
  void visitIntervals(const BandProblem& problem, const Band& band, Sink& sink);
  template <class Sink>
  void visitPoses(const BandProblem& problem, const Band& band, Sink& sink);
  void assignViaPoints(const BandProblem& problem, const Band& band);
  double cost(const BandProblem& problem, const Band& band);
  double stepScale(const Band& band) const;
  void applyStep(const Band& band, double scale, Band& out) const;

  BandWeights weights_;
  BandParams params_;
  BlockBandedSystem system_;
  std::vector<Interval> intervals_;
  std::vector<int> via_pose_;  ///< for each via point the pose that it draws
  Band trial_;
  double soft_ = 0;  ///< rounding of the limits in this stage
};

}  // namespace sidestep
