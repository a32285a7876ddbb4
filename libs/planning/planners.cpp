// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/planners.h"

#include "core/errors.h"

namespace sidestep {
namespace {

struct Row {
  const char* name;
  std::unique_ptr<LocalPlanner> (*make)(const LocalPlannerParams&, const std::string& name);
};

/// The name says how moving obstacles are seen and whether the HRVO model has a say; the rest is common to all bands.
std::unique_ptr<LocalPlanner> makeBandPlanner(const LocalPlannerParams& p, const std::string& name) {
  BandPlannerParams band = p.band;
  const auto view = bandPlannerParams(name).view;
  band.view.obstacles = view.obstacles;
  band.view.heading_of_hrvo = view.heading_of_hrvo;
  return std::make_unique<BandPlanner>(band);
}

const Row kPlanners[] = {
    {"dwa", [](const LocalPlannerParams& p, const std::string&) { return makeDwa(p.dwa); }},
    {"hrvo", [](const LocalPlannerParams& p, const std::string&) { return makeHrvoPlanner(p.hrvo); }},
    {"edwa", [](const LocalPlannerParams& p, const std::string&) { return makeEdwa(p.edwa); }},
    {"teb", makeBandPlanner},
    {"pteb", makeBandPlanner},
    {"eteb", makeBandPlanner},
    {"eteb-printed", makeBandPlanner},
    {"pteb+eteb", makeBandPlanner},
};

}  // namespace

void LocalPlannerParams::visit(ParamVisitor& v) {
  v.section("dwa", "dynamic window approach", [&](ParamVisitor& s) { dwa.visit(s); });
  v.section("hrvo", "hybrid reciprocal velocity obstacles", [&](ParamVisitor& s) { hrvo.visit(s); });
  v.section("edwa", "enhanced dynamic window approach", [&](ParamVisitor& s) { edwa.visit(s); });
  v.section(
      "band",
      "timed elastic bands: teb, pteb, eteb, eteb-printed, pteb+eteb; view.obstacles and view.heading_of_hrvo go by "
      "that name",
      [&](ParamVisitor& s) { band.visit(s); });
}

std::vector<std::string> localPlannerNames() {
  std::vector<std::string> names;
  for (const auto& row : kPlanners) names.emplace_back(row.name);
  return names;
}

std::unique_ptr<LocalPlanner> makeLocalPlanner(const std::string& name, const LocalPlannerParams& params) {
  std::string all;
  for (const auto& row : kPlanners) {
    if (name == row.name) return row.make(params, name);
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
