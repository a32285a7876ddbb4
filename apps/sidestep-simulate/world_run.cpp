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
#include "evaluation/experiments/plan_explanation.h"
#include "evaluation/experiments/plan_snapshots.h"
#include "evaluation/experiments/world_controllers.h"
#include "evaluation/experiments/world_record.h"
#include "evaluation/metrics/collision_index.h"
#include "figures/timeline_figure.h"
#include "figures/world_figure.h"
#include "simulation/world_observations.h"

namespace sidestep {
namespace {

using Json = nlohmann::ordered_json;

Json finiteOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string metricsText(const Scenario& config, const World& world, const WorldRecorder& recorder,
                        const Json& written) {
  const WorldSummary s = summarize(world);
  Json hits = Json::array();
  for (const Contact& c : world.contacts(world.robotUnderTest()).contacts())
    hits.push_back(
        {{"kind", word(c.kind)}, {"time_s", c.time_s}, {"other", c.other}, {"closing_speed", c.closing_speed}});
  const Json json{{"kind", config.kind},
                  {"seed", config.seed},
                  {"success", s.success},
                  {"arrived", s.arrived},
                  {"goals_reached", s.goals_reached},
                  {"time_s", s.time_s},
                  {"path_m", s.path_m},
                  {"average_velocity", s.average_velocity},
                  {"min_clearance_m", finiteOrNull(s.min_clearance_m)},
                  {"min_wall_clearance_m", finiteOrNull(s.min_wall_clearance_m)},
                  {"delta_min", deltaMin(s.min_clearance_m)},
                  {"collision_index_max", recorder.largestCollisionIndex()},
                  {"contacts", s.contacts},
                  {"hits", hits},
                  {"observations", written},
                  {"partial", interrupted()}};
  return json.dump(2) + "\n";
}

/// Has the planner of the robot under test say why it does what it does.
void askForReasons(const WorldScenario& scenario, World& world, PlanExplanation& explanation) {
  const RobotParams& robot = robotUnderTest(scenario.world);
  if (!watchRobotUnderTest(world, scenario, true, [&explanation](const PlanInput& in, const PlanOutput& out) {
        explanation.note(in.time_s, out);
      }))
    throw ConfigError("--explain: the planner of the robot under test is " + robot.planner +
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
  if (options.explain) askForReasons(config.world, world, explanation);
  LogWriter log(folder.file("run.rawlog"), commandLine());
  WorldReporter reporter(world);
  WorldRecorder recorder(world);
  std::map<std::string, uint64_t> written;
  const auto report = [&] {
    reporter.tell([&](const mrpt::obs::CObservation& o) {
      log.write(o);
      ++written[o.sensorLabel];
    });
  };
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
  folder.writeText("metrics.json", metricsText(config, world, recorder, written));
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
