// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/obstacles.h"
#include "core/params.h"
#include "core/robot_limits.h"
#include "simulation/crowd.h"
#include "simulation/diff_drive.h"
#include "simulation/laser.h"
#include "simulation/perceived.h"
#include "simulation/sensor_errors.h"

namespace sidestep {

/// Start and goal at random: for a robot among recorded people, who come and go anywhere.
struct RouteParams {
  double length_m = 0;  ///< between start and goal; 0: both as given
  double x_low_m = 0, x_high_m = 0, y_low_m = 0, y_high_m = 0;
  double clear_m = 0.5, clear_s = 2;

  void visit(ParamVisitor& v);
};

/// A robot of a world, the one under test or one in its way.
struct RobotParams {
  double x_m = 0, y_m = 0, yaw = 0;  ///< start
  double goal_x_m = 0, goal_y_m = 0, goal_tolerance_m = 0.3;
  Table goals;               ///< x, y: to be reached one after the other; empty: the one above
  double start_shift_m = 0;  ///< start: at random within so much in x and y
  double start_turn = 0;     ///< start: at random within so much to either side [rad]
  double start_speed = 0;    ///< m/s
  RouteParams route;
  std::string planner = "straight";
  bool sees_robot = true;  ///< false: the robot under test does not exist for it
  RobotLimits limits;
  DriveParams drive;
  PerceptionParams perception;

  void visit(ParamVisitor& v);
};

/// A line of walls.
struct WallParams {
  Table points;  ///< x, y
  bool closed = false;

  void visit(ParamVisitor& v);
  /// The pieces between the corners.
  std::vector<Segment> segments() const;
};

/// A world in which robots and people move. Names say who is who.
struct WorldParams {
  double step_s = 0.01;
  double control_period_s = 0.05;
  double duration_s = 60;
  double people_record_hz = 10;
  std::string map, tracks;  ///< files, which whoever makes the world reads
  double tracks_from_s = 0, tracks_shift_s = 0;
  std::vector<std::string> wall_names, robot_names, people_names;
  std::string under_test;  ///< name of the robot that the run is about; empty: the first
  std::map<std::string, WallParams> walls;
  std::map<std::string, RobotParams> robots;
  std::map<std::string, PeopleParams> people;
  SocialForceParams social_force;
  EncoderParams encoders;
  ImuErrorParams imu;
  GpsErrorParams gps;
  LaserParams laser;

  WorldParams();
  void visit(ParamVisitor& v);
  /// @throws ConfigError for what the ranges of single parameters do not catch.
  void check() const;
  /// Number of the robot under test.
  size_t underTest() const;
};

}  // namespace sidestep
