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

std::string metricsText(const Scenario& config, const World& world, const WorldRecorder& recorder,
                        const PlanCount& plans, const Json& written) {
  const WorldSummary s = summarize(world);
  Json hits = Json::array();
  for (const Contact& c : world.contacts(world.robotUnderTest()).contacts())
    hits.push_back(
        {{"kind", word(c.kind)}, {"time_s", c.time_s}, {"other", c.other}, {"closing_speed", c.closing_speed}});
  Json json{{"kind", config.kind}, {"seed", config.seed}};
  const WorldNumbers numbers{s, recorder.largestCollisionIndex(), recorder.timeAboveThreshold(),
                             recorder.timeStanding(), plans};
  addMetrics(worldMetrics(), numbers, {.aliases = true, .undefined_is_null = true}, json);
  json["contacts"] = s.contacts;
  json["hits"] = hits;
  json["observations"] = written;
  json["partial"] = interrupted();
  return json.dump(2) + "\n";
}

/// Counts the plans of the robot under test; with `explanation` its planner says why it does what it does.
void watchPlans(const WorldScenario& scenario, World& world, PlanCount& plans, PlanExplanation* explanation) {
  const bool watched = watchRobotUnderTest(world, scenario, explanation != nullptr,
                                           [&plans, explanation](const PlanInput& in, const PlanOutput& out) {
                                             plans.add(out);
                                             if (explanation != nullptr) explanation->note(in.time_s, out);
                                           });
  if (!watched && explanation != nullptr)
    throw ConfigError("--explain: the planner of the robot under test is " + robotUnderTest(scenario.world).planner +
                      ", which is no local planner");
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

ExitCode runWorld(const SimulateOptions& options, const Scenario& config, const OutputFolder& folder) {
  const WorldInputs inputs = readWorldInputs(config.world.world, options.scenario);
  World world(config.world.world, static_cast<uint64_t>(config.seed), inputs,
              navigatorControllers(config.world.planners));
  PlanExplanation explanation;
  PlanCount plans;
  watchPlans(config.world, world, plans, options.explain ? &explanation : nullptr);
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
  folder.writeText("metrics.json", metricsText(config, world, recorder, plans, written));
  recorder.figure().title = options.scenario.substr(options.scenario.find_last_of('/') + 1);
  if (options.explain) folder.writeText("explain.csv", explanation.csv());
  if (!options.no_picture) {
    drawWorld(recorder.figure(), folder.file("trajectory.png"));
    drawTimeline({recorder.figure().title, kCollisionIndexThreshold, {{"", recorder.timeline()}}},
                 folder.file("timeline.png"));
  }
  if (options.video) film(recorder.figure(), folder);
  if (!options.snapshots_s.empty() && !interrupted()) drawSnapshotsOf(options, config, inputs, world, folder);
  const WorldSummary s = summarize(world);
  std::printf("%s: %s after %.2f s, %.2f m, %zu contacts", folder.file("run.rawlog").c_str(),
              s.arrived ? "arrived" : "not arrived", s.time_s, s.path_m,
              world.contacts(world.robotUnderTest()).contacts().size());
  if (std::isfinite(s.min_clearance_m)) std::printf(", closest %.2f m", s.min_clearance_m);
  std::printf("\n");
  return interrupted() ? ExitCode::kInterrupted : ExitCode::kDone;
}

}  // namespace sidestep
