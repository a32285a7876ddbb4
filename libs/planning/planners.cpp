// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/planners.h"

#include <algorithm>

#include "planning/band/band_planner.h"
#include "planning/simple_planners.h"
#include "planning/velocity/hrvo_planner.h"
#include "planning/window/window_planner.h"

namespace sidestep {
namespace {

template <class Params>
PlannerSection sectionOf(const char* key, const char* about) {
  return {key, about, [] { return std::any(Params{}); },
          [](std::any& params, ParamVisitor& v) { std::any_cast<Params&>(params).visit(v); }};
}

const PlannerSection kDwa = sectionOf<WindowParams>("dwa", "dynamic window approach");
const PlannerSection kHrvo = sectionOf<HrvoPlannerParams>("hrvo", "hybrid reciprocal velocity obstacles");
const PlannerSection kEdwa = sectionOf<EdwaParams>("edwa", "enhanced dynamic window approach");
const PlannerSection kBand = sectionOf<BandPlannerParams>(
    "band",
    "timed elastic bands: teb, pteb, eteb, eteb-printed, pteb+eteb; view.obstacles and view.heading_of_hrvo go by "
    "that name");

template <class Params, std::unique_ptr<LocalPlanner> (*make)(const Params&)>
std::unique_ptr<LocalPlanner> from(const LocalPlannerParams& p, const std::string&) {
  return make(p.of<Params>());
}

std::unique_ptr<LocalPlanner> band(const LocalPlannerParams& p, const std::string& name) {
  return makeBandPlanner(p.of<BandPlannerParams>(), name);
}

}  // namespace

LocalPlannerParams::LocalPlannerParams() {
  for (const auto& row : localPlanners()) {
    const bool known =
        std::any_of(sections_.begin(), sections_.end(), [&](const Section& s) { return s.kind == row.section; });
    if (row.section != nullptr && !known) sections_.push_back({row.section, row.section->defaults()});
  }
}

void LocalPlannerParams::visit(ParamVisitor& v) {
  for (auto& s : sections_)
    v.section(s.kind->key, s.kind->about, [&s](ParamVisitor& inner) { s.kind->visit(s.params, inner); });
}

const std::vector<LocalPlannerRow>& localPlanners() {
  static const std::vector<LocalPlannerRow> kRows = {
      {"dwa", "dynamic window", &kDwa, true, from<WindowParams, makeDwa>},
      {"hrvo", "hybrid reciprocal velocity obstacles", &kHrvo, true, from<HrvoPlannerParams, makeHrvoPlanner>},
      {"edwa", "dynamic window advised by hrvo", &kEdwa, true, from<EdwaParams, makeEdwa>},
      {"teb", "timed elastic band among people where they are", &kBand, true, band},
      {"pteb", "timed elastic band advised by hrvo", &kBand, true, band},
      {"eteb", "timed elastic band among people where they will be", &kBand, true, band},
      {"eteb-printed", "the same with one predicted position beside the present one", &kBand, true, band},
      {"pteb+eteb", "eteb advised by hrvo", &kBand, true, band},
      {"straight", "straight to the goal, whatever is in the way", nullptr, false,
       [](const LocalPlannerParams&, const std::string&) { return makeStraightPlanner(); }},
      {"stand", "stands", nullptr, false,
       [](const LocalPlannerParams&, const std::string&) { return makeStandPlanner(); }},
  };
  return kRows;
}

std::vector<std::string> localPlannerNames() {
  std::vector<std::string> names;
  for (const auto& row : localPlanners()) names.emplace_back(row.name);
  return names;
}

const LocalPlannerRow& localPlanner(const std::string& name) {
  std::string all;
  for (const auto& row : localPlanners()) {
    if (name == row.name) return row;
    all += (all.empty() ? "" : ", ") + std::string(row.name);
  }
  const std::string near = nearestWord(name, localPlannerNames());
  throw ConfigError("no local planner '" + name + "'; there are " + all +
                    (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

std::unique_ptr<LocalPlanner> makeLocalPlanner(const std::string& name, const LocalPlannerParams& params) {
  return localPlanner(name).make(params, name);
}

}  // namespace sidestep
