// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/world_metrics.h"

#include <cmath>
#include <limits>

#include "evaluation/metrics/collision_index.h"

namespace sidestep {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Without anybody there is no distance.
double orUndefined(double distance_m) { return std::isfinite(distance_m) ? distance_m : kNaN; }

double contacts(const WorldNumbers& w, const char* kind) { return w.summary.contacts.at(kind); }

}  // namespace

const Metrics<WorldNumbers>& worldMetrics() {
  using W = WorldNumbers;
  static const Metrics<W> rows = {
      {{"success", "yes/no", "arrived at all goals without a contact", Better::kHigher, ""},
       [](const W& w) { return w.summary.success ? 1.0 : 0.0; }},
      {{"arrived", "yes/no", "arrived at all goals", Better::kHigher, ""},
       [](const W& w) { return w.summary.arrived ? 1.0 : 0.0; }},
      {{"goals_reached", "count", "goals that it reached", Better::kHigher, ""},
       [](const W& w) { return static_cast<double>(w.summary.goals_reached); }},
      {{"collision", "yes/no", "whether there was any contact", Better::kLower, ""},
       [](const W& w) { return w.summary.collision ? 1.0 : 0.0; }},
      {{"robot_into_person", "count", "contacts with people that the robot caused", Better::kLower, ""},
       [](const W& w) { return contacts(w, "robot_into_person"); }},
      {{"person_into_robot", "count", "contacts that people caused", Better::kLower, ""},
       [](const W& w) { return contacts(w, "person_into_robot"); }},
      {{"robot_into_robot", "count", "contacts with other robots", Better::kLower, ""},
       [](const W& w) { return contacts(w, "robot_into_robot"); }},
      {{"robot_into_wall", "count", "contacts with walls", Better::kLower, ""},
       [](const W& w) { return contacts(w, "robot_into_wall"); }},
      {{"time", "s", "until it arrived, or the end of the run", Better::kLower, "time_s"},
       [](const W& w) { return w.summary.time_s; }},
      {{"path_length", "m", "length of the path driven", Better::kLower, "path_m"},
       [](const W& w) { return w.summary.path_m; }},
      {{"average_velocity", "m/s", "path length divided by time", Better::kHigher, ""},
       [](const W& w) { return w.summary.average_velocity; }},
      {{"min_clearance", "m", "least distance between the rims, to people and other robots; below 0: overlap",
        Better::kHigher, "min_clearance_m"},
       [](const W& w) { return orUndefined(w.summary.min_clearance_m); }},
      {{"min_wall_clearance", "m", "least distance to walls, where below 5 m", Better::kHigher, "min_wall_clearance_m"},
       [](const W& w) { return orUndefined(w.summary.min_wall_clearance_m); }},
      {{"delta_min", "1", "nearness (4.6) at the least distance: 1 at contact, towards 0 far away", Better::kLower, ""},
       [](const W& w) { return deltaMin(w.summary.min_clearance_m); }},
      {{"ci_max", "1", "largest collision index (4.11)", Better::kLower, "collision_index_max"},
       [](const W& w) { return w.largest_index; }},
      {{"ci_exceeded", "yes/no", "whether it was above the threshold 0.54", Better::kLower, ""},
       [](const W& w) { return w.largest_index > kCollisionIndexThreshold ? 1.0 : 0.0; }},
      {{"ci_exceeded_time", "s", "for how long it was", Better::kLower, ""},
       [](const W& w) { return w.above_threshold_s; }},
      {{"standing_time", "s", "for how long the robot stood (below 1 cm/s)", Better::kLower, ""},
       [](const W& w) { return w.standing_s; }},
      {{"braked", "1", "share of control cycles that brake or have no plan", Better::kLower, ""}, [](const W& w) {
         return w.plans.all > 0 ? static_cast<double>(w.plans.braked) / static_cast<double>(w.plans.all) : kNaN;
       }}};
  return rows;
}

}  // namespace sidestep
