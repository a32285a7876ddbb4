// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// sidestep-localize, run as a user runs it, on the real log that comes with the Debian package mrpt-common.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "support/run_program.h"

namespace sidestep::testing {
namespace {

const std::string kLog = "/usr/share/mrpt/datasets/uwb_ro-localization_demo.rawlog";
const std::string kTruth = "/usr/share/mrpt/datasets/uwb_ro-localization_demo_GT.txt";
const std::vector<std::string> kOutputs = {"estimate.rawlog", "trajectory.tum", "trajectory.png", "metrics.json",
                                           "effective.yaml",  "command.txt",    "consistency.png"};

std::string demoCommand(const std::string& log, const std::filesystem::path& out) {
  return "sidestep-localize '" + log + "' -c share/robots/uwb-demo.yaml --sensors odometry,beacons --ground-truth " +
         kTruth + " -o '" + out.string() + "'";
}

nlohmann::json metricsIn(const std::filesystem::path& out) {
  return nlohmann::json::parse(readFile(out / "metrics.json"));
}

/// Messages are one line: what, where, what to do.
void expectOneLine(const ProgramResult& run) {
  EXPECT_EQ(linesOf(run.err).size(), 1u) << run.err;
  EXPECT_TRUE(run.err.starts_with("sidestep-localize: ")) << run.err;
}

class LocalizeTheDemoLog : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    run_ = new ProgramResult(runShell(demoCommand(kLog, *folder_ / "out")));
  }
  static void TearDownTestSuite() {
    delete run_;
    delete folder_;
  }
  static std::filesystem::path out() { return *folder_ / "out"; }
  inline static TemporaryFolder* folder_ = nullptr;
  inline static ProgramResult* run_ = nullptr;
};

TEST_F(LocalizeTheDemoLog, EndsWellAndLeavesAllOutputs) {
  EXPECT_EQ(run_->exit_code, 0) << run_->err;
  EXPECT_EQ(run_->err, "");  // no progress bar where stderr is no terminal
  EXPECT_NE(run_->out.find("mean error [m]"), std::string::npos) << run_->out;
  for (const auto& name : kOutputs) {
    ASSERT_TRUE(std::filesystem::exists(out() / name)) << name;
    EXPECT_GT(std::filesystem::file_size(out() / name), 0u) << name;
  }
}

TEST_F(LocalizeTheDemoLog, MetricsHaveTheKeysThatAreFixed) {
  const auto m = metricsIn(out());
  for (const char* key : {"duration_s", "wall_s", "peak_memory_mb"}) EXPECT_TRUE(m.at(key).is_number()) << key;
  for (const char* who : {"estimate", "odometry"})
    for (const char* key :
         {"mean_error_m", "mean_square_error_m2", "rmse_m", "max_error_m", "final_error_m", "heading_mean_error_deg"})
      EXPECT_TRUE(m.at(who).at(key).is_number()) << who << " " << key;
  for (const char* key : {"mean_nees", "nees_dof", "nees_independent", "nees_low", "nees_high", "sd_factor"})
    EXPECT_TRUE(m.at("estimate").at(key).is_number()) << key;
  EXPECT_EQ(m.at("estimate").at("verdict"), "over-confident");  // doc/results.md: 4.65, of which little is independent
  EXPECT_EQ(m.at("sensors").size(), 2u) << m.at("sensors");
  for (const auto& [label, sensor] : m.at("sensors").items()) {
    const uint64_t read = sensor.at("read"), used = sensor.at("used");
    uint64_t refused = 0;
    for (const auto& [reason, count] : sensor.at("refused").items()) refused += count.get<uint64_t>();
    EXPECT_GT(read, 0u) << label;
    EXPECT_GE(read, used + refused) << label;
    EXPECT_TRUE(sensor.contains("mean_nis")) << label;
  }
  EXPECT_TRUE(m.at("sensors").at("beacons").at("mean_nis").is_number());
  EXPECT_FALSE(m.at("partial").get<bool>());
  EXPECT_NEAR(m.at("duration_s").get<double>(), 363, 1);  // the log's length, as MRPT's rawlog-edit says
}

TEST_F(LocalizeTheDemoLog, TheParticleFilterSaysWhereElseTheRobotMayBe) {
  const TemporaryFolder folder;
  const auto run = runShell(demoCommand(kLog, folder / "out") + " --filter pf --to 30 --no-picture");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto rows = linesOf(readFile(folder / "out" / "modes.csv"));
  EXPECT_EQ(rows.at(0), "time_s,weight,x_m,y_m,yaw_deg,sd_x_m,sd_y_m,sd_yaw_deg");
  EXPECT_GT(rows.size(), 25u);  // a look a second
  const auto m = metricsIn(folder / "out");
  EXPECT_GE(m.at("most_modes").get<int>(), 1);
  EXPECT_FALSE(std::filesystem::exists(out() / "modes.csv"));  // an EKF has one place
}

