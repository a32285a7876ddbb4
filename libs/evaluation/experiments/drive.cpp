// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/drive.h"

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/poses/CPose2D.h>

#include <algorithm>

#include "core/errors.h"
#include "datasets/log_reader.h"

namespace sidestep {
namespace {

constexpr double kEpoch_s = 1e9;  // simulated time 0; stamps must be > 0

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

/// Sums over the streams of a kind; `kind_of` names the kind of a label.
template <class KindOf>
void takeNis(const Localizer& localizer, const LocalizeConfig& config, const KindOf& kind_of, DriveResult& out) {
  out.gate_probability = config.gateProbability();
  for (const auto& s : localizer.sensors()) {
    if (s.nis_count == 0) continue;
    const std::string kind = kind_of(s.label);
    auto it = std::find_if(out.nis.begin(), out.nis.end(), [&](const auto& k) { return k.kind == kind; });
    if (it == out.nis.end()) it = out.nis.insert(it, {kind, 0, 0, 0, s.nis_dof});
    it->sum += s.nis_sum;
    it->count += static_cast<double>(s.nis_count);
    it->independent += s.nis_independent;
  }
}

bool isLost(const Reading& e, double time_s, const SignalLoss& loss) {
  if (!loss.any() || !loss.covers(time_s)) return false;
  if (e.kind == SensorKind::kImu) return loss.theta;
  return loss.xy && (e.kind == SensorKind::kGps || e.kind == SensorKind::kBeacons);
}

}  // namespace

mrpt::math::TPose2D truthInMap(const LocalizeConfig& config, const mrpt::math::TPose2D& truth) {
  if (!config.truth_frame_given) return truth;
  const mrpt::poses::CPose2D T_map_truth(config.truth_x_m, config.truth_y_m, config.truth_yaw);
  return (T_map_truth + mrpt::poses::CPose2D(truth)).asTPose();
}

DriveResult localizeSimulated(const LocalizationScenario& scenario, const LocalizeConfig& config,
                              const SignalLoss& loss, uint64_t world_seed, uint64_t filter_seed) {
  Localizer localizer(config.robot, makeFilter(config, filter_seed), config.expectation());
  if (config.smooth) localizer.smoothAtEnd();
  const int odometry = localizer.addStream("odometry"), imu = localizer.addStream("imu"),
            gps = localizer.addStream("gps");
  const bool use_imu = config.uses("imu"), use_heading = use_imu && config.robot.imu.heading != "off",
             use_rate = use_imu && config.robot.imu.yaw_rate != "off", use_gps = config.uses("gps");
  // EN of algorithm 3 is one number for all that is measured at an instant; to a Gaussian it is the same by parts.
  const bool as_one = config.filter == "pf" && config.pf.likelihood == "printed";
  DriveResult out;
  out.gave_fixes = use_gps;
  SimulatedPairs pairs(scenario.truth(), out);
  SensorStream stream = scenario.run(world_seed);
  mrpt::obs::CObservationOdometry reading;
  SensorStep step;
  while (stream.next(step)) {
    const double now = kEpoch_s + step.time_s;
    const bool lost = loss.any() && loss.covers(step.time_s);
    if (step.imu && use_rate && !(lost && loss.theta)) localizer.yawRate(imu, now, step.imu->yaw_rate);
    reading.odometry = mrpt::poses::CPose2D(step.odometry.pose);
    localizer.odometry(odometry, now, reading);
    const bool heading = step.imu && step.imu->has_yaw && use_heading && !(lost && loss.theta);
    const bool fix = step.gps && use_gps && !(lost && loss.xy);
    if (as_one && heading && fix && localizer.started()) {
      localizer.positionHeading(gps, now, step.gps->x, step.gps->y, step.imu->yaw);
    } else {
      if (heading) localizer.heading(imu, now, step.imu->yaw);
      if (fix) localizer.position(gps, now, step.gps->x, step.gps->y);
    }
    pairs.take(localizer);
  }
  localizer.finish();
  pairs.take(localizer);
  out.fixes = localizer.takeFixes();
  takeNis(
      localizer, config, [](const std::string& label) { return label; }, out);
  return out;
}

RecordedDrive readDrive(const std::string& log, const std::string& truth_file, const std::vector<std::string>& labels,
                        bool scans) {
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
    } else if (e->kind == SensorKind::kOdometry || e->kind == SensorKind::kImu || e->kind == SensorKind::kGps ||
               e->kind == SensorKind::kBeacons || (scans && e->kind == SensorKind::kLaser)) {
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
  Localizer localizer(config.robot, makeFilter(config, filter_seed), config.expectation());
  if (config.smooth) localizer.smoothAtEnd();
  LocalizationFeed feed(config, localizer);
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
          {e.time_s - drive.start_s, e.belief.mean, truthInMap(config, t->pose), e.belief.covariance, t->has_heading});
      out.odometry.push_back(e.odometry);
    }
  };
  for (const auto& e : drive.entries) {
    if (isLost(e, e.time_s - drive.start_s, loss)) continue;
    feed.feed(e);
    take();
  }
  localizer.finish();
  take();
  out.fixes = localizer.takeFixes();
  out.gave_fixes = config.uses("gps") && !out.fixes.empty();
  takeNis(
      localizer, config, [&](const std::string& label) { return word(feed.kinds().at(label)); }, out);
  return out;
}

}  // namespace sidestep
