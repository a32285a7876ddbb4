// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// The subcommand `path`: its options.
#include <memory>

#include "sidestep-plan/commands.h"
#include "sidestep-plan/path_run.h"

namespace sidestep {

void addPathCommand(CLI::App& app, Work& work) {
  const auto o = std::make_shared<PathOptions>();
  CLI::App* c = app.add_subcommand("path", "a path on a map");
  c->add_option("--map", o->map, ".yaml of ROS, .gridmap(.gz), .simplemap(.gz), .pgm, .png, .bmp")->type_name("FILE");
  c->add_option("--start", o->start, "where the path begins")->type_name("x,y,deg");
  c->add_option("--goal", o->goal, "where it ends")->type_name("x,y,deg");
  c->add_option("--pairs", o->pairs_file, "many queries: CSV with columns start_x,start_y,goal_x,goal_y")
      ->type_name("FILE");
  c->add_option("--planner", o->planner, "who plans; default astar")
      ->check(CLI::IsMember(globalPlanners()))
      ->type_name("NAME");
  c->add_flag("--all", o->all, "every planner, one after the other");
  c->add_option("--space", o->space, "of OMPL's planners: se2, dubins, reeds-shepp")
      ->check(CLI::IsMember({"se2", "dubins", "reeds-shepp"}))
      ->type_name("NAME");
  c->add_option("--clearance", o->clearance_m, "between robot centre and obstacles [m]")->type_name("M");
  c->add_option("--footprint", o->footprint, "corners of the robot in its base frame; it may then turn anywhere")
      ->type_name("x,y,x,y,...");
  c->add_option("--resolution", o->resolution_m, "of a plain image: side of a pixel [m]")->type_name("M");
  c->add_option("--time", o->time_s, "allowed for a path of OMPL's planners [s]")->type_name("S");
  c->add_flag("--nearest", o->nearest, "move start and goal to the nearest free cell if they are not free");
  c->add_flag("--smooth", o->smooth, "round the path off");
  c->add_option("-c,--config", o->config_file, "parameters (YAML)")->type_name("FILE");
  c->add_option("-o,--output", o->output, "output folder")->type_name("DIR")->capture_default_str();
  c->add_flag("-w,--overwrite", o->overwrite, "write into a folder that holds something");
  c->add_flag("-q,--quiet", o->quiet, "no progress bar");
  c->add_option("--seed", o->seed, "of the random numbers")->type_name("N");
  c->add_flag("--no-picture", o->no_picture, "do not draw path.png");
  c->add_flag("--write-config", o->write_config, "print all parameters as commented YAML and exit");
  c->footer(
      "Planners: astar, theta (any angle), dijkstra; of OMPL: rrtconnect, rrtstar, informed-rrtstar, bitstar, "
      "prmstar,\n"
      "kpiece. Makes path.csv, path.tum, path.png, or for --pairs paths.csv; metrics.json, effective.yaml, "
      "command.txt.\n"
      "Example (a map that comes with the Debian package mrpt-common):\n"
      "  sidestep-plan path --map /usr/share/mrpt/datasets/2006-MalagaCampus.gridmap.gz \\\n"
      "    --start 108.44,3.24,0 --goal 72.92,-32.84,90 --planner theta --smooth -o out-path");
  c->callback([&work, o] { work = [o] { return planPaths(*o); }; });
}

}  // namespace sidestep
