// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/drive.h"

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/poses/CPose2D.h>

#include <algorithm>

#include "core/errors.h"
#include "datasets/kind_rules.h"
#include "datasets/log_reader.h"
#include "simulation/epoch.h"

namespace sidestep {
namespace {

/// Takes what is ready and lays it beside the truth, a pose an odometry reading.
class SimulatedPairs {
 public:
  SimulatedPairs(const std::vector<TruthSample>& truth, DriveResult& out) : truth_(truth), out_(out) {
    out_.pairs.reserve(truth.size());
    out_.odometry.reserve(truth.size());
  }
  void take(Localizer& localizer) {
    for (const auto& e : localizer.takeEstimates()) {
      if (!e.odometry_index || *e.odometry_index >= truth_.size()) continue;
      const auto& t = truth_[*e.odometry_index];
      out_.pairs.push_back({t.time_s, e.belief.mean, t.pose, e.belief.covariance, true});
      out_.odometry.push_back(e.odometry);
    }
  }

 private:
  const std::vector<TruthSample>& truth_;
  DriveResult& out_;
};

/// Sums over the streams of a kind.
void takeUse(Localizer& localizer, const LocalizeConfig& config, DriveResult& out) {
  out.gate_probability = config.gateProbability();
  out.sensors = localizer.sensors();
  out.fixes = localizer.takeFixes();
  for (const auto& s : out.sensors) {
    if (s.nis_count == 0) continue;
    const std::string kind = word(s.kind);
    auto it = std::find_if(out.nis.begin(), out.nis.end(), [&](const auto& k) { return k.kind == kind; });
    if (it == out.nis.end()) it = out.nis.insert(it, {kind, 0, 0, 0, s.nis_dof});
    it->sum += s.nis_sum;
    it->count += static_cast<double>(s.nis_count);
    it->independent += s.nis_independent;
  }
}

/// A step of a simulated drive as readings. Their observations are used in turn: the localizer holds those of the step
/// before.
class SimulatedReadings {
 public:
  SimulatedReadings() {
    for (size_t i = 0; i < 2; ++i) {
      wheels_[i] = {0, SensorKind::kOdometry, "odometry", std::make_shared<mrpt::obs::CObservationOdometry>()};
      imu_[i] = {0, SensorKind::kImu, "imu", std::make_shared<mrpt::obs::CObservationIMU>()};
      fix_[i] = {0, SensorKind::kGps, "gps", std::make_shared<mrpt::obs::CObservationRobotPose>()};
    }
  }
  void observe(const SensorStep& step, const SignalLoss& loss, Localizer& localizer) {
    const bool lost = loss.any() && loss.covers(step.time_s);
    turn_ = 1 - turn_;
    if (step.imu && !(lost && loss.theta)) localizer.observe(imu(step));
    localizer.observe(wheels(step));
    if (step.gps && !(lost && loss.xy)) localizer.observe(fix(step));
  }

 private:
  template <class Observation>
  static Observation& at(Reading& reading, double time_s) {
    reading.time_s = kSimulationStart_s + time_s;
    return static_cast<Observation&>(*reading.observation);
  }
  const Reading& imu(const SensorStep& step) {
    auto& o = at<mrpt::obs::CObservationIMU>(imu_[turn_], step.time_s);
    o.dataIsPresent.fill(false);
    if (step.imu->has_yaw) o.set(mrpt::obs::IMU_YAW, step.imu->yaw);
    o.set(mrpt::obs::IMU_WZ, step.imu->yaw_rate);
    return imu_[turn_];
  }
  const Reading& wheels(const SensorStep& step) {
    at<mrpt::obs::CObservationOdometry>(wheels_[turn_], step.time_s).odometry =
        mrpt::poses::CPose2D(step.odometry.pose);
    return wheels_[turn_];
  }
  const Reading& fix(const SensorStep& step) {
    at<mrpt::obs::CObservationRobotPose>(fix_[turn_], step.time_s)
        .pose.mean.setFromValues(step.gps->x, step.gps->y, 0, 0, 0, 0);
    return fix_[turn_];
  }

