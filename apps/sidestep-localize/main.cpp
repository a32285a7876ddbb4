// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "common/program.h"
#include "localization/sensors/sensors.h"
#include "sidestep-localize/localize_run.h"

int main(int argc, char** argv) {
  using namespace sidestep;
  LocalizeOptions o;
  CLI::App app("Tells where a robot was, from its rawlog.", "sidestep-localize");
  app.add_option("LOG", o.log, "rawlog, plain or gzip")->type_name("");
  app.add_option("-c,--config", o.config_file, "parameters of the robot and the filter (YAML)")->type_name("FILE");
  app.add_option("-o,--output", o.output, "output folder")->type_name("DIR")->capture_default_str();
  app.add_flag("-w,--overwrite", o.overwrite, "write into a folder that holds something");
  app.add_flag("-q,--quiet", o.quiet, "no progress bar");
  app.add_option("--filter", o.filter, "the estimator")->check(CLI::IsMember(filterNames()))->type_name("NAME");
  app.add_flag("--smooth", o.smooth, "estimates by the whole log, not only by what came before (ekf)");
  app.add_option("--sensors", o.sensors, "of " + sensorWords(",") + "; default: those the log has")->type_name("LIST");
  app.add_option("--map", o.map, "where the robot is, for mcl: ROS yaml, .gridmap, .simplemap, image")
      ->type_name("FILE");
  app.add_option("--initial-pose", o.initial_pose, "where the robot starts")->type_name("x,y,deg");
  app.add_option("--ground-truth", o.ground_truth, "true poses (TUM), instead of the log's own")->type_name("FILE");
  app.add_option("--align", o.align, "lay the estimate onto the truth: auto, none, first pose, least squares")
      ->check(CLI::IsMember({"auto", "none", "first", "se2"}))
      ->type_name("HOW");
  app.add_option("--label", o.labels, "which label serves as a kind of sensor, e.g. gps=GPS_RTK_REAR")
      ->type_name("KIND=LABEL");
  app.add_option("--from", o.from_s, "start this long after the first stamp [s]")->type_name("S");
  app.add_option("--to", o.to_s, "stop this long after the first stamp [s]")->type_name("S");
  app.add_option("--seed", o.seed, "of the random numbers")->type_name("N");
  app.add_flag("--no-picture", o.no_picture, "do not draw trajectory.png and consistency.png");
  app.add_flag("--write-config", o.write_config, "print all parameters as commented YAML and exit");
  app.footer(
      "Example (a real log that comes with the Debian package mrpt-common):\n"
      "  sidestep-localize /usr/share/mrpt/datasets/uwb_ro-localization_demo.rawlog \\\n"
      "    -c share/robots/uwb-demo.yaml --sensors odometry,beacons -o out-uwb \\\n"
      "    --ground-truth /usr/share/mrpt/datasets/uwb_ro-localization_demo_GT.txt\n"
      "Makes estimate.rawlog, trajectory.tum, trajectory.png, metrics.json, effective.yaml, command.txt.\n"
      "Exit codes: 0 done, 2 usage, 3 input missing, 4 input damaged (what came before is used), 130 interrupted.");
  return runProgram(argc, argv, app, [&] { return localize(o); });
}
