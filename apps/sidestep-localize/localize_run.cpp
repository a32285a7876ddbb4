// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-localize/localize_run.h"

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>

#include "common/program.h"
#include "datasets/kind_rules.h"
#include "datasets/log_reader.h"
#include "evaluation/metrics/alignment.h"
#include "evaluation/metrics/metrics_json.h"
#include "evaluation/metrics/side_files.h"
#include "evaluation/metrics/truth_comparison.h"
#include "sidestep-localize/ordered_log.h"

namespace sidestep {
namespace {

constexpr uint64_t kEnoughToJudge = 30;  // measurements of a sensor, for a word on its noise
constexpr double kModesPeriod_s = 1;     // between two looks at where else the robot may be

double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

mrpt::obs::CObservationRobotPose asObservation(const Estimate& e) {
  mrpt::obs::CObservationRobotPose o;
  o.sensorLabel = "estimate";
  o.timestamp = mrpt::Clock::fromDouble(e.time_s);
  o.pose.mean.setFromValues(e.belief.mean.x, e.belief.mean.y, 0, e.belief.mean.phi, 0, 0);
  o.pose.cov.setZero();
  const auto& P = e.belief.covariance;
  const int at[3] = {0, 1, 3};  // x, y, yaw of (x, y, z, yaw, pitch, roll)
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) o.pose.cov(at[i], at[j]) = P(i, j);
  return o;
}

/// The ellipses of the picture, some 20 to 40 along whatever length.
class Ellipses {
 public:
  void add(const Estimate& e) {
    if (seen_++ % stride_ != 0) return;
    kept_.push_back({e.belief.mean, e.belief.covariance.topLeftCorner<2, 2>()});
    if (kept_.size() < 40) return;
    for (size_t i = 0; 2 * i < kept_.size(); ++i) kept_[i] = kept_[2 * i];
    kept_.resize(20);
    stride_ *= 2;
  }
  const std::vector<TrajectoryFigure::Ellipse>& kept() const { return kept_; }

 private:
  std::vector<TrajectoryFigure::Ellipse> kept_;
  size_t seen_ = 0, stride_ = 1;
};

/// One run: the log in, the estimates out.
class Run {
 public:
  Run(const LocalizeOptions& options, const LocalizeConfig& config)
      : options_(options),
        config_(config),
        folder_(options.output, options.overwrite),
        reader_(options.log, readerOptions(options, config)),
        localizer_(makeLocalizer(config, static_cast<uint64_t>(config.seed))),
        truth_(options.ground_truth, config),
        log_(folder_.file("estimate.rawlog"), commandLine()),
        tum_(folder_.file("trajectory.tum")) {
    localizer_.recordMore(kModesPeriod_s);
  }

  ExitCode go();

 private:
  static LogReaderOptions readerOptions(const LocalizeOptions& o, const LocalizeConfig&) {
    LogReaderOptions r;
    r.labels = labelMap(o.labels);
    r.from_s = o.from_s;
    r.to_s = o.to_s;
    return r;
  }
  void read(LogReader& reader, const char* what, const std::function<void(const Reading&)>& handle);
  void filter();
  void smooth();
  void record(const Reading& e);
  void take();
  void tell(const Estimate& e);
  LocalizationMetrics metrics() const;
  void draw(const LocalizationMetrics& m) const;
  void checkSensors();
  void warn(const std::string& line);

