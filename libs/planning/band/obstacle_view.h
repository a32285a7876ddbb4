// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <span>
#include <vector>

#include "core/obstacles.h"
#include "planning/band/bucket_grid.h"

namespace sidestep {

class DistanceField;

/// How near a point is to an obstacle at one time, and how that changes with the point and the time.
struct Proximity {
  double distance = 0;    ///< to the obstacle's edge [m], negative inside
  double dx = 0, dy = 0;  ///< derivative by the point: away from the obstacle, of length 1
  double dt = 0;          ///< derivative by the time [m/s]
  bool moving = false;    ///< from `moving` of the input, wherever it is taken to be
  int id = -1;            ///< MovingObstacle::id; -1: static
  double widening = 0;    ///< by how much of the distance the obstacle was widened for its uncertainty [m]
};

/// What stands still: a disc, or with two ends a piece of wall.
struct StillItem {
  double x = 0, y = 0, ex = 0, ey = 0;  ///< one end, and from there to the other [m]
  double radius = 0;
  int id = -1;
};

/// Where an obstacle is in one slice of time: straight on around the slice's middle.
struct MovingItem {
  double x = 0, y = 0, vx = 0, vy = 0;  ///< at the slice's middle
  double middle = 0;                    ///< of the slice [s]
  double radius = 0;                    ///< widened by the covariance
  int id = -1;
  double widening = 0;  ///< of the radius
};

/// How moving obstacles are to be seen.
struct MovingView {
  enum class Kind {
    kNow,        ///< where they are: TEB
    kNowAndOne,  ///< where they are, and beside that one predicted position: (4.12) as printed
    kInTime      ///< each pose of the band against where they are then, widened by the prediction's covariance
  };
  Kind kind = Kind::kNow;
  double one_after_s = 1.0;  ///< the one predicted position
  double horizon_s = 12.0;   ///< beyond it nothing is predicted
  double sigmas = 1.0;       ///< standard deviations by which an obstacle is widened
  double widening_max_m = 0.3;
};

/// Position, velocity and widened radius of an obstacle at a time, along its predicted path.
MovingItem predictedItem(const MovingObstacle& o, double after_s, const MovingView& view);

/// The obstacles of one plan, arranged so that what is far away costs nothing.
class ObstacleView {
 public:
  static constexpr double kSlice_s = 0.5;

  struct Source {
    std::span<const mrpt::math::TPoint2D> points;
    std::span<const Segment> walls;
    std::span<const MovingObstacle> moving;
    const DistanceField* field = nullptr;
  };

  /// @param reach  farthest distance that `near` will be asked for [m]
  void build(const Source& source, const MovingView& view, const GridBounds& bounds, double reach);

  /// Calls f(Proximity) for each obstacle whose edge is less than `reach` from (x, y) at time `t` from now.
  template <class F>
  void near(double x, double y, double t, double reach, F&& f) const {
    still_.near(0, x, y, [&](const StillItem& o) {
      const Proximity p = proximity(o, x, y);
      if (p.distance < reach) f(p);
    });
    if (!moving_.empty() && t >= 0 && t < kSlice_s * slices_)
      moving_.near(static_cast<int>(t / kSlice_s), x, y, [&](const MovingItem& o) {
        const Proximity p = proximity(o, x, y, t);
        if (p.distance < reach) f(p);
      });
    if (field_ != nullptr) {
      const Proximity p = ofField(x, y);
      if (p.distance < reach) f(p);
    }
  }

  const std::vector<StillItem>& still() const { return still_.items(); }
  /// All moving items of the slice that holds `t` (few or none: `near` is for the optimizer, this for exploration).
  std::span<const MovingItem> movingIn(double t) const;
  bool movesInTime() const { return !moving_.empty(); }
  int slices() const { return slices_; }
  const DistanceField* field() const { return field_; }

 private:
  static Proximity proximity(const StillItem& o, double x, double y);
  static Proximity proximity(const MovingItem& o, double x, double y, double t);
  Proximity ofField(double x, double y) const;
  void addStill(const Source& source, const MovingView& view);
  void addMoving(const Source& source, const MovingView& view);

  BucketGrid<StillItem> still_;
  BucketGrid<MovingItem> moving_;
  std::vector<MovingItem> by_slice_;  ///< slice by slice, in the order of the input
  int slices_ = 0;
  size_t per_slice_ = 0;
  const DistanceField* field_ = nullptr;
};

inline Proximity ObstacleView::proximity(const StillItem& o, double x, double y) {
  double rx = x - o.x, ry = y - o.y;
  const double length2 = o.ex * o.ex + o.ey * o.ey;
  if (length2 > 0) {
    const double along = std::clamp((rx * o.ex + ry * o.ey) / length2, 0.0, 1.0);
    rx -= along * o.ex;
    ry -= along * o.ey;
  }
  const double d = std::sqrt(rx * rx + ry * ry), k = d > 1e-9 ? 1 / d : 0;
  return {d - o.radius, d > 1e-9 ? rx * k : 1, ry * k, 0, o.id >= 0, o.id};
}

inline Proximity ObstacleView::proximity(const MovingItem& o, double x, double y, double t) {
  const double rx = x - o.x - o.vx * (t - o.middle), ry = y - o.y - o.vy * (t - o.middle);
  const double d = std::sqrt(rx * rx + ry * ry), k = d > 1e-9 ? 1 / d : 0;
  const double ux = d > 1e-9 ? rx * k : 1, uy = ry * k;
  return {d - o.radius, ux, uy, -(ux * o.vx + uy * o.vy), true, o.id, o.widening};
}

}  // namespace sidestep
