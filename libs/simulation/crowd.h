// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/params.h"
#include "core/random.h"
#include "simulation/neighbour_grid.h"
#include "simulation/social_force.h"
#include "simulation/walking_ways.h"
#include "simulation/wall_index.h"

namespace sidestep {

/// Some people who behave alike: where they start and go, and how.
struct PeopleParams {
  std::string model = "social_force";
  int count = 1;
  double x_m = 0, y_m = 0, start_spread_m = 0;  ///< start, and half of the square in which it lies
  double goal_x_m = 0, goal_y_m = 0, goal_spread_m = 0;
  Table waypoints;                    ///< x, y: on the way to the goal
  double speed = 1.34, speed_sd = 0;  ///< (Helbing & Molnar 1995: 1.34, 0.26) [m/s]
  double radius_m = 0.3;
  double start_s = 0;
  std::string then = "stand";
  bool sees_robots = true;
  bool group = false;

  void visit(ParamVisitor& v);
};

/// Where somebody was recorded.
struct TrackPoint {
  double time_s = 0;
  mrpt::math::TPoint2D position;  ///< [m]
};

/// One recorded person, in time order.
struct RecordedTrack {
  int id = 0;
  std::vector<TrackPoint> points;
};

/// Somebody in the world.
struct Person {
  int id = 0;
  bool present = true;
  mrpt::math::TPoint2D position, velocity;  ///< [m], [m/s]
  double radius_m = 0.3;
  double heading = 0;   ///< of walking; kept while standing [rad]
  double walked_m = 0;  ///< so far: where in their stride the legs are
};

/// A disc that people make room for.
struct Body {
  mrpt::math::TPoint2D position, velocity;
  double radius_m = 0.3;
};

/// Somebody who wanted to walk on and did not get on for a while.
struct StuckPerson {
  int id = 0;
  mrpt::math::TPoint2D position;
  double from_s = 0, for_s = 0;  ///< since when, how long; the longest such while
};

/// All people of a world: those who walk straight or from point to point, whatever is in the way; those who follow the
/// social force model, and walk round walls to points that they do not see; those who were recorded.
class Crowd {
 public:
  Crowd(const std::vector<PeopleParams>& groups, const std::vector<RecordedTrack>& tracks,
        const SocialForceParams& forces, Random random);
  Crowd(const Crowd&) = delete;
  Crowd& operator=(const Crowd&) = delete;

  /// Goes on by `dt_s` to `time_s`. Costs about linearly in people at a given density.
  void step(double time_s, double dt_s, std::span<const Body> robots, const WallIndex& walls);
  const std::vector<Person>& people() const { return people_; }
  /// Who moved by less than half a metre for 10 s or longer although it was under way, so far.
  std::vector<StuckPerson> stuck() const;

 private:
  struct Walker {
    enum class Model : uint8_t { kStraight, kSocialForce, kReplay };
    Model model;
    size_t group = 0;
    std::vector<mrpt::math::TPoint2D> way;  ///< goals in order
    size_t next = 0;
    double speed = 0, start_s = 0, max_radius_m = 0;
    bool sees_robots = true, held_together = false;
    std::string then;
    mrpt::math::TPoint2D fluctuation, acceleration;
    const RecordedTrack* track = nullptr;
    size_t track_at = 0;
    mrpt::math::TPoint2D aim;  ///< where it walks to now, on the way to way[next]
    double aim_until_s = -1;   ///< then it looks again
    bool aim_in_sight = false;
    mrpt::math::TPoint2D rested_at;  ///< moved by little from there ...
    double rested_since_s = -1;      ///< ... since then; negative: not under way
    StuckPerson longest;
  };
  void addGroup(const PeopleParams& p, size_t group);
  void addTracks();
  void replay(Walker& w, Person& p, double time_s) const;
  mrpt::math::TPoint2D wanted(const Walker& w, const Person& p) const;
  void accelerate(size_t i, std::span<const Body> robots, const WallIndex& walls);
  mrpt::math::TPoint2D fromWalls(const Person& p, const WallIndex& walls);
  void lookAround(Walker& w, const Person& p, double time_s, const WallIndex& walls);
  void noteRest(Walker& w, const Person& p, double time_s);
  void move(Walker& w, Person& p, double dt_s, const WallIndex& walls);
  void arrive(Walker& w, Person& p, double dt_s, const WallIndex& walls);
  void findCentres();

  SocialForceParams forces_;
  Random random_;
  std::vector<RecordedTrack> tracks_;
  std::vector<Walker> walkers_;
  std::vector<Person> people_;
  std::vector<mrpt::math::TPoint2D> positions_, centres_;
  std::vector<double> members_;
  std::vector<uint32_t> near_walls_, present_;  // present_[k]: whom positions_[k] belongs to
  NeighbourGrid grid_;
  WalkingWays ways_;
  double fastest_ = 0;
};

}  // namespace sidestep
