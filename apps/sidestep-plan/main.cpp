// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "common/program.h"
#include "sidestep-plan/commands.h"

int main(int argc, char** argv) {
  using namespace sidestep;
  CLI::App app("Plans how a robot gets where it should.", "sidestep-plan");
  Work work;
  app.require_subcommand(1);
  addPathCommand(app, work);
  addBandCommand(app, work);
  addCrossingCommand(app, work);
  app.footer(
      "Exit codes: 0 done, 2 usage, 3 input missing, 4 input damaged, 5 no path, 130 interrupted.\n"
      "Example (a map that comes with the Debian package mrpt-common):\n"
      "  sidestep-plan path --map /usr/share/mrpt/datasets/2006-MalagaCampus.gridmap.gz \\\n"
      "    --start 108.44,3.24,0 --goal 72.92,-32.84,90 --planner theta -o out-theta");
  return runProgram(argc, argv, app, [&] { return work(); });
}
