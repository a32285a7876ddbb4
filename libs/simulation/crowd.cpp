// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/crowd.h"

#include <algorithm>
#include <cmath>

#include "core/geometry.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr double kArrived_m = 0.2;
constexpr double kLook_s = 0.2;  // between two looks around for the way
constexpr double kStuck_s = 10, kRest_m = 0.5;
constexpr double kGone_m = 1e6;  // where those wait who are not there

TPoint2D scaled(const TPoint2D& p, double by) { return {p.x * by, p.y * by}; }

}  // namespace

void PeopleParams::visit(ParamVisitor& v) {
  v.choice("model", model, {"social_force", "straight"},
           "making room for others, or walking on whatever is in the way");
  v.integer("count", count, {1, 1e5}, "how many");
  v.number("x_m", x_m, {-1e5, 1e5}, "m", "start");
  v.number("y_m", y_m, {-1e5, 1e5}, "m", "start");
  v.number("start_spread_m", start_spread_m, {0, 1e5}, "m", "start: at random within so much in x and y");
  v.number("goal_x_m", goal_x_m, {-1e5, 1e5}, "m", "goal");
  v.number("goal_y_m", goal_y_m, {-1e5, 1e5}, "m", "goal");
  v.number("goal_spread_m", goal_spread_m, {0, 1e5}, "m", "goal: at random within so much in x and y");
  v.table("waypoints", {"x", "y"}, waypoints, "points to pass before the goal [m]");
  v.number("speed", speed, {0, 10}, "m/s", "desired speed");
  v.number("speed_sd", speed_sd, {0, 5}, "m/s", "sd of it among them");
  v.number("radius_m", radius_m, {0.05, 5}, "m", "of the body");
  v.number("start_s", start_s, {0, 1e5}, "s", "stands until then");
  v.choice("then", then, {"stand", "return", "leave"}, "at the goal");
  v.flag("sees_robots", sees_robots, "social_force: makes room for robots too");
  v.flag("group", group, "social_force: they stay together");
}

Crowd::Crowd(const std::vector<PeopleParams>& groups, const std::vector<RecordedTrack>& tracks,
             const SocialForceParams& forces, Random random)
    : forces_(forces), random_(random), tracks_(tracks) {
  for (size_t g = 0; g < groups.size(); ++g) addGroup(groups[g], g);
  centres_.resize(groups.size());
  members_.resize(groups.size());
  addTracks();
  for (const auto& w : walkers_) fastest_ = std::max(fastest_, w.speed * forces_.speed_limit);
  if (!tracks_.empty()) fastest_ = std::max(fastest_, 2.0);
}

void Crowd::addGroup(const PeopleParams& p, size_t group) {
  const auto spread = [&](double middle, double by) {
    return by > 0 ? random_.uniform(middle - by, middle + by) : middle;
  };
  for (int k = 0; k < p.count; ++k) {
    Walker w{};
    w.model = p.model == "straight" ? Walker::Model::kStraight : Walker::Model::kSocialForce;
    w.group = group;
    Person person;
    person.id = static_cast<int>(people_.size());
    person.radius_m = p.radius_m;
    person.position.x = spread(p.x_m, p.start_spread_m);
    person.position.y = spread(p.y_m, p.start_spread_m);
    for (const auto& row : p.waypoints) w.way.emplace_back(row[0], row[1]);
    w.way.emplace_back();
    w.way.back().x = spread(p.goal_x_m, p.goal_spread_m);
    w.way.back().y = spread(p.goal_y_m, p.goal_spread_m);
    if (p.then == "return") w.way.insert(w.way.begin(), person.position);
    w.next = p.then == "return" ? 1 : 0;
    const double faster = p.speed_sd > 0 ? p.speed_sd * random_.gaussian() : 0;
    w.speed = std::max(p.speed > 0 ? 0.1 : 0.0, p.speed + faster);
    w.start_s = p.start_s;
    w.sees_robots = p.sees_robots;
    w.held_together = p.group && p.count > 1;
    w.then = p.then;
    person.heading = std::atan2(w.way[w.next].y - person.position.y, w.way[w.next].x - person.position.x);
    walkers_.push_back(w);
    people_.push_back(person);
  }
}

void Crowd::addTracks() {
  for (const auto& track : tracks_) {
    if (track.points.empty()) continue;
    Walker w{};
    w.model = Walker::Model::kReplay;
    w.track = &track;
    Person person;
    person.id = static_cast<int>(people_.size());
    person.present = false;
    person.position = {kGone_m, kGone_m};
    walkers_.push_back(w);
    people_.push_back(person);
    replay(walkers_.back(), people_.back(), 0);
  }
}

