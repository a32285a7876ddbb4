// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What it costs to write a log's entries and a trajectory: the share of sidestep-localize that is not reading.
#include <benchmark/benchmark.h>
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <cmath>
#include <filesystem>

#include "datasets/ground_truth.h"
#include "datasets/log_writer.h"

namespace sidestep {
namespace {

std::string scratch(const char* name) { return (std::filesystem::temp_directory_path() / name).string(); }

void writeEstimates(benchmark::State& state, LogWriter::Flush flush) {
  const std::string file = scratch("sidestep_bench.rawlog");
  LogWriter log(file, "", flush);
  mrpt::obs::CObservationRobotPose o;
  o.sensorLabel = "estimate";
  double t = 1.7e9;
  for (auto _ : state) {
    t += 0.2;
    o.timestamp = mrpt::Clock::fromDouble(t);
    o.pose.mean.setFromValues(std::sin(t), std::cos(t), 0, std::sin(3 * t), 0, 0);
    o.pose.cov(0, 0) = o.pose.cov(1, 1) = std::abs(std::sin(t));
    log.write(o);
  }
  log.close();
  std::filesystem::remove(file);
}

void writeOdometry(benchmark::State& state) {
  const std::string file = scratch("sidestep_bench.rawlog");
  LogWriter log(file, "", LogWriter::Flush::kBySize);
  mrpt::obs::CObservationOdometry o;
  o.sensorLabel = "odometry";
  double t = 1.7e9;
  for (auto _ : state) {
    t += 0.2;
    o.timestamp = mrpt::Clock::fromDouble(t);
    o.odometry = mrpt::poses::CPose2D(std::sin(t), std::cos(t), std::sin(3 * t));
    log.write(o);
  }
  log.close();
  std::filesystem::remove(file);
}

void writeTum(benchmark::State& state) {
  const std::string file = scratch("sidestep_bench.tum");
  TumWriter tum(file);
  double t = 1.7e9;
  for (auto _ : state) {
    t += 0.2;
    tum.write(t, {std::sin(t), std::cos(t), std::sin(3 * t)});
  }
  tum.close();
  std::filesystem::remove(file);
}

BENCHMARK_CAPTURE(writeEstimates, offline, LogWriter::Flush::kBySize);
BENCHMARK_CAPTURE(writeEstimates, live, LogWriter::Flush::kEachSecond);
BENCHMARK(writeOdometry);
BENCHMARK(writeTum);

}  // namespace
}  // namespace sidestep