/// The targets of `make demo`; a plain EKF with a gate, written apart from this one, gives 0.15 m and 2.1 deg.
TEST_F(LocalizeTheDemoLog, TheErrorsAreWithinTheDemosTargets) {
  const auto m = metricsIn(out());
  EXPECT_LE(m["estimate"]["mean_error_m"].get<double>(), 0.20);
  EXPECT_LE(m["estimate"]["heading_mean_error_deg"].get<double>(), 2.5);
  EXPECT_LT(m["estimate"]["mean_error_m"].get<double>(), m["odometry"]["mean_error_m"].get<double>());
  EXPECT_LT(m["estimate"]["heading_mean_error_deg"].get<double>(),
            m["odometry"]["heading_mean_error_deg"].get<double>());
}

TEST_F(LocalizeTheDemoLog, EffectiveYamlIsEnoughToRunAgainWithTheSameBytes) {
  const TemporaryFolder again;
  const auto run = runShell("sidestep-localize " + kLog + " -c '" + (out() / "effective.yaml").string() +
                            "' --ground-truth " + kTruth + " -o '" + (again / "out").string() + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(readFile(again / "out" / "trajectory.tum"), readFile(out() / "trajectory.tum"));
}

/// The command line stands in the log's header, so both runs are given the same one.
TEST_F(LocalizeTheDemoLog, TheSameInputTwiceGivesTheSameBytes) {
  const TemporaryFolder again;
  std::vector<std::string> tum, rawlog;
  for (int i = 0; i < 2; ++i) {
    const auto run = runShell(demoCommand(kLog, again / "out") + " -w");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    tum.push_back(readFile(again / "out" / "trajectory.tum"));
    rawlog.push_back(readFile(again / "out" / "estimate.rawlog"));
  }
  EXPECT_FALSE(tum[0].empty());
  EXPECT_TRUE(tum[0] == tum[1]);
  EXPECT_FALSE(rawlog[0].empty());
  EXPECT_TRUE(rawlog[0] == rawlog[1]);
}

TEST_F(LocalizeTheDemoLog, TheEstimateCanBeLocalizedAgain) {
  const TemporaryFolder again;
  const auto run = runShell(demoCommand((out() / "estimate.rawlog").string(), again / "out"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(readFile(again / "out" / "trajectory.tum"), readFile(out() / "trajectory.tum"));
}

TEST(Localize, DoesNotWriteIntoAFolderThatHoldsSomethingUnlessAsked) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "out");
  writeFile(folder / "out" / "precious.txt", "mine");
  const auto run = runShell(demoCommand(kLog, folder / "out"));
  EXPECT_EQ(run.exit_code, 2);
  expectOneLine(run);
  EXPECT_NE(run.err.find("--overwrite"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "metrics.json"));
  EXPECT_EQ(runShell(demoCommand(kLog, folder / "out") + " -w").exit_code, 0);
  EXPECT_EQ(readFile(folder / "out" / "precious.txt"), "mine");
}

TEST(Localize, AMissingLogIsExitCode3) {
  const TemporaryFolder folder;
  const auto run = runShell(demoCommand("/no/such/log.rawlog", folder / "out"));
  EXPECT_EQ(run.exit_code, 3);
  expectOneLine(run);
  EXPECT_NE(run.err.find("/no/such/log.rawlog"), std::string::npos) << run.err;
}

TEST(Localize, ATruncatedLogIsExitCode4AndWhatCameBeforeIsLocalized) {
  const TemporaryFolder folder;
  const std::string whole = readFile(kLog);
  writeFile(folder / "cut.rawlog", whole.substr(0, whole.size() / 2));
  const auto run = runShell(demoCommand((folder / "cut.rawlog").string(), folder / "out"));
  EXPECT_EQ(run.exit_code, 4);
  expectOneLine(run);
  EXPECT_NE(run.err.find("entry"), std::string::npos) << run.err;
  for (const auto& name : kOutputs) EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;
  const auto m = metricsIn(folder / "out");
  EXPECT_TRUE(m.at("partial").get<bool>());
  EXPECT_FALSE(m.at("warnings").empty());
  EXPECT_GT(m.at("duration_s").get<double>(), 60);
  EXPECT_FALSE(readFile(folder / "out" / "trajectory.tum").empty());
}

TEST(Localize, AFileThatIsNoRawlogIsExitCode4InOneLine) {
  const TemporaryFolder folder;
  writeFile(folder / "letter.rawlog", "Dear reader, this is no rawlog.\n");
  const auto run = runShell(demoCommand((folder / "letter.rawlog").string(), folder / "out"));
  EXPECT_EQ(run.exit_code, 4) << run.out;
  expectOneLine(run);
  EXPECT_NE(run.err.find("not a rawlog"), std::string::npos) << run.err;
}

TEST(Localize, AnUnknownSensorIsAUsageErrorThatNamesTheNearest) {
  const auto run = runShell("sidestep-localize " + kLog + " --sensors odometry,beacon");
  EXPECT_EQ(run.exit_code, 2);
  expectOneLine(run);
  EXPECT_NE(run.err.find("did you mean 'beacons'?"), std::string::npos) << run.err;
}

TEST(Localize, ASensorThatTheLogLacksIsAMissingInput) {
  const TemporaryFolder folder;
  const auto run =
      runShell("sidestep-localize " + kLog + " --sensors odometry,imu -o '" + (folder / "out").string() + "'");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("'imu'"), std::string::npos) << run.err;
}

