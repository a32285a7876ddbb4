// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-simulate/world_run.h"

#include <mrpt/obs/CObservation.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "datasets/log_writer.h"
#include "datasets/track_file.h"
#include "evaluation/plan_snapshots.h"
#include "evaluation/planner_driver.h"
#include "evaluation/world_figure.h"
#include "maps/map_file.h"
#include "simulation/map_walls.h"
#include "simulation/world_observations.h"

namespace sidestep {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kFigurePeriod_s = 0.1;

/// A path in a scenario is meant from the scenario's own folder, unless it is found from here.
std::string foundFile(const std::string& name, const std::string& scenario) {
  namespace fs = std::filesystem;
  if (fs::exists(name)) return name;
  const auto beside = fs::path(scenario).parent_path() / name;
  return fs::exists(beside) ? beside.string() : name;
}

WorldInputs inputsOf(const SimulateOptions& options, const WorldParams& p) {
  WorldInputs out;
  if (!p.map.empty()) {
    ObstacleParams known_only;
    known_only.unknown_blocks = false;
    out.walls = wallsOf(readMap(foundFile(p.map, options.scenario)), known_only);
  }
  if (p.tracks.empty()) return out;
  for (const auto& [id, rows] : readTracks(foundFile(p.tracks, options.scenario))) {
    RecordedTrack& track = out.tracks.emplace_back();
    track.id = id;
    for (const auto& row : rows) track.points.push_back({row.time_s - p.tracks_from_s, {row.x, row.y}});
  }
  return out;
}

/// Notes where everybody is.
class Paths {
 public:
  explicit Paths(const World& world) : world_(world) {
    figure_.period_s = kFigurePeriod_s;
    figure_.goal = {world.robots()[0].goal.x, world.robots()[0].goal.y};
    figure_.walls.assign(world.walls().walls().begin(), world.walls().walls().end());
    for (size_t i = 0; i < world.robots().size(); ++i)
      figure_.paths.push_back({world.params().robot_names[i], world.robots()[i].radius_m, i == 0, {}});
    for (const Person& p : world.people()) figure_.paths.push_back({std::to_string(p.id), p.radius_m, false, {}});
  }
  void note() {
    if (world_.time() + 1e-9 < next_s_) return;
    next_s_ += kFigurePeriod_s;
    size_t k = 0;
    for (const RobotState& r : world_.robots()) figure_.paths[k++].places.emplace_back(r.pose.x, r.pose.y);
    constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
    for (const Person& p : world_.people())
      figure_.paths[k++].places.push_back(p.present ? p.position : mrpt::math::TPoint2D(kNowhere, kNowhere));
  }
  WorldFigure& figure() { return figure_; }

 private:
  const World& world_;
  WorldFigure figure_;
  double next_s_ = 0;
};

Json finiteOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string metricsText(const SimulateConfig& config, const World& world, const Json& written) {
  const WorldSummary s = summarize(world);
  Json hits = Json::array();
  for (const Contact& c : world.contacts(0).contacts())
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
                  {"contacts", s.contacts},
                  {"hits", hits},
                  {"observations", written},
                  {"partial", interrupted()}};
  return json.dump(2) + "\n";
}

void film(const WorldFigure& figure, const OutputFolder& folder) {
  const std::string frames = folder.file("frames");
  std::filesystem::create_directories(frames);
  filmWorld(figure, frames, folder.file("run.mp4"));
  std::filesystem::remove_all(frames);
}

/// A column for each planner of the command line, or one for the scenario's.
void drawSnapshotsOf(const SimulateOptions& options, const SimulateConfig& config, const WorldInputs& inputs,
                     const World& world, const OutputFolder& folder) {
  WorldParams params = config.world;
  RobotParams& robot = params.robots.at(params.robot_names[0]);
  const auto planners = options.planners.empty() ? std::vector<std::string>{robot.planner} : options.planners;
  std::vector<double> times = options.snapshots_s;
  std::sort(times.begin(), times.end());
  std::vector<SnapshotColumn> columns;
  for (const auto& planner : planners) {
    robot.planner = planner;
    columns.push_back(
        {planner, takeSnapshots(params, static_cast<uint64_t>(config.seed), inputs, config.planners, times)});
  }
  drawSnapshots(columns, world.walls().walls(), folder.file("snapshots.png"));
}

}  // namespace

ExitCode runWorld(const SimulateOptions& options, const SimulateConfig& config, const OutputFolder& folder) {
  const WorldInputs inputs = inputsOf(options, config.world);
  World world(config.world, static_cast<uint64_t>(config.seed), inputs, plannerDrivers(config.planners));
  LogWriter log(folder.file("run.rawlog"), commandLine());
  WorldReporter reporter(world);
  Paths paths(world);
  std::map<std::string, uint64_t> written;
  const auto report = [&] {
    reporter.tell([&](const mrpt::obs::CObservation& o) {
      log.write(o);
      ++written[o.sensorLabel];
    });
    paths.note();
  };
  {
    ProgressBar bar("simulating", options.quiet);
    report();
    world.run([&] {
      report();
      bar.update(world.time() / config.world.duration_s);
      return !interrupted();
    });
  }
  log.close();
  folder.writeText("metrics.json", metricsText(config, world, written));
  paths.figure().title = options.scenario.substr(options.scenario.find_last_of('/') + 1);
  if (!options.no_picture) drawWorld(paths.figure(), folder.file("trajectory.png"));
  if (options.video) film(paths.figure(), folder);
  if (!options.snapshots_s.empty() && !interrupted()) drawSnapshotsOf(options, config, inputs, world, folder);
  const WorldSummary s = summarize(world);
  std::printf("%s: %s after %.2f s, %.2f m, %zu contacts", folder.file("run.rawlog").c_str(),
              s.arrived ? "arrived" : "not arrived", s.time_s, s.path_m, world.contacts(0).contacts().size());
  if (std::isfinite(s.min_clearance_m)) std::printf(", closest %.2f m", s.min_clearance_m);
  std::printf("\n");
  return interrupted() ? ExitCode::kInterrupted : ExitCode::kDone;
}

}  // namespace sidestep
