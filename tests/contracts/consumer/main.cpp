// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Writes a log, reads it back, and asks a local planner for one command: what a user's own program would do.
#include <mrpt/obs/CObservationOdometry.h>

#include <cstdio>

#include "datasets/log_reader.h"
#include "datasets/log_writer.h"
#include "planning/planners.h"

namespace {

void writeLog(const char* file) {
  sidestep::LogWriter log(file, "consumer");
  for (int i = 0; i < 10; ++i) {
    mrpt::obs::CObservationOdometry o;
    o.sensorLabel = "odometry";
    o.timestamp = mrpt::Clock::fromDouble(1.7e9 + 0.1 * i);
    o.odometry = {0.05 * i, 0, 0};
    log.write(o);
  }
  log.close();
}

int readingsIn(const char* file) {
  sidestep::LogReader log(file);
  int n = 0;
  while (log.next()) ++n;
  return log.end().damaged ? -1 : n;
}

double plannedSpeed() {
  const auto planner = sidestep::makeLocalPlanner("dwa");
  sidestep::PlanInput input;
  input.goal = {5, 0, 0};
  sidestep::PlanOutput output;
  planner->plan(input, output);
  return output.command.vx;
}

}  // namespace

int main() {
  writeLog("consumer.rawlog");
  std::printf("%d readings, %s\n", readingsIn("consumer.rawlog"), plannedSpeed() > 0 ? "drives" : "stands");
}