/// Linear between recorded points; nobody before the first and after the last.
void Crowd::replay(Walker& w, Person& p, double time_s) const {
  const auto& points = w.track->points;
  while (w.track_at + 1 < points.size() && points[w.track_at + 1].time_s <= time_s) ++w.track_at;
  const TrackPoint& a = points[w.track_at];
  p.present = time_s >= points.front().time_s && time_s <= points.back().time_s;
  if (!p.present) {
    p.position = {kGone_m, kGone_m};
    p.velocity = {0, 0};
    return;
  }
  const bool last = w.track_at + 1 == points.size();
  if (last) {
    p.position = a.position;
    return;
  }
  const TrackPoint& b = points[w.track_at + 1];
  const TPoint2D before = p.position;
  p.velocity = scaled(b.position - a.position, 1 / (b.time_s - a.time_s));
  p.position = a.position + scaled(p.velocity, time_s - a.time_s);
  if (before.x != kGone_m) p.walked_m += (p.position - before).norm();
  if (p.velocity.norm() > 0.05) p.heading = std::atan2(p.velocity.y, p.velocity.x);
}

/// Desired velocity: towards the next point at full speed.
TPoint2D Crowd::wanted(const Walker& w, const Person& p) const {
  if (w.next >= w.way.size()) return {0, 0};
  const TPoint2D to = (w.model == Walker::Model::kSocialForce ? w.aim : w.way[w.next]) - p.position;
  const double distance = to.norm();
  return distance > 1e-9 ? scaled(to, w.speed / distance) : TPoint2D(0, 0);
}

TPoint2D Crowd::fromWalls(const Person& p, const WallIndex& walls) {
  // The nearest wall to each side counts; pieces of one wall must not add up.
  const double reach = 10 * forces_.walls_range_m;
  walls.near(p.position, reach, near_walls_);
  TPoint2D best[4];
  double nearest[4] = {reach, reach, reach, reach};
  for (const uint32_t i : near_walls_) {
    const TPoint2D r = p.position - nearestPoint(walls.walls()[i], p.position);
    const double d = r.norm();
    const size_t side = std::abs(r.x) > std::abs(r.y) ? (r.x > 0 ? 0 : 1) : (r.y > 0 ? 2 : 3);
    if (d >= nearest[side]) continue;
    nearest[side] = d;
    best[side] = r;
  }
  TPoint2D sum(0, 0);
  for (size_t side = 0; side < 4; ++side)
    if (nearest[side] < reach) sum += wallRepulsion(forces_, best[side]);
  return sum;
}

/// (2) + (3) + (5), each seen as (8) says, and the pull of the group.
void Crowd::accelerate(size_t i, std::span<const Body> robots, const WallIndex& walls) {
  Walker& w = walkers_[i];
  const Person& p = people_[i];
  const TPoint2D want = wanted(w, p);
  const TPoint2D heading(std::cos(p.heading), std::sin(p.heading));
  TPoint2D f = scaled(want - p.velocity, 1 / forces_.relax_s);
  const auto feel = [&](const TPoint2D& position, const TPoint2D& velocity, double wider_m) {
    const TPoint2D push = repulsion(forces_, p.position - position, velocity, wider_m);
    f += scaled(push, viewWeight(forces_, heading, push));
  };
  grid_.visit(p.position, forces_.reach(fastest_), [&](uint32_t k) {
    const uint32_t j = present_[k];
    if (j == i) return;
    if (!(w.held_together && walkers_[j].held_together && walkers_[j].group == w.group))
      feel(people_[j].position, people_[j].velocity, 0);
    else
      feel(people_[j].position, {0, 0}, -0.2);  // friends walk closer, and do not clear each other's way
  });
  if (w.sees_robots)
    for (const Body& robot : robots)
      feel(robot.position, robot.velocity, robot.radius_m - p.radius_m + forces_.robot_room_m);
  TPoint2D push = fromWalls(p, walls);
  // Walls beside the way do not brake those who have it free before them: a door would be a barrier.
  if (const double speed = want.norm(); w.aim_in_sight && speed > 0)
    push -= scaled(want, std::min(0.0, dot(push, want)) / (speed * speed));
  f += push;
  if (w.held_together) {
    const TPoint2D to = centres_[w.group] - p.position;
    const double d = to.norm();
    if (d > 0.5 * (members_[w.group] - 1)) f += scaled(to, forces_.group_pull / d);
  }
  w.acceleration = f + w.fluctuation;
}

