// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// What may be changed about a log without changing where the robot was: doc/stability.md, a line a test.
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <map>
#include <sstream>

#include "core/random.h"
#include "datasets/log_writer.h"
#include "support/readings.h"
#include "support/run_program.h"

namespace sidestep::testing {
namespace {

using mrpt::math::TPose2D;
using ObservationPtr = std::shared_ptr<mrpt::obs::CObservation>;

/// How a drive is laid into its frame, and what is done to its sensors.
struct Variant {
  TPose2D moved;               ///< the whole world, turned and then shifted
  bool mirrored = false;       ///< left and right change places
  std::string late_sensor;     ///< whose stamps are `late_s` later
  double late_s = 0;           ///< [s]
  double fixes_until_s = 1e9;  ///< no fixes afterwards
  bool straight = false;       ///< encoders without noise on a straight line, a gyro that says 0
};

TPose2D placed(const Variant& v, TPose2D p) {
  if (v.mirrored) p = {p.x, -p.y, -p.phi};
  const double c = std::cos(v.moved.phi), s = std::sin(v.moved.phi);
  return {v.moved.x + c * p.x - s * p.y, v.moved.y + s * p.x + c * p.y, p.phi + v.moved.phi};
}

/// The robot's true pose: an S that turns both ways at 1 m/s, by small steps of its own arcs.
std::vector<TPose2D> truth(bool straight, double dt_s, int steps) {
  std::vector<TPose2D> out{{0, 0, 0.3}};
  for (int i = 1; i < steps; ++i) {
    TPose2D p = out.back();
    const double w = straight ? 0 : 0.4 * std::sin(0.15 * dt_s * i);
    p.phi += w * dt_s / 2;
    p.x += dt_s * std::cos(p.phi);
    p.y += dt_s * std::sin(p.phi);
    p.phi += w * dt_s / 2;
    out.push_back(p);
  }
  return out;
}

/// A simulated log: odometry at 20 Hz whose wheels err by 1 % of each step, an IMU at 50 Hz, fixes at 5 Hz with 0.5 m.
class Drive {
 public:
  explicit Drive(const Variant& variant, int steps = 1200) : variant_(variant) {
    const auto poses = truth(variant.straight, kStep_s, steps);
    TPose2D wheels;
    for (int i = 0; i < steps; ++i) {
      if (i > 0) wheels = onwards(wheels, poses[i - 1], poses[i]);
      add("odometry", i, odometry(wheels));
      add("imu", i, imu(poses[i], i > 0 ? (poses[i].phi - poses[i - 1].phi) / kStep_s : 0));
      if (i % 4 == 0 && kStep_s * i <= variant.fixes_until_s) add("gps", i, fix(poses[i]));
    }
  }

  std::vector<ObservationPtr> observations;
  static constexpr double kStep_s = 0.05;

 private:
  double side() const { return variant_.mirrored ? -1 : 1; }

  TPose2D onwards(const TPose2D& wheels, const TPose2D& from, const TPose2D& to) {
    const double scale = variant_.straight ? 1 : 1 + 0.01 * random_.gaussian();
    const double turn = (to.phi - from.phi) + (variant_.straight ? 0 : 0.002 * random_.gaussian());
    const double way = scale * std::hypot(to.x - from.x, to.y - from.y), at = wheels.phi + side() * turn / 2;
    return {wheels.x + way * std::cos(at), wheels.y + way * std::sin(at), wheels.phi + side() * turn};
  }
  ObservationPtr odometry(const TPose2D& wheels) const {
    return std::make_shared<mrpt::obs::CObservationOdometry>(support::odometryAt(0, wheels));
  }
  ObservationPtr imu(const TPose2D& pose, double rate) {
    using namespace mrpt::obs;
    const double yaw = placed(variant_, pose).phi + side() * (variant_.straight ? 0 : 0.02 * random_.gaussian());
    const double turn = variant_.straight ? 0 : side() * (rate + 0.002 * random_.gaussian());
    auto values = std::vector<std::pair<TIMUDataIndex, double>>{{IMU_WZ, turn}};
    if (!variant_.straight) values.emplace_back(IMU_YAW, yaw);
    return std::make_shared<CObservationIMU>(support::imuWith(values));
  }
  /// A metric fix: a pose observation that serves as GPS.
  ObservationPtr fix(const TPose2D& pose) {
    const TPose2D at = placed(variant_, {pose.x + 0.5 * random_.gaussian(), pose.y + 0.5 * random_.gaussian(), 0});
    auto o = std::make_shared<mrpt::obs::CObservationRobotPose>();
    o->pose.mean.setFromValues(at.x, at.y, 0, 0, 0, 0);
    for (int i = 0; i < 6; ++i) o->pose.cov(i, i) = 0.25;
    return o;
  }
  void add(const std::string& label, int step, const ObservationPtr& o) {
    const double late_s = label == variant_.late_sensor ? variant_.late_s : 0;
    o->sensorLabel = label;
    o->timestamp = mrpt::Clock::fromDouble(support::kStart_s + kStep_s * step + late_s);
    observations.push_back(o);
  }

