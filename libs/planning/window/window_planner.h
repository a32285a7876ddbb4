// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>

#include "planning/goal_approach.h"
#include "planning/velocity/hrvo.h"

namespace sidestep {

/// Parameters of the dynamic window, for both heading scorers.
struct WindowParams {
  GoalParams goal;
  int v_samples = 11;
  int w_samples = 21;
  double look_ahead_s = 3;
  double step_s = 0.1;
  double heading_weight = 3;
  double clearance_weight = 0.1;
  double speed_weight = 0.1;
  double heading_after_s = 0.7;
  double margin_m = 0.1;
  double sigmas = 1;
  std::string moving = "predicted";

  void visit(ParamVisitor& v);
};

/// EDWA: the window, and where its heading comes from.
struct EdwaParams {
  WindowParams window;
  HrvoParams hrvo;
  std::string heading = "aligned";
  std::string speed = "advised";

  void visit(ParamVisitor& v);
};

/// The dynamic window approach (2.22)-(2.27) (Fox 1997): of the (v, w) that can be reached within a period and from
/// which the robot can still stop, the one with the best weighted sum of target heading, clearance and speed.
std::unique_ptr<LocalPlanner> makeDwa(const WindowParams& params);

/// The enhanced dynamic window approach (4.1)-(4.3): the same with the heading of the HRVO velocity.
std::unique_ptr<LocalPlanner> makeEdwa(const EdwaParams& params);

}  // namespace sidestep