TEST(Localize, OdometryAloneIsAFilterToo) {
  const TemporaryFolder folder;
  const auto run = runShell("sidestep-localize " + kLog + " --filter odometry --ground-truth " + kTruth + " -o '" +
                            (folder / "out").string() + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto m = metricsIn(folder / "out");
  EXPECT_NEAR(m["estimate"]["mean_error_m"].get<double>(), m["odometry"]["mean_error_m"].get<double>(), 0.01);
}

/// 500 particles against the EKF's 0.20 m and 2.5 deg; each seed is another run, and the same bytes again.
TEST(Localize, TheParticleFilterDoesAsWellOnTheDemoLog) {
  const TemporaryFolder folder;
  const auto tumOf = [&](const std::string& name, int seed) {
    const auto run =
        runShell(demoCommand(kLog, folder / name) + " --filter pf --no-picture --seed " + std::to_string(seed));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const auto m = metricsIn(folder / name);
    EXPECT_LE(m["estimate"]["mean_error_m"].get<double>(), 0.20) << seed;
    EXPECT_LE(m["estimate"]["heading_mean_error_deg"].get<double>(), 3) << seed;
    return readFile(folder / name / "trajectory.tum");
  };
  const auto first = tumOf("one", 1);
  EXPECT_NE(first, tumOf("two", 2));
  EXPECT_EQ(first, tumOf("again", 1));
}

/// Where MRPT's own filter ends on this log: (15.89, -10.0, 4.8 deg); from anywhere on the map.
TEST(Localize, ALaserInAMapFindsTheRobotFromAnywhere) {
  const TemporaryFolder folder;
  const auto run = runShell(
      "sidestep-localize /usr/share/mrpt/datasets/localization_demo.rawlog --filter mcl --no-picture --map "
      "/usr/share/mrpt/datasets/localization_demo.simplemap.gz --sensors odometry,laser -o '" +
      (folder / "out").string() + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto lines = linesOf(readFile(folder / "out" / "trajectory.tum"));
  double t, x, y, z, qx, qy, qz, qw;
  std::istringstream(lines.back()) >> t >> x >> y >> z >> qx >> qy >> qz >> qw;
  EXPECT_NEAR(x, 15.89, 0.3);
  EXPECT_NEAR(y, -10.0, 0.3);
  EXPECT_NEAR(2 * std::atan2(qz, qw), 4.8 * M_PI / 180, 0.07);
}

TEST(Localize, MclNeedsAMapAndOnlyItUsesALaser) {
  const auto without = runShell("sidestep-localize " + kLog + " --filter mcl");
  EXPECT_EQ(without.exit_code, 2);
  expectOneLine(without);
  EXPECT_NE(without.err.find("--map FILE"), std::string::npos) << without.err;
  const auto other = runShell("sidestep-localize " + kLog + " --filter ekf --sensors odometry,laser");
  EXPECT_EQ(other.exit_code, 2);
  expectOneLine(other);
  EXPECT_NE(other.err.find("--filter mcl"), std::string::npos) << other.err;
  const TemporaryFolder folder;
  const auto missing = runShell("sidestep-localize " + kLog + " --filter mcl --map /no/such/map.yaml -o '" +
                                (folder / "out").string() + "'");
  EXPECT_EQ(missing.exit_code, 3);
  expectOneLine(missing);
}

TEST(Localize, FromAndToCutTheLog) {
  const TemporaryFolder folder;
  const auto run = runShell(demoCommand(kLog, folder / "out") + " --from 100 --to 160 --no-picture");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_LE(metricsIn(folder / "out").at("duration_s").get<double>(), 60.5);
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "trajectory.png"));
}

}  // namespace
}  // namespace sidestep::testing
