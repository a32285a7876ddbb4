// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/planners.h"

#include "core/errors.h"

namespace sidestep {
namespace {

struct Row {
  const char* name;
  std::unique_ptr<LocalPlanner> (*make)(const LocalPlannerParams&);
};

const Row kPlanners[] = {
    {"dwa", [](const LocalPlannerParams& p) { return makeDwa(p.dwa); }},
    {"hrvo", [](const LocalPlannerParams& p) { return makeHrvoPlanner(p.hrvo); }},
    {"edwa", [](const LocalPlannerParams& p) { return makeEdwa(p.edwa); }},
};

}  // namespace

void LocalPlannerParams::visit(ParamVisitor& v) {
  v.section("dwa", "dynamic window approach", [&](ParamVisitor& s) { dwa.visit(s); });
  v.section("hrvo", "hybrid reciprocal velocity obstacles", [&](ParamVisitor& s) { hrvo.visit(s); });
  v.section("edwa", "enhanced dynamic window approach", [&](ParamVisitor& s) { edwa.visit(s); });
}

std::vector<std::string> localPlannerNames() {
  std::vector<std::string> names;
  for (const auto& row : kPlanners) names.emplace_back(row.name);
  return names;
}

std::unique_ptr<LocalPlanner> makeLocalPlanner(const std::string& name, const LocalPlannerParams& params) {
  std::string all;
  for (const auto& row : kPlanners) {
    if (name == row.name) return row.make(params);
    all += (all.empty() ? "" : ", ") + std::string(row.name);
  }
  const std::string near = nearestWord(name, localPlannerNames());
  throw ConfigError("no local planner '" + name + "'; there are " + all +
                    (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

std::unique_ptr<LocalPlanner> makeLocalPlanner(const std::string& name) {
  const LocalPlannerParams defaults;
  return makeLocalPlanner(name, defaults);
}

}  // namespace sidestep
