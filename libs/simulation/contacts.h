// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace sidestep {

/// One time that a robot touched something.
struct Contact {
  enum class Kind : uint8_t { kRobotIntoPerson, kPersonIntoRobot, kRobotIntoRobot, kRobotIntoWall };
  Kind kind = Kind::kRobotIntoWall;
  double time_s = 0;         ///< when it began
  int robot = 0;             ///< whose contact it is
  int other = -1;            ///< person's id, or the other robot's number; -1: a wall
  double closing_speed = 0;  ///< [m/s]
};

/// "robot_into_person", "person_into_robot", "robot_into_robot", "robot_into_wall".
const char* word(Contact::Kind kind);

/// A disc over one step, on a straight line.
struct SweptDisc {
  mrpt::math::TPoint2D from, to;  ///< [m]
  double radius_m = 0;
};

/// Smallest distance between the rims of two discs within a step; negative: they overlap. [m]
double sweptClearance(const SweptDisc& a, const SweptDisc& b);

/// Watches one robot: clearance to everybody and everything at each step, and who hits whom. A contact counts once,
/// until the two are apart again.
class ContactMeter {
 public:
  explicit ContactMeter(int robot) : robot_(robot) {}
  /// Somebody else (`other`) at this step. Who moved faster towards the other is the one who hit.
  void body(double time_s, double dt_s, const SweptDisc& robot, const SweptDisc& body, int other, bool is_person);
  /// A wall so far from the rim.
  void wall(double time_s, double clearance_m, double speed);
  /// Begins a step: clearance of this step is infinite until something is near.
  void startStep() { now_m_ = now_wall_m_ = std::numeric_limits<double>::infinity(); }

  /// In the present step, to bodies and to walls. [m]
  double clearance() const { return now_m_; }
  double wallClearance() const { return now_wall_m_; }
  /// Smallest so far. [m]
  double minClearance() const { return min_m_; }
  double minWallClearance() const { return min_wall_m_; }
  const std::vector<Contact>& contacts() const { return contacts_; }

 private:
  bool begins(int key, bool touching);

  int robot_;
  double now_m_ = std::numeric_limits<double>::infinity(), now_wall_m_ = now_m_, min_m_ = now_m_, min_wall_m_ = now_m_;
  std::map<int, bool> touching_;
  std::vector<Contact> contacts_;
};

}  // namespace sidestep