void Crowd::findCentres() {
  std::fill(centres_.begin(), centres_.end(), TPoint2D(0, 0));
  std::fill(members_.begin(), members_.end(), 0);
  for (size_t i = 0; i < people_.size(); ++i) {
    if (!walkers_[i].held_together || !people_[i].present) continue;
    centres_[walkers_[i].group] += people_[i].position;
    members_[walkers_[i].group] += 1;
  }
  for (size_t g = 0; g < centres_.size(); ++g)
    if (members_[g] > 0) centres_[g] = scaled(centres_[g], 1 / members_[g]);
}

void Crowd::arrive(Walker& w, Person& p, double dt_s, const WallIndex& walls) {
  if (w.next >= w.way.size()) return;
  const bool straight = w.model == Walker::Model::kStraight;
  const double near = straight ? w.speed * dt_s : kArrived_m + w.speed * 0.1;
  if ((w.way[w.next] - p.position).norm() > near) return;
  if (!straight && walls.blocks(p.position, w.way[w.next], near_walls_)) return;  // on the other side of a wall
  w.aim_until_s = -1;
  if (++w.next < w.way.size()) return;
  if (w.then == "leave") {
    p.present = false;
    p.position = {kGone_m, kGone_m};
    p.velocity = {0, 0};
  }
  if (w.then != "return") return;
  std::reverse(w.way.begin(), w.way.end());
  w.next = 1;
}

/// Walks round walls: to the next point if it is in sight, else to a point on the way there.
void Crowd::lookAround(Walker& w, const Person& p, double time_s, const WallIndex& walls) {
  if (w.next >= w.way.size() || time_s < w.aim_until_s) return;
  w.aim = ways_.towards(p.position, w.way[w.next], walls);
  w.aim_in_sight = !walls.blocks(p.position, w.aim, near_walls_);
  w.aim_until_s = time_s + kLook_s;
}

void Crowd::noteRest(Walker& w, const Person& p, double time_s) {
  if (w.next >= w.way.size() || !p.present || w.speed <= 0) {
    w.rested_since_s = -1;
    return;
  }
  if (w.rested_since_s < 0 || (p.position - w.rested_at).norm() > kRest_m) {
    w.rested_at = p.position;
    w.rested_since_s = time_s;
  }
  if (const double rested = time_s - w.rested_since_s; rested >= kStuck_s && rested > w.longest.for_s)
    w.longest = {p.id, p.position, w.rested_since_s, rested};
}

std::vector<StuckPerson> Crowd::stuck() const {
  std::vector<StuckPerson> out;
  for (const Walker& w : walkers_)
    if (w.longest.for_s > 0) out.push_back(w.longest);
  return out;
}

void Crowd::move(Walker& w, Person& p, double dt_s, const WallIndex& walls) {
  if (w.model == Walker::Model::kStraight) {
    p.velocity = wanted(w, p);
  } else {
    p.velocity += scaled(w.acceleration, dt_s);
    const double speed = p.velocity.norm(), most = std::max(w.speed * forces_.speed_limit, 0.3);
    if (speed > most) p.velocity = scaled(p.velocity, most / speed);
  }
  const double speed = p.velocity.norm();
  p.position += scaled(p.velocity, dt_s);
  p.walked_m += speed * dt_s;
  if (speed > 0.05) p.heading = std::atan2(p.velocity.y, p.velocity.x);
  arrive(w, p, dt_s, walls);
}

void Crowd::step(double time_s, double dt_s, std::span<const Body> robots, const WallIndex& walls) {
  positions_.clear();
  present_.clear();
  for (uint32_t i = 0; i < people_.size(); ++i) {
    if (!people_[i].present) continue;
    positions_.push_back(people_[i].position);
    present_.push_back(i);
  }
  grid_.build(positions_, 0.5 * forces_.reach(fastest_));
  findCentres();
  const double keep = std::exp(-dt_s / forces_.relax_s), fresh = forces_.fluctuation * std::sqrt(1 - keep * keep);
  for (size_t i = 0; i < people_.size(); ++i) {
    Walker& w = walkers_[i];
    if (w.model != Walker::Model::kSocialForce || !people_[i].present) continue;
    if (forces_.fluctuation > 0)
      w.fluctuation = scaled(w.fluctuation, keep) + TPoint2D(fresh * random_.gaussian(), fresh * random_.gaussian());
    lookAround(w, people_[i], time_s, walls);
    accelerate(i, robots, walls);
  }
  for (size_t i = 0; i < people_.size(); ++i) {
    Walker& w = walkers_[i];
    if (w.model == Walker::Model::kReplay) {
      replay(w, people_[i], time_s);
    } else if (people_[i].present && time_s > w.start_s) {
      move(w, people_[i], dt_s, walls);
      noteRest(w, people_[i], time_s);
    }
  }
}

}  // namespace sidestep
