// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// sidestep-localize on logs long enough that memory and an interrupt matter.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "datasets/log_reader.h"
#include "datasets/log_writer.h"
#include "support/readings.h"
#include "support/run_program.h"

namespace sidestep::testing {
namespace {

std::string logOf(const TemporaryFolder& folder, int readings) {
  const std::string file = (folder / ("log" + std::to_string(readings) + ".rawlog")).string();
  LogWriter log(file, "", LogWriter::Flush::kBySize);
  for (int i = 0; i < readings; ++i) {
    auto o = support::odometryAt(support::kStart_s + 0.05 * i, support::onCircle(1, 0.1, 0.05 * i));
    o.sensorLabel = "odometry";
    log.write(o);
  }
  log.close();
  return file;
}

nlohmann::json metricsIn(const std::filesystem::path& out) {
  return nlohmann::json::parse(readFile(out / "metrics.json"));
}

TEST(LocalizeALongLog, TakesNoMoreMemoryForTwentyTimesTheLog) {
  const TemporaryFolder folder;
  double peak_mb[2];
  for (const int k : {0, 1}) {
    const auto out = folder / ("out" + std::to_string(k));
    const auto run =
        runShell("sidestep-localize '" + logOf(folder, k ? 200000 : 10000) + "' -o '" + out.string() + "' -q");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    peak_mb[k] = metricsIn(out).at("peak_memory_mb");
  }
  // The trajectory's picture keeps some thousand points; 190,000 more readings would be 25 MB as observations.
  EXPECT_LT(peak_mb[1], peak_mb[0] + 8);
}

/// Runs the program until its log has grown past its first flush, then interrupts it. Its exit code.
int interrupted(const std::string& log, const std::filesystem::path& out) {
  const pid_t child = fork();
  if (child == 0) {
    const int null = open("/dev/null", O_WRONLY);
    dup2(null, 1);
    dup2(null, 2);
    const std::string program = std::string(SIDESTEP_BIN) + "/sidestep-localize";
    execl(program.c_str(), "sidestep-localize", log.c_str(), "-o", out.c_str(), "-q", nullptr);
    _exit(99);
  }
  int status = 0;
  std::error_code none;
  const auto estimate = out / "estimate.rawlog";
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (!std::filesystem::exists(estimate, none) || std::filesystem::file_size(estimate, none) < 200000) continue;
    kill(child, SIGINT);
    waitpid(child, &status, 0);
    break;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST(LocalizeALongLog, SavesWhatWasDoneWhenInterrupted) {
  const TemporaryFolder folder;
  const auto out = folder / "out";
  EXPECT_EQ(interrupted(logOf(folder, 400000), out), 130);
  EXPECT_TRUE(metricsIn(out).at("partial").get<bool>());
  EXPECT_TRUE(std::filesystem::exists(out / "trajectory.png"));
  LogReader reader((out / "estimate.rawlog").string(), {});
  uint64_t estimates = 0;
  while (const auto e = reader.next()) estimates += e->label == "estimate";
  EXPECT_FALSE(reader.end().damaged) << reader.end().message;  // its end marker is there and right
  EXPECT_GT(estimates, 100u);
  EXPECT_LT(estimates, 400000u);
}

}  // namespace
}  // namespace sidestep::testing