  const LocalizeOptions& options_;
  const LocalizeConfig& config_;
  OutputFolder folder_;
  LogReader reader_;
  Localizer localizer_;
  TruthComparison truth_;
  OrderedLog log_;
  TumWriter tum_;
  TrajectoryFigure figure_;
  Ellipses ellipses_;
  LostFile lost_{folder_.file("lost.csv")};
  ModesFile modes_{folder_.file("modes.csv")};
  InnovationLog innovations_;
  std::vector<std::string> warnings_;
  double begin_s_ = steadySeconds(), first_s_ = 0, last_s_ = 0;
  uint64_t estimates_ = 0;
};

void Run::warn(const std::string& line) {
  warnings_.push_back(line);
  std::fprintf(stderr, "sidestep-localize: %s\n", line.c_str());
}

void Run::record(const Reading& e) {
  if (first_s_ == 0) first_s_ = e.time_s;
  last_s_ = e.time_s;
  if (e.kind == SensorKind::kEstimate) return;  // a log of ours, localized again: the new estimate replaces the old
  log_.input(e.time_s, *e.observation);
  if (e.kind != SensorKind::kGroundTruth) return;
  if (const auto* p = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(e.observation.get()))
    truth_.push(e.time_s, {p->pose.mean.x(), p->pose.mean.y(), p->pose.mean.yaw()});
}

void Run::tell(const Estimate& e) {
  log_.estimate(e.time_s, asObservation(e));
  tum_.write(e.time_s, e.belief.mean);
  figure_.estimate.add(e.belief.mean.x, e.belief.mean.y);
  figure_.odometry.add(e.odometry.x, e.odometry.y);
  ellipses_.add(e);
  lost_.write(e);
  modes_.write(e);
  truth_.add(e);
  ++estimates_;
}

void Run::take() {
  for (const auto& e : localizer_.takeEstimates()) tell(e);
  for (const auto& p : localizer_.takeFixes()) figure_.fixes.add(p.x, p.y);
  innovations_.take(localizer_);
}

void Run::read(LogReader& reader, const char* what, const std::function<void(const Reading&)>& handle) {
  ProgressBar bar(what, options_.quiet);
  uint64_t count = 0;
  while (!interrupted()) {
    const auto entry = reader.next();
    if (!entry) break;
    handle(*entry);
    if (++count % 256 == 0)
      bar.update(static_cast<double>(reader.bytesConsumed()) / std::max(1.0, static_cast<double>(reader.fileSize())));
  }
}

/// Estimates go out as they come.
void Run::filter() {
  read(reader_, "localizing", [this](const Reading& e) {
    record(e);
    localizer_.observe(e);
    take();
  });
  localizer_.finish();
  take();
}

/// The log is read twice: once for the estimates, which wait for its end, once to write it with them.
void Run::smooth() {
  read(reader_, "localizing", [this](const Reading& e) {
    localizer_.observe(e);
    innovations_.take(localizer_);
  });
  localizer_.finish();
  const auto estimates = localizer_.takeEstimates();
  for (const auto& p : localizer_.takeFixes()) figure_.fixes.add(p.x, p.y);
  auto next = estimates.begin();
  LogReader again(options_.log, readerOptions(options_, config_));
  read(again, "writing", [&](const Reading& e) {
    for (; next != estimates.end() && next->time_s < e.time_s; ++next) tell(*next);
    record(e);
  });
  if (!interrupted())
    for (; next != estimates.end(); ++next) tell(*next);
}

LocalizationMetrics Run::metrics() const {
  LocalizationMetrics m;
  m.duration_s = last_s_ - first_s_;
  m.wall_s = steadySeconds() - begin_s_;
  m.peak_memory_mb = peakMemoryMb();
  m.estimate = truth_.estimateErrors(alignmentFor(config_, localizer_.sensors()));
  m.odometry = truth_.odometryErrors();
  m.truth_source = options_.ground_truth.empty() ? (m.estimate ? "log" : "none") : options_.ground_truth;
  for (const auto& s : localizer_.sensors()) {
    auto& out = m.sensors[s.label];
    out.read = s.read;
    out.used = s.used;
    out.refused = s.refused;
    out.nis_dof = s.nis_dof;
    if (s.nis_count > 0) out.mean_nis = s.nis_sum / static_cast<double>(s.nis_count);
    out.nis_independent = s.nis_independent;
    if (s.nis_count >= kEnoughToJudge && config_.gateProbability())
      out.consistency = judgeSensor(*out.mean_nis, static_cast<double>(s.nis_count), s.nis_independent, s.nis_dof,
                                    *config_.gateProbability());
  }
  for (const auto& [label, reasons] : reader_.refused())
    for (const auto& [reason, n] : reasons) {
      m.sensors[label].refused[reason] += n;
      m.sensors[label].read += n;
    }
  modes_.into(m);
  m.partial = reader_.end().damaged || interrupted();
  m.warnings = warnings_;
  return m;
}

void Run::draw(const LocalizationMetrics& m) const {
  if (options_.no_picture) return;
  TrajectoryFigure figure = figure_;
  figure.title = options_.log.substr(options_.log.find_last_of('/') + 1) + ": " + config_.filter;
  if (m.estimate) figure.truth = truth_.truthLine(*m.estimate);
  figure.ellipses = ellipses_.kept();
  drawTrajectory(figure, folder_.file("trajectory.png"));
  if (!config_.gateProbability()) return;
  auto consistency = innovations_.figure(m, *config_.gateProbability());
  consistency.title = figure.title;
  consistency.start_s = first_s_;
  drawConsistency(consistency, folder_.file("consistency.png"));
}

void Run::checkSensors() {
  if (estimates_ == 0)
    throw DatasetError::missing(options_.log + ": no odometry to localize with (used: " +
                                usedLabels(localizer_.sensors()) + "); see sidestep-rawlog info, and --label");
  requireSensors(config_, localizer_.sensors(), options_.log);
}

ExitCode Run::go() {
  folder_.writeConfiguration(fieldsOf(config_));
  config_.smooth ? smooth() : filter();
  truth_.finish();
  log_.close();
  tum_.close();
  if (reader_.end().damaged) warn(reader_.end().message);
  auto m = metrics();
  if (estimates_ > 0) draw(m);
  m.wall_s = steadySeconds() - begin_s_;
  writeMetrics(m, folder_.file("metrics.json"));
  if (interrupted()) return ExitCode::kInterrupted;
  if (!reader_.end().damaged || estimates_ > 0) checkSensors();
  std::fputs(errorTable(m).c_str(), stdout);
  return reader_.end().damaged ? ExitCode::kInputCorrupt : ExitCode::kDone;
}

}  // namespace

ExitCode localize(const LocalizeOptions& options) {
  const LocalizeConfig config = effectiveConfig(options);
  if (options.write_config) {
    std::fputs(writeYaml(fieldsOf(config)).c_str(), stdout);
    return ExitCode::kDone;
  }
  if (options.log.empty()) throw ConfigError("no LOG given; for example sidestep-localize run.rawlog -o out");
  return Run(options, config).go();
}

}  // namespace sidestep