  Variant variant_;
  Random random_{7};
};

struct Row {
  double time_s = 0;
  TPose2D pose;
};

std::vector<Row> rowsOf(const std::string& tum) {
  std::vector<Row> out;
  for (const auto& line : linesOf(tum)) {
    std::istringstream in(line);
    double t = 0, x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 1;
    if (in >> t >> x >> y >> z >> qx >> qy >> qz >> qw) out.push_back({t, {x, y, 2 * std::atan2(qz, qw)}});
  }
  return out;
}

/// trajectory.tum of `sidestep-localize` on these observations, in their order.
std::string localized(const std::vector<ObservationPtr>& observations, const std::string& options) {
  const TemporaryFolder folder;
  const std::string log = (folder / "log.rawlog").string();
  LogWriter writer(log, "program: test\n", LogWriter::Flush::kBySize);
  for (const auto& o : observations) writer.write(*o);
  writer.close();
  const auto run = runShell("sidestep-localize '" + log + "' --label gps=gps --align none --no-picture -q -o '" +
                            (folder / "out").string() + "' " + options);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return readFile(folder / "out" / "trajectory.tum");
}

/// Largest distance [m] between the poses of `a`, placed as `v` says, and those of `b` at the same times. One of them
/// may begin or end a reading later.
double farthest(const std::vector<Row>& a, const std::vector<Row>& b, const Variant& v = {}) {
  EXPECT_GT(a.size(), 1000u);
  double out = 0;
  size_t pairs = 0;
  for (size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double apart_s = a[i].time_s - b[j].time_s;
    if (std::abs(apart_s) > 1e-5) {
      apart_s < 0 ? ++i : ++j;
      continue;
    }
    const TPose2D p = placed(v, a[i++].pose);
    out = std::max(out, std::hypot(p.x - b[j].pose.x, p.y - b[j].pose.y));
    ++j, ++pairs;
  }
  EXPECT_GE(pairs + 2, std::max(a.size(), b.size()));
  return out;
}

/// The numbers of doc/stability.md.
void tell(const std::string& what, double number) {
  std::printf("stability: %s: %.3g\n", what.c_str(), number);
  ::testing::Test::RecordProperty(what, std::to_string(number));
}

class Stability : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Filters, Stability, ::testing::Values("--filter ekf", "--filter ekf --smooth"),
                         [](const auto& which) { return which.index == 0 ? "Ekf" : "EkfSmoothed"; });

TEST_P(Stability, AMicrosecondOnAllStampsOfASensorMovesNoPoseByAMillimetre) {
  const auto before = rowsOf(localized(Drive({}).observations, GetParam()));
  for (const char* sensor : {"odometry", "imu", "gps"})
    for (const double late_s : {1e-6, -1e-6}) {
      Variant v;
      v.late_sensor = sensor;
      v.late_s = late_s;
      const double moved_m = farthest(before, rowsOf(localized(Drive(v).observations, GetParam())));
      tell(std::string(GetParam()) + ", " + sensor + (late_s > 0 ? " +" : " -") + "1 us [m]", moved_m);
      EXPECT_LE(moved_m, 1e-3) << sensor << " " << late_s;
    }
}

TEST_P(Stability, TheOrderOfEqualStampsDoesNotMatter) {
  const auto observations = Drive({}).observations;
  auto reversed = observations;
  std::stable_sort(reversed.begin(), reversed.end(), [](const auto& a, const auto& b) {
    if (a->timestamp != b->timestamp) return a->timestamp < b->timestamp;
    return a->sensorLabel < b->sensorLabel;  // gps, imu, odometry instead of odometry, imu, gps
  });
  const double moved_m = farthest(rowsOf(localized(observations, GetParam())), rowsOf(localized(reversed, GetParam())));
  tell(std::string(GetParam()) + ", equal stamps reversed [m]", moved_m);
  EXPECT_LE(moved_m, 1e-6);
}

/// Each stamp once: IMU and fixes a little after the wheels.
std::vector<ObservationPtr> withStampsOfTheirOwn(std::vector<ObservationPtr> observations) {
  const std::map<std::string, double> after_s = {{"odometry", 0}, {"imu", 0.003}, {"gps", 0.007}};
  for (auto& o : observations)
    o->timestamp = mrpt::Clock::fromDouble(mrpt::Clock::toDouble(o->timestamp) + after_s.at(o->sensorLabel));
  return observations;
}

TEST_P(Stability, ShuffledArrivalWithinTheLateWindowGivesTheSameBytes) {
  const auto observations = withStampsOfTheirOwn(Drive({}).observations);
  auto shuffled = observations;
  Random random(3);
  constexpr size_t kSpan = 30;  // half a second of entries; the late window is 2 s
  for (size_t from = 0; from + kSpan <= shuffled.size(); from += kSpan)
    for (size_t i = kSpan - 1; i > 0; --i) std::swap(shuffled[from + i], shuffled[from + random.below(i + 1)]);
  ASSERT_NE(observations, shuffled);
  EXPECT_EQ(localized(observations, GetParam()), localized(shuffled, GetParam()));
}

TEST_P(Stability, AMirroredLogGivesMirroredPoses) {
  Variant v;
  v.mirrored = true;
  const double off_m = farthest(rowsOf(localized(Drive({}).observations, GetParam())),
                                rowsOf(localized(Drive(v).observations, GetParam())), v);
  tell(std::string(GetParam()) + ", mirrored [m]", off_m);
  EXPECT_LE(off_m, 1e-6);
}

TEST_P(Stability, ALogMovedBy100KilometresAndTurnedGivesPosesMovedAndTurned) {
  Variant v;
  v.moved = {8e4, -6e4, 1.1};
  const double off_m = farthest(rowsOf(localized(Drive({}).observations, GetParam())),
                                rowsOf(localized(Drive(v).observations, GetParam())), v);
  tell(std::string(GetParam()) + ", moved by 100 km and turned by 63 deg [m]", off_m);
  EXPECT_LE(off_m, 1e-3);
}

TEST(StabilityOfCoasting, PerfectEncodersAndAStillGyroStayOnTheirLineFor120SecondsWithoutFixes) {
  Variant v;
  v.straight = true;
  v.fixes_until_s = 60;
  const auto rows = rowsOf(localized(Drive(v, 3600).observations, "--filter ekf"));
  ASSERT_GT(rows.size(), 3500u);
  const auto at = [&](double t_s) {
    return *std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.time_s >= support::kStart_s + t_s; });
  };
  const Row from = at(60.5), to = rows.back();
  const double dx = to.pose.x - from.pose.x, dy = to.pose.y - from.pose.y;
  const double ahead = dx * std::cos(from.pose.phi) + dy * std::sin(from.pose.phi);
  const double sideways_m = std::abs(-dx * std::sin(from.pose.phi) + dy * std::cos(from.pose.phi));
  const double way_m = to.time_s - from.time_s;  // at 1 m/s
  tell("sideways after 120 s without fixes [m]", sideways_m);
  tell("way without fixes, share wrong", std::abs(ahead / way_m - 1));
  EXPECT_LE(sideways_m, 1);
  EXPECT_NEAR(ahead, way_m, 0.001 * way_m);
}

TEST(StabilityOfStudies, OneOrManyThreadsGiveTheSameBytes) {
  const TemporaryFolder folder;
  const std::string study = "sidestep-evaluate share/studies/table-3.1-3.2.yaml --runs 3 -q -o '";
  for (const char* jobs : {"1", "2", "5"}) {
    const auto out = folder / jobs;
    const auto run = runShell(study + out.string() + "' -j " + jobs);
    ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 6) << run.err;  // 6: so few runs miss the study's means
    for (const char* file : {"runs.csv", "summary.csv"}) {
      EXPECT_EQ(readFile(out / file), readFile(folder / "1" / file)) << jobs << " threads, " << file;
      EXPECT_NE(readFile(out / file), "") << file;
    }
  }
}

}  // namespace
}  // namespace sidestep::testing
