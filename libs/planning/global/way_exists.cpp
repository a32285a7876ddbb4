// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/global/way_exists.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "planning/band/band.h"
#include "planning/global/global_planners.h"

namespace sidestep {
namespace {

constexpr double kGoal_m = 8, kAround_m = 8;  ///< of the plane around start and goal

/// Places on a raster, a row of bits each.
class Places {
 public:
  static constexpr double kCell_m = 0.1;
  static constexpr int kWide = static_cast<int>((kGoal_m + kAround_m) / kCell_m) + 1;
  static constexpr int kHigh = static_cast<int>(kAround_m / kCell_m) * 2 + 1;
  static constexpr int kWords = kWide / 64 + 1;

  static int column(double x) { return static_cast<int>(std::lround((x + kAround_m / 2) / kCell_m)); }
  static int row(double y) { return static_cast<int>(std::lround((y + kAround_m) / kCell_m)); }

  bool at(double x, double y) const { return (word(column(x), row(y)) >> (column(x) % 64) & 1) != 0; }
  void set(double x, double y) { word(column(x), row(y)) |= uint64_t{1} << (column(x) % 64); }

  /// All that is at most two cells away from a place of `from`.
  void spreadFrom(const Places& from) {
    for (int y = 0; y < kHigh; ++y)
      for (int dy = -2; dy <= 2; ++dy) {
        if (y + dy < 0 || y + dy >= kHigh) continue;
        const int reach = std::abs(dy) == 2 ? 0 : std::abs(dy) == 1 ? 1 : 2;
        for (int dx = -reach; dx <= reach; ++dx) orShifted(&from.bits_[(y + dy) * kWords], dx, &bits_[y * kWords]);
      }
    for (int y = 0; y < kHigh; ++y) bits_[y * kWords + kWords - 1] &= (uint64_t{1} << (kWide % 64)) - 1;
  }
  /// Takes out what is nearer than `radius` to a point.
  void takeOut(double x, double y, double radius) {
    const int reach = static_cast<int>(radius / kCell_m) + 1;
    for (int r = std::max(row(y) - reach, 0); r <= std::min(row(y) + reach, kHigh - 1); ++r)
      for (int c = std::max(column(x) - reach, 0); c <= std::min(column(x) + reach, kWide - 1); ++c)
        if (std::hypot(c * kCell_m - kAround_m / 2 - x, r * kCell_m - kAround_m - y) < radius)
          word(c, r) &= ~(uint64_t{1} << (c % 64));
  }

 private:
  static void orShifted(const uint64_t* from, int by, uint64_t* to) {
    const int k = std::abs(by);
    for (int w = 0; w < kWords; ++w) {
      if (by == 0) to[w] |= from[w];
      if (by > 0) to[w] |= from[w] << k | (w > 0 ? from[w - 1] >> (64 - k) : 0);
      if (by < 0) to[w] |= from[w] >> k | (w + 1 < kWords ? from[w + 1] << (64 - k) : 0);
    }
  }
  uint64_t& word(int c, int r) { return bits_[static_cast<size_t>(r * kWords + c / 64)]; }
  const uint64_t& word(int c, int r) const { return bits_[static_cast<size_t>(r * kWords + c / 64)]; }

  std::vector<uint64_t> bits_ = std::vector<uint64_t>(static_cast<size_t>(kHigh * kWords));
};

/// First time at which a disc that keeps off by `clearance` can be at the goal, 0 if never.
double firstArrival(std::span<const MovingObstacle> obstacles, double v_max, double clearance) {
  constexpr double kLongest_s = 60;
  const double step = 2 * Places::kCell_m / v_max;
  Places now;
  now.set(0, 0);
  for (double t = step; t < kLongest_s; t += step) {
    Places next;
    next.spreadFrom(now);
    for (const auto& o : obstacles) {
      const auto p = o.position + o.velocity * t;
      if (std::abs(p.y) < 2 * kAround_m && std::abs(p.x - kGoal_m / 2) < 2 * kAround_m)
        next.takeOut(p.x, p.y, clearance + o.radius_m);
    }
    if (next.at(kGoal_m, 0)) return t;
    std::swap(now, next);
  }
  return 0;
}

/// 1 for each cell in which a centre of an obstacle lies.
std::vector<uint8_t> cellsOf(std::span<const MovingObstacle> obstacles, const GridFrame& frame) {
  std::vector<uint8_t> blocked(static_cast<size_t>(frame.width) * static_cast<size_t>(frame.height));
  for (const auto& o : obstacles) {
    const double x = (o.position.x - frame.T_map_grid.x) / frame.resolution_m;
    const double y = (o.position.y - frame.T_map_grid.y) / frame.resolution_m;
    if (x >= 0 && y >= 0 && x < frame.width && y < frame.height)
      blocked[static_cast<size_t>(y) * static_cast<size_t>(frame.width) + static_cast<size_t>(x)] = 1;
  }
  return blocked;
}

}  // namespace

WayVerdict standingWay(std::span<const MovingObstacle> obstacles, const RobotLimits& robot) {
  GridFrame frame;
  frame.resolution_m = 0.025;
  frame.width = static_cast<int>((kGoal_m + kAround_m) / frame.resolution_m);
  frame.height = static_cast<int>(2 * kAround_m / frame.resolution_m);
  frame.T_map_grid = {-kAround_m / 2, -kAround_m, 0};
  const auto field = std::make_shared<const DistanceField>(frame, cellsOf(obstacles, frame));
  const auto grid = std::make_shared<const PlanningGrid>(field, robot.radius_m);
  const GlobalPath path = makeGlobalPlanner("theta", grid, {})->plan({0, 0, 0}, {kGoal_m, 0, 0});
  if (!path.found()) return {"no", 0};
  return {"yes", SpeedProfile(pathLength(path.poses), 0, robot, true).duration()};
}

WayVerdict movingWay(std::span<const MovingObstacle> obstacles, const RobotLimits& robot) {
  const double straight = SpeedProfile(kGoal_m, 0, robot, true).duration();
  const double off_centre = Places::kCell_m * M_SQRT1_2;  // the disc may be anywhere in its cell
  const double at_best = firstArrival(obstacles, robot.v_max, robot.radius_m - off_centre);
  if (at_best <= 0) return {"no", 0};
  const bool sure = firstArrival(obstacles, robot.v_max, robot.radius_m) > 0;
  return {sure ? "yes" : "unsure", std::max(at_best, straight)};
}

}  // namespace sidestep
