// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "common/program.h"
#include "sidestep-simulate/simulate_config.h"
#include "sidestep-simulate/simulate_run.h"

int main(int argc, char** argv) {
  using namespace sidestep;
  SimulateOptions o;
  CLI::App app("Runs a scenario and writes what was sensed, and the truth, as a rawlog.", "sidestep-simulate");
  app.add_option("-c,--config,SCENARIO", o.scenario, "the scenario (YAML)")->type_name("FILE");
  app.add_option("-o,--output", o.output, "output folder")->type_name("DIR")->capture_default_str();
  app.add_flag("-w,--overwrite", o.overwrite, "write into a folder that holds something");
  app.add_flag("-q,--quiet", o.quiet, "no progress bar");
  app.add_option("--seed", o.seed, "of the random numbers")->type_name("N");
  app.add_option("--planner", o.planners, "planner of the robot under test; with --snapshots several, a column each")
      ->type_name("NAME,...")
      ->delimiter(',');
  app.add_option("--snapshots", o.snapshots_s, "draw what the planner considers at these times: snapshots.png")
      ->type_name("SECONDS,...")
      ->delimiter(',');
  app.add_flag("--explain", o.explain, "why the planner of the robot under test did what it did: explain.csv");
  app.add_flag("--no-picture", o.no_picture, "do not draw trajectory.png, timeline.png");
  app.add_flag("--video", o.video, "film a world: run.mp4, through ffmpeg");
  app.add_flag("--write-config", o.write_config, "print all parameters as commented YAML and exit");
  app.add_option("--kind", o.kind, "of the scenario that --write-config prints")
      ->type_name("KIND")
      ->check(CLI::IsMember({"localization", "world"}));
  app.add_flag("--force", o.force, "run a world although something overlaps in it or cannot be reached");
  app.footer(
      "Example:\n"
      "  sidestep-simulate share/scenarios/roof-curve.yaml -o out-roof\n"
      "Makes run.rawlog, trajectory.png, metrics.json, effective.yaml, command.txt; of a world timeline.png too.\n"
      "Exit codes: 0 done, 2 usage, 3 input missing, 130 interrupted (what was run is saved).");
  return runProgram(argc, argv, app, [&] { return simulate(o); });
}
