// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-simulate/localization_run.h"

#include <mrpt/obs/CObservation.h>

#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "datasets/log_writer.h"
#include "evaluation/metrics/metric_json.h"
#include "evaluation/metrics/trajectory_error.h"
#include "figures/trajectory_figure.h"
#include "simulation/observations.h"

namespace sidestep {
namespace {

/// What a run adds up to.
struct Summary {
  TrajectoryErrorMeter odometry;
  TrajectoryFigure figure;
  std::map<std::string, uint64_t> written;
  double duration_s = 0, path_m = 0;
};

void note(const SensorStep& step, const mrpt::math::TPose2D& start, Summary& out) {
  const mrpt::math::TPose2D odometry = start + step.odometry.pose;
  out.odometry.add({step.time_s, odometry, step.truth.pose});
  out.figure.truth.add(step.truth.pose.x, step.truth.pose.y);
  out.figure.odometry.add(odometry.x, odometry.y);
  if (step.gps) out.figure.fixes.add(step.gps->x, step.gps->y);
  out.duration_s = step.time_s;
  out.path_m += std::abs(step.truth.distance_m);
}

std::string metricsText(const Scenario& config, const Summary& summary) {
  const TrajectoryErrors errors = summary.odometry.measure(Alignment::kNone);
  nlohmann::ordered_json odometry{{"samples", errors.samples}};
  addMetrics(errorMetrics(), errors, {}, odometry);
  const nlohmann::ordered_json json{{"kind", config.kind},
                                    {"seed", config.seed},
                                    {"duration_s", summary.duration_s},
                                    {"path_m", summary.path_m},
                                    {"observations", summary.written},
                                    {"odometry", odometry},
                                    {"partial", interrupted()}};
  return json.dump(2) + "\n";
}

}  // namespace

ExitCode runLocalization(const SimulateOptions& options, const Scenario& config, const OutputFolder& folder) {
  const LocalizationScenario scenario(config.localization);
  LogWriter log(folder.file("run.rawlog"), commandLine());
  Summary summary;
  {
    ProgressBar bar("simulating", options.quiet);
    auto stream = scenario.run(static_cast<uint64_t>(config.seed));
    for (SensorStep step; !interrupted() && stream.next(step);) {
      tellObservations(step, config.localization.encoders, config.localization.gps,
                       [&](const mrpt::obs::CObservation& o) {
                         log.write(o);
                         ++summary.written[o.sensorLabel];
                       });
      note(step, scenario.truth().front().pose, summary);
      bar.update(step.time_s / config.localization.trajectory.duration_s);
    }
  }
  log.close();
  folder.writeText("metrics.json", metricsText(config, summary));
  if (!options.no_picture) {
    summary.figure.title = options.scenario.substr(options.scenario.find_last_of('/') + 1);
    drawTrajectory(summary.figure, folder.file("trajectory.png"));
  }
  std::printf("%s: %.1f s, %.1f m, odometry alone ends up %.2f m off\n", folder.file("run.rawlog").c_str(),
              summary.duration_s, summary.path_m, summary.odometry.measure(Alignment::kNone).final_error_m);
  return interrupted() ? ExitCode::kInterrupted : ExitCode::kDone;
}

}  // namespace sidestep
