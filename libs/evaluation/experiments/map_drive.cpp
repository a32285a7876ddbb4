// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/map_drive.h"

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/errors.h"
#include "core/kinematics.h"
#include "planning/global/global_planners.h"
#include "simulation/epoch.h"
#include "simulation/map_walls.h"

namespace sidestep {
namespace {

using mrpt::math::TPose2D;

constexpr double kStep_s = 0.1;
constexpr int kMostPlans = 1000;

/// Numbers of the cells of the largest piece of free space.
std::vector<uint32_t> largestRoom(const PlanningGrid& grid) {
  std::map<int32_t, size_t> sizes;
  for (uint32_t c = 0; c < grid.size(); ++c)
    if (grid.isFree(c)) ++sizes[grid.component(c)];
  if (sizes.empty()) throw ConfigError("the map has no room for a robot that drives about; make its clearance smaller");
  const auto largest =
      std::max_element(sizes.begin(), sizes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  std::vector<uint32_t> out;
  for (uint32_t c = 0; c < grid.size(); ++c)
    if (grid.component(c) == largest->first) out.push_back(c);
  return out;
}

/// Where to go next, as turns on the spot and straight pieces.
class Itinerary {
 public:
  Itinerary(const GridMap& map, const MapDriveParams& params, Random random)
      : params_(params),
        random_(random),
        grid_(std::make_shared<const PlanningGrid>(std::make_shared<const DistanceField>(distanceField(map)),
                                                   params.clearance_m)),
        planner_(makeGlobalPlanner("theta", grid_, {})),
        room_(largestRoom(*grid_)),
        pose_(anywhere()) {}

  const TPose2D& pose() const { return pose_; }
  TPose2D anywhere() {
    const auto p = grid_->centre(room_[random_.below(room_.size())]);
    return {p.x, p.y, random_.uniform(-M_PI, M_PI)};
  }
  struct Move {
    double distance_m = 0, turn_rad = 0;
  };
  /// Goes on for a step.
  Move next() {
    if (way_.empty()) plan();
    if (way_.empty()) return {};
    const auto& to = way_.back();
    const double ahead = std::hypot(to.x - pose_.x, to.y - pose_.y);
    const double off = std::remainder(std::atan2(to.y - pose_.y, to.x - pose_.x) - pose_.phi, 2 * M_PI);
    Move m;
    if (std::abs(off) > 1e-6) {
      m.turn_rad = std::clamp(off, -params_.w * kStep_s, params_.w * kStep_s);
    } else {
      m.distance_m = std::min(ahead, params_.v * kStep_s);
      if (ahead <= params_.v * kStep_s) way_.pop_back();
    }
    pose_ = alongArc(pose_, m.distance_m, m.turn_rad);
    return m;
  }

 private:
  void plan() {
    for (int k = 0; k < kMostPlans && way_.empty(); ++k) {
      const auto path = planner_->plan(pose_, anywhere());
      for (size_t i = path.poses.size(); i-- > 1;)
        if (std::hypot(path.poses[i].x - pose_.x, path.poses[i].y - pose_.y) > 1e-3) way_.push_back(path.poses[i]);
    }
  }

  const MapDriveParams& params_;
  Random random_;
  std::shared_ptr<const PlanningGrid> grid_;
  std::unique_ptr<GlobalPlanner> planner_;
  std::vector<uint32_t> room_;
  TPose2D pose_;
  std::vector<TPose2D> way_;  // the next last
};

Reading asScan(double time_s, const LaserScanner& scanner) {
  const LaserParams& p = scanner.params();
  auto o = std::make_shared<mrpt::obs::CObservation2DRangeScan>();
  o->sensorLabel = "laser";
  o->timestamp = mrpt::Clock::fromDouble(time_s);
  o->rightToLeft = true;
  o->aperture = static_cast<float>(p.field);
  o->maxRange = static_cast<float>(p.range_m);
  o->sensorPose = mrpt::poses::CPose3D(p.x_m, p.y_m, 0, p.yaw, 0, 0);
  const auto& ranges = scanner.ranges();
  o->resizeScan(ranges.size());
  for (size_t i = 0; i < ranges.size(); ++i) {
    o->setScanRange(i, static_cast<float>(std::isfinite(ranges[i]) ? ranges[i] : 0));
    o->setScanRangeValidity(i, std::isfinite(ranges[i]));
  }
  return {time_s, SensorKind::kLaser, "laser", o};
}

Reading asOdometry(double time_s, const TPose2D& pose) {
  auto o = std::make_shared<mrpt::obs::CObservationOdometry>();
  o->sensorLabel = "odometry";
  o->timestamp = mrpt::Clock::fromDouble(time_s);
  o->odometry = mrpt::poses::CPose2D(pose);
  return {time_s, SensorKind::kOdometry, "odometry", o};
}

}  // namespace

MapDriveParams::MapDriveParams() {
  encoders.v_sd = 0.05;
  encoders.w_sd = 0.05;
  encoders.left_scale = 0.995;
  laser.rate_hz = 2;
  laser.field = M_PI;
  laser.beams = 181;
  laser.range_m = 20;
  laser.range_sd_m = 0.02;
}

void MapDriveParams::visit(ParamVisitor& visitor) {
  visitor.number("duration_s", duration_s, {1, 1e5}, "s", "of the drive");
  visitor.number("v", v, {0.01, 10}, "m/s", "straight on");
  visitor.number("w", w, {0.01, 10}, "rad/s", "on the spot, between straight pieces");
  visitor.number("clearance_m", clearance_m, {0.05, 5}, "m", "of its paths");
  visitor.integer("clutter", clutter, {0, 1e6}, "round things that the map does not know, in its free space");
  visitor.number("clutter_radius_m", clutter_radius_m, {0.01, 10}, "m", "their radius");
  visitor.section("encoders", "of its wheels", [this](ParamVisitor& s) { encoders.visit(s); });
  visitor.section("laser", "its scanner", [this](ParamVisitor& s) { laser.visit(s); });
}

RecordedDrive driveOnMap(const GridMap& map, const MapDriveParams& params, uint64_t seed) {
  ObstacleParams known_only;
  known_only.unknown_blocks = false;
  const WallIndex walls(wallsOf(map, known_only));
  Itinerary itinerary(map, params, Random(seed, 1));
  EncoderModel encoders(params.encoders, Random(seed, 2));
  LaserScanner scanner(params.laser);
  SampleClock scans(params.laser.rate_hz);
  Random laser_noise(seed, 3);
  std::vector<SeenDisc> clutter;
  for (int k = 0; k < params.clutter; ++k) {
    const auto p = itinerary.anywhere();
    clutter.push_back({{p.x, p.y}, params.clutter_radius_m});
  }
  RecordedDrive out;
  out.file = "drive";
  out.start_s = kSimulationStart_s;
  out.duration_s = params.duration_s;
  TPose2D odometry;
  for (int k = 0; k * kStep_s <= params.duration_s; ++k) {
    const double time_s = kSimulationStart_s + k * kStep_s;
    if (k > 0) {
      const auto move = itinerary.next();
      const auto read = encoders.step(kStep_s, move.distance_m, move.turn_rad);
      odometry = alongArc(odometry, read.distance_m, read.turn_rad);
    }
    out.entries.push_back(asOdometry(time_s, odometry));
    out.truth.push_back({time_s, itinerary.pose(), true});
    if (!scans.due(k * kStep_s)) continue;
    std::vector<SeenDisc> seen;  // what the robot stands in or drives through is not there
    for (const auto& c : clutter)
      if (std::hypot(c.position.x - itinerary.pose().x, c.position.y - itinerary.pose().y) > c.radius_m + 0.3)
        seen.push_back(c);
    scanner.cast(itinerary.pose(), walls, seen);
    scanner.disturb(laser_noise);
    out.entries.push_back(asScan(time_s, scanner));
  }
  return out;
}

}  // namespace sidestep
