// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/contacts.h"

#include <algorithm>
#include <cmath>

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr int kWall = -1, kFirstRobot = -2;  // keys of what is touched; people have their ids

double dot(const TPoint2D& a, const TPoint2D& b) { return a.x * b.x + a.y * b.y; }

}  // namespace

const char* word(Contact::Kind kind) {
  switch (kind) {
    case Contact::Kind::kRobotIntoPerson:
      return "robot_into_person";
    case Contact::Kind::kPersonIntoRobot:
      return "person_into_robot";
    case Contact::Kind::kRobotIntoRobot:
      return "robot_into_robot";
    case Contact::Kind::kRobotIntoWall:
      return "robot_into_wall";
  }
  return "";
}

double sweptClearance(const SweptDisc& a, const SweptDisc& b) {
  const TPoint2D r = b.from - a.from, d = (b.to - b.from) - (a.to - a.from);
  const double d2 = dot(d, d), t = d2 > 0 ? std::clamp(-dot(r, d) / d2, 0.0, 1.0) : 0;
  return std::hypot(r.x + t * d.x, r.y + t * d.y) - a.radius_m - b.radius_m;
}

bool ContactMeter::begins(int key, bool touching) {
  if (!touching) {
    touching_.erase(key);
    return false;
  }
  return touching_.emplace(key, true).second;
}

void ContactMeter::body(double time_s, double dt_s, const SweptDisc& robot, const SweptDisc& body, int other,
                        bool is_person) {
  const double clearance = sweptClearance(robot, body);
  now_m_ = std::min(now_m_, clearance);
  min_m_ = std::min(min_m_, clearance);
  if (!begins(is_person ? other : kFirstRobot - other, clearance < 0)) return;
  const TPoint2D r = body.from - robot.from;
  const double distance = std::max(r.norm(), 1e-9);
  const double robot_speed = dot(robot.to - robot.from, r) / distance / dt_s;
  const double body_speed = -dot(body.to - body.from, r) / distance / dt_s;
  const auto kind = !is_person                  ? Contact::Kind::kRobotIntoRobot
                    : robot_speed >= body_speed ? Contact::Kind::kRobotIntoPerson
                                                : Contact::Kind::kPersonIntoRobot;
  contacts_.push_back({kind, time_s, robot_, other, robot_speed + body_speed});
}

void ContactMeter::wall(double time_s, double clearance_m, double speed) {
  now_wall_m_ = std::min(now_wall_m_, clearance_m);
  min_wall_m_ = std::min(min_wall_m_, clearance_m);
  if (begins(kWall, clearance_m < 0)) contacts_.push_back({Contact::Kind::kRobotIntoWall, time_s, robot_, -1, speed});
}

}  // namespace sidestep
