// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "core/obstacles.h"
#include "core/params.h"

namespace sidestep {

struct MotionPredictorParams {
  double accel_noise = 0.05;  ///< spectral density of the acceleration [m^2/s^3]
  double velocity_sd = 1.0;   ///< of a newcomer's velocity, which starts at 0 [m/s]
  double forget_after_s = 2;  ///< without being seen
  double horizon_s = 12;      ///< of the prediction
  double step_s = 0.5;        ///< between predicted states

  void visit(ParamVisitor& v);
};

/// Constant-velocity Kalman filter, one an obstacle, for observations whose obstacle is known: from positions to
/// positions, velocities and a predicted path whose covariance grows,
///
///   P(t) = F P F^T + q [t^3/3 t^2/2; t^2/2 t],   F = [1 t; 0 1]     for each axis.
///
/// Both axes share one covariance, since a position's noise is taken as equal in all directions.
class MotionPredictor {
 public:
  explicit MotionPredictor(const MotionPredictorParams& params = {}) : params_(params) {}

  /// An obstacle was seen. Times of one obstacle must not go back; what is not finite is left out.
  void observe(double time_s, int id, const mrpt::math::TPoint2D& position, double position_sd, double radius_m);
  /// All known obstacles at `time_s`, with their predictions, in the order of their ids.
  void predict(double time_s, std::vector<MovingObstacle>& out);
  void reset() { tracks_.clear(); }

 private:
  /// Covariance of position and velocity along an axis.
  struct Covariance {
    double pp = 0, pv = 0, vv = 0;
  };
  struct Track {
    int id = 0;
    double time_s = 0, radius_m = 0.3;
    mrpt::math::TPoint2D position, velocity;
    Covariance P;
  };
  Covariance ahead(const Covariance& P, double dt) const;

  MotionPredictorParams params_;
  std::vector<Track> tracks_;  ///< by id
};

}  // namespace sidestep
