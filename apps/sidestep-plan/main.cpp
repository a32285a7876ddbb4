// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "common/program.h"
#include "sidestep-plan/commands.h"

int main(int argc, char** argv) {
  using namespace sidestep;
  CLI::App app("Plans how a robot gets where it should.", "sidestep-plan");
  Work work;
  app.require_subcommand(1);
  addBandCommand(app, work);
  addCrossingCommand(app, work);
  app.footer(
      "Exit codes: 0 done, 2 usage, 3 input missing, 4 input damaged, 5 no path, 130 interrupted.\n"
      "Example:\n"
      "  sidestep-plan band --problems share/problems/band.csv --planner teb -o out-band");
  return runProgram(argc, argv, app, [&] { return work(); });
}
