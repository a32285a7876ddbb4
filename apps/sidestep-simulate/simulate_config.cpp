// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-simulate/simulate_config.h"

#include "core/errors.h"

namespace sidestep {

namespace {

/// Each of the planners asked for, of which pictures of what they consider can be made, or the scenario's.
void checkSnapshots(const SimulateOptions& o, const std::string& scenarios_own) {
  for (const auto& name : o.planners.empty() ? std::vector<std::string>{scenarios_own} : o.planners)
    if (!isLocalPlanner(name)) throw ConfigError("--snapshots: " + name + " is no local planner, it considers nothing");
}

}  // namespace

Scenario effectiveScenario(const SimulateOptions& o) {
  Scenario c;
  if (!o.kind.empty() && !(o.write_config && o.scenario.empty()))
    throw ConfigError("--kind: only with --write-config and without a SCENARIO, which says its kind itself");
  if (!o.kind.empty()) c = Scenario::exampleOf(o.kind);
  if (!o.scenario.empty()) c = Scenario::read(o.scenario);
  if (o.seed && *o.seed < 0) throw ConfigError("--seed " + std::to_string(*o.seed) + ": must not be negative");
  if (o.seed) c.seed = *o.seed;
  if (!o.planners.empty() || !o.snapshots_s.empty()) {
    if (c.kind != "world") throw ConfigError("--planner, --snapshots: only of scenarios of kind: world");
    if (o.planners.size() > 1 && o.snapshots_s.empty())
      throw ConfigError("--planner: more than one only with --snapshots");
    WorldParams& world = c.world.world;
    if (world.robot_names.empty()) return c;  // an error of its own later
    std::string& planner = robotUnderTest(world).planner;
    if (!o.snapshots_s.empty()) checkSnapshots(o, planner);
    if (!o.planners.empty()) planner = o.planners[0];
  }
  return c;
}

}  // namespace sidestep
