// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-simulate/world_run.h"

#include <mrpt/obs/CObservation.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "datasets/log_writer.h"
#include "evaluation/experiments/plan_snapshots.h"
#include "evaluation/experiments/standing_reasons.h"
#include "evaluation/experiments/world_controllers.h"
#include "evaluation/experiments/world_record.h"
#include "evaluation/metrics/collision_index.h"
#include "evaluation/metrics/metric_json.h"
#include "evaluation/metrics/world_metrics.h"
#include "figures/timeline_figure.h"
#include "figures/world_figure.h"
#include "planning/plan_explanation.h"
#include "simulation/world_observations.h"

namespace sidestep {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kStandsMuch = 0.1;  ///< share of a run from which the summary says why

/// What is noted of the planner of the robot under test.
struct PlanNotes {
  PlanCount plans;
  StandingReasons standing;
  PlanExplanation explanation;
};

Json standingJson(const StandingReasons& standing) {
  Json reasons = Json::array();
  for (const auto& [reason, share] : standing.reasons()) reasons.push_back({{"reason", reason}, {"share", share}});
  return {{"share", standing.share()}, {"reasons", reasons}};
}

/// "anna", or "crowd 3" of several.
std::string nameOfPerson(const WorldParams& world, int id) {
  for (const auto& name : world.people_names) {
    const int count = world.people.at(name).count;
    if (id < count) return count == 1 ? name : name + " " + std::to_string(id + 1);
    id -= count;
  }
  return "person " + std::to_string(id);
}

Json stuckJson(const World& world) {
  Json out = Json::array();
  for (const StuckPerson& p : world.stuckPeople())
    out.push_back({{"person", nameOfPerson(world.params(), p.id)},
                   {"x", p.position.x},
                   {"y", p.position.y},
                   {"from_s", p.from_s},
                   {"for_s", p.for_s}});
  return out;
}

std::string metricsText(const Scenario& config, const World& world, const WorldRecorder& recorder,
                        const PlanNotes& notes, const Json& written) {
  const WorldSummary s = summarize(world);
  Json hits = Json::array();
  for (const Contact& c : world.contacts(world.robotUnderTest()).contacts())
    hits.push_back(
        {{"kind", word(c.kind)}, {"time_s", c.time_s}, {"other", c.other}, {"closing_speed", c.closing_speed}});
  Json json{{"kind", config.kind}, {"seed", config.seed}};
  const WorldNumbers numbers{s, recorder.largestCollisionIndex(), recorder.timeAboveThreshold(),
                             recorder.timeStanding(), notes.plans};
  addMetrics(worldMetrics(), numbers, {.aliases = true, .undefined_is_null = true}, json);
  json["contacts"] = s.contacts;
  json["hits"] = hits;
  json["standing"] = standingJson(notes.standing);
  json["stuck_people"] = stuckJson(world);
  json["observations"] = written;
  json["partial"] = interrupted();
  return json.dump(2) + "\n";
}

/// Has the planner of the robot under test say why it stands and, if asked for, why it does what it does.
void watchPlans(const WorldScenario& scenario, bool explain, World& world, PlanNotes& notes) {
  const bool watched =
      watchRobotUnderTest(world, scenario, explain, [&notes, explain](const PlanInput& in, const PlanOutput& out) {
        notes.plans.add(out);
        notes.standing.note(in, out);
        if (explain) notes.explanation.note(in.time_s, out);
      });
  if (!watched && explain)
    throw ConfigError("--explain: the planner of the robot under test is " + robotUnderTest(scenario.world).planner +
                      ", which is no local planner");
}

void printSummary(const World& world, const StandingReasons& standing, const std::string& log_file) {
  const WorldSummary s = summarize(world);
  std::printf("%s: %s after %.2f s, %.2f m, %zu contacts", log_file.c_str(), s.arrived ? "arrived" : "not arrived",
              s.time_s, s.path_m, world.contacts(world.robotUnderTest()).contacts().size());
  if (std::isfinite(s.min_clearance_m)) std::printf(", closest %.2f m", s.min_clearance_m);
  std::printf("\n");
  if (standing.share() > kStandsMuch)
    for (const auto& [reason, share] : standing.reasons())
      if (share > 0.2 * standing.share())
        std::printf("the robot stood for %.0f %% of the run: %s\n", 100 * share, reason.c_str());
  for (const StuckPerson& p : world.stuckPeople())
    std::printf("%s was stuck at (%.2f, %.2f) for %.0f s, from %.0f s on\n", nameOfPerson(world.params(), p.id).c_str(),
                p.position.x, p.position.y, p.for_s, p.from_s);
}

void film(const WorldFigure& figure, const OutputFolder& folder) {
  const std::string frames = folder.file("frames");
  std::filesystem::create_directories(frames);
  filmWorld(figure, frames, folder.file("run.mp4"));
  std::filesystem::remove_all(frames);
}

/// A column for each planner of the command line, or one for the scenario's.
void drawSnapshotsOf(const SimulateOptions& options, const Scenario& config, const WorldInputs& inputs,
                     const World& world, const OutputFolder& folder) {
  WorldScenario scenario = config.world;
  std::string& planner = robotUnderTest(scenario.world).planner;
  const auto planners = options.planners.empty() ? std::vector<std::string>{planner} : options.planners;
  std::vector<double> times = options.snapshots_s;
  std::sort(times.begin(), times.end());
  std::vector<SnapshotColumn> columns;
  for (const auto& name : planners) {
    planner = name;
    columns.push_back({name, takeSnapshots(scenario, static_cast<uint64_t>(config.seed), inputs, times)});
  }
  drawSnapshots(columns, world.walls().walls(), folder.file("snapshots.png"));
}

}  // namespace

ExitCode runWorld(const SimulateOptions& options, const Scenario& config, const WorldInputs& inputs,
                  const OutputFolder& folder) {
  World world(config.world.world, static_cast<uint64_t>(config.seed), inputs,
              navigatorControllers(config.world.planners));
  PlanNotes notes;
  watchPlans(config.world, options.explain, world, notes);
  LogWriter log(folder.file("run.rawlog"), commandLine());
  WorldReporter reporter(world);
  WorldRecorder recorder(world);
  std::map<std::string, uint64_t> written;
  const auto report = [&] { reporter.tell([&](const auto& o) { log.write(o), ++written[o.sensorLabel]; }); };
  {
    ProgressBar bar("simulating", options.quiet);
    report();
    world.run([&] {
      report();
      recorder.note();
      bar.update(world.time() / config.world.world.duration_s);
      return !interrupted();
    });
  }
  log.close();
  folder.writeText("metrics.json", metricsText(config, world, recorder, notes, written));
  recorder.figure().title = options.scenario.substr(options.scenario.find_last_of('/') + 1);
  if (options.explain) folder.writeText("explain.csv", notes.explanation.csv());
  if (!options.no_picture) {
    drawWorld(recorder.figure(), folder.file("trajectory.png"));
    drawTimeline({recorder.figure().title, kCollisionIndexThreshold, {{"", recorder.timeline()}}},
                 folder.file("timeline.png"));
  }
  if (options.video) film(recorder.figure(), folder);
  if (!options.snapshots_s.empty() && !interrupted()) drawSnapshotsOf(options, config, inputs, world, folder);
  printSummary(world, notes.standing, folder.file("run.rawlog"));
  return interrupted() ? ExitCode::kInterrupted : ExitCode::kDone;
}

}  // namespace sidestep