  Reading wheels_[2], imu_[2], fix_[2];
  size_t turn_ = 0;
};

bool isLost(const Reading& e, double time_s, const SignalLoss& loss) {
  if (!loss.any() || !loss.covers(time_s)) return false;
  if (e.kind == SensorKind::kImu) return loss.theta;
  return loss.xy && (e.kind == SensorKind::kGps || e.kind == SensorKind::kBeacons);
}

}  // namespace

DriveResult localizeSimulated(const LocalizationScenario& scenario, const LocalizeConfig& config,
                              const SignalLoss& loss, uint64_t world_seed, uint64_t filter_seed) {
  Localizer localizer = makeLocalizer(config, filter_seed);
  DriveResult out;
  SimulatedPairs pairs(scenario.truth(), out);
  SensorStream stream = scenario.run(world_seed);
  SimulatedReadings readings;
  SensorStep step;
  while (stream.next(step)) {
    readings.observe(step, loss, localizer);
    pairs.take(localizer);
  }
  localizer.finish();
  pairs.take(localizer);
  takeUse(localizer, config, out);
  return out;
}

std::vector<SensorKind> kindsUsedBy(const std::vector<LocalizeConfig>& configs) {
  std::vector<SensorKind> out;
  for (const auto& config : configs)
    for (const auto kind : config.usedKinds())
      if (std::find(out.begin(), out.end(), kind) == out.end()) out.push_back(kind);
  return out;
}

RecordedDrive readDrive(const std::string& log, const std::string& truth_file, const std::vector<std::string>& labels,
                        const std::vector<SensorKind>& keeps) {
  RecordedDrive drive;
  drive.file = log;
  LogReaderOptions options;
  options.labels = labelMap(labels);
  LogReader reader(log, options);
  double last_s = 0;
  while (auto e = reader.next()) {
    if (drive.start_s == 0) drive.start_s = e->time_s;
    last_s = e->time_s;
    if (e->kind == SensorKind::kGroundTruth && truth_file.empty()) {
      if (const auto* p = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(e->observation.get()))
        drive.truth.push_back({e->time_s, {p->pose.mean.x(), p->pose.mean.y(), p->pose.mean.yaw()}, true});
    } else if (std::find(keeps.begin(), keeps.end(), e->kind) != keeps.end()) {
      drive.entries.push_back(std::move(*e));
    }
  }
  if (reader.end().damaged) throw DatasetError::corrupt(log + ": " + reader.end().message);
  drive.duration_s = last_s - drive.start_s;
  if (!truth_file.empty()) {
    // Rows of a file are asked for at the log's own times: it is read anew by each run's thread, so kept as poses here.
    const auto truth = GroundTruth::fromFile(truth_file);
    uint64_t row = 0;
    for (const auto& e : drive.entries) {
      if (e.kind != SensorKind::kOdometry) continue;
      auto pose = truth->isRowIndexed() ? truth->row(row++) : truth->at(e.time_s);
      if (!pose) continue;
      pose->time_s = e.time_s;
      drive.truth.push_back(*pose);
    }
  }
  if (drive.truth.empty()) throw DatasetError::missing(log + ": no ground truth to compare with");
  return drive;
}

DriveResult localizeRecorded(const RecordedDrive& drive, const LocalizeConfig& config, const SignalLoss& loss,
                             uint64_t filter_seed) {
  Localizer localizer = makeLocalizer(config, filter_seed);
  GroundTruth truth;
  auto next_truth = drive.truth.begin();
  DriveResult out;
  const auto take = [&] {
    for (const auto& e : localizer.takeEstimates()) {
      while (next_truth != drive.truth.end() &&
             (next_truth == drive.truth.begin() || next_truth[-1].time_s <= e.time_s))
        truth.push(*next_truth++);
      const auto t = truth.at(e.time_s);
      if (!t) continue;
      out.pairs.push_back(
          {e.time_s - drive.start_s, e.belief.mean, config.truthInMap(t->pose), e.belief.covariance, t->has_heading});
      out.odometry.push_back(e.odometry);
    }
  };
  for (const auto& e : drive.entries) {
    if (isLost(e, e.time_s - drive.start_s, loss)) continue;
    localizer.observe(e);
    take();
  }
  localizer.finish();
  take();
  takeUse(localizer, config, out);
  requireSensors(config, out.sensors, drive.file);
  return out;
}

}  // namespace sidestep
