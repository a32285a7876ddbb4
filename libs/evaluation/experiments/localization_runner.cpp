// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/localization_runner.h"

#include <filesystem>
#include <map>
#include <mutex>
#include <tuple>

#include "core/data_path.h"
#include "core/errors.h"
#include "core/overlay_yaml.h"
#include "evaluation/experiments/drive.h"
#include "evaluation/metrics/drive_metrics.h"
#include "evaluation/study/study.h"
#include "figures/trajectory_figure.h"

namespace sidestep {
namespace {

/// An interruption of signals, at a time that is given or drawn by the run's seed.
struct Interruption {
  std::string loses = "none";
  bool drawn = true;
  double from_s = 0, length_s = 0;
  double settle_s = 20, recover_s = 30;

  void visit(ParamVisitor& v) {
    v.choice("loses", loses, {"none", "theta", "xy", "all"},
             "what is lost: the IMU, the position fixes, both; odometry stays");
    v.flag("drawn", drawn, "the run's seed says when");
    v.number("from_s", from_s, {0, 1e6}, "s", "else it begins here, after the start of the drive");
    v.number("length_s", length_s, {0, 1e6}, "s", "how long; the axis outage_s varies it");
    v.number("settle_s", settle_s, {0, 1e6}, "s", "no loss before this, and errors before it do not count as ordinary");
    v.number("recover_s", recover_s, {0, 1e6}, "s", "left after the loss when its time is drawn");
  }
};

struct ScenarioEntry {
  std::string file, set, log, ground_truth, robot, config;
  std::vector<std::string> labels;
  Interruption interruption;
  // made by prepare()
  std::shared_ptr<const LocalizationScenario> simulated;
  std::shared_ptr<const RecordedDrive> recorded;
  std::vector<LocalizeConfig> configs;  ///< by algorithm

  double duration() const {
    return simulated ? simulated->params().trajectory.duration_s : recorded ? recorded->duration_s : 0;
  }
};

class LocalizationRunner final : public StudyRunner {
 public:
  explicit LocalizationRunner(std::string study_file) : file_(std::move(study_file)) {}

  void visitScenario(size_t index, ParamVisitor& v) override {
    if (scenarios_.size() <= index) scenarios_.resize(index + 1);
    auto& s = scenarios_[index];
    v.text("file", s.file, "simulated drive, a YAML of sidestep-simulate; relative to the study's folder");
    v.overlay("set", s.set, "what is changed in that drive");
    v.text("log", s.log, "real drive, a rawlog; may hold ${SIDESTEP_DATA}");
    v.texts("labels", s.labels, "which of its labels serves as a kind of sensor, kind=label");
    v.text("ground_truth", s.ground_truth, "file of true poses; empty: the log's own");
    v.text("robot", s.robot, "the robot, a YAML of sidestep-localize");
    v.overlay("config", s.config, "what is changed in that");
    v.section("outage", "an interruption of signals", [&](ParamVisitor& w) { s.interruption.visit(w); });
  }
  void visitAlgorithm(size_t index, ParamVisitor& v) override {
    if (algorithms_.size() <= index) algorithms_.resize(index + 1);
    v.overlay("set", algorithms_[index], "what the algorithm changes in each scenario's configuration");
  }
  std::vector<std::string> axes() const override { return {"outage_s"}; }
  const std::vector<MetricInfo>& metrics() const override {
    static const auto infos = infosOf(driveMetrics());
    return infos;
  }

  void prepare(const std::vector<std::string>& scenarios, const std::vector<std::string>& axes,
               const std::vector<std::string>& algorithms, bool load_data) override;
  std::vector<double> run(const StudyPlace& place) const override;
  bool draw(const StudyPlace& place, const std::string& title, const std::string& png_file) const override;

 private:
  void loadLog(ScenarioEntry& s, const std::string& where) const;
  void loadScenario(ScenarioEntry& s, const std::string& where) const;
  LocalizeConfig baseConfig(const ScenarioEntry& s) const;
  DriveResult localize(const StudyPlace& place, const SignalLoss& loss) const;
  SignalLoss lossOf(const StudyPlace& place) const;

  std::shared_ptr<const DriveErrors> twinOf(const StudyPlace& place) const;

  using TwinKey = std::tuple<uint64_t, uint64_t, uint64_t, size_t>;
  mutable std::mutex twins_mutex_;
  mutable std::map<TwinKey, std::shared_ptr<const DriveErrors>> twins_;
  std::string file_;
  std::vector<ScenarioEntry> scenarios_;
  std::vector<std::string> algorithms_;
};

/// Of what the log holds, what any algorithm uses.
void LocalizationRunner::loadLog(ScenarioEntry& s, const std::string& where) const {
  const auto log = resolvedPath(s.log, file_);
  if (!std::filesystem::exists(log))
    throw DatasetError::missing(where + ".log: " + log +
                                " is not there; get the data, or leave the scenario out with --scenarios");
  s.recorded = std::make_shared<const RecordedDrive>(readDrive(
      log, s.ground_truth.empty() ? "" : resolvedPath(s.ground_truth, file_), s.labels, kindsUsedBy(s.configs)));
}

void LocalizationRunner::loadScenario(ScenarioEntry& s, const std::string& where) const {
  if (!s.log.empty() && !(s.file.empty() && isBlank(s.set)))
    throw ConfigError(where + ": is either simulated (file, set) or recorded (log)");
  if (!s.log.empty()) return;
  LocalizationScenarioParams params;
  std::string kind = "localization";
  int seed = 1;  // of the file; a study has its own
  const Visit fields = [&](ParamVisitor& v) {
    v.choice("kind", kind, {"localization"}, "what the scenario is about");
    v.integer("seed", seed, {0, 2e9}, "not used in a study");
    params.visit(v);
  };
  if (!s.file.empty()) readYaml(resolvedPath(s.file, file_), fields);
  readYamlText(s.set, file_, fields);
  if (s.interruption.loses == "none" && params.roof.loses != "none") {
    // The drive's own roof is taken as the interruption, so that the twin without it can be run.
    s.interruption.loses = params.roof.loses;
    s.interruption.drawn = false;
    s.interruption.from_s = params.roof.from_s;
    s.interruption.length_s = params.roof.to_s - params.roof.from_s;
    params.roof.loses = "none";
  }
  s.simulated = std::make_shared<const LocalizationScenario>(params);
  s.file.clear();  // from here on all of it stands in `set`
  s.set = plainYaml(fields);
}

/// The robot's file, then the scenario's changes; a simulated robot knows where it starts.
LocalizeConfig LocalizationRunner::baseConfig(const ScenarioEntry& s) const {
  LocalizeConfig config;
  if (s.simulated) {
    const auto& t = s.simulated->params().trajectory;
    auto& start = config.robot.start;
    start.pose_given = true;
    start.x_m = t.x_m;
    start.y_m = t.y_m;
    start.yaw = t.yaw;
    config.align = "none";
  }
  const Visit fields = [&](ParamVisitor& v) { config.visit(v); };
  if (!s.robot.empty()) readYaml(resolvedPath(s.robot, file_), fields);
  readYamlText(s.config, file_, fields);
  return config;
}

void LocalizationRunner::prepare(const std::vector<std::string>& scenarios, const std::vector<std::string>& axes,
                                 const std::vector<std::string>& algorithms, bool load_data) {
  for (size_t i = 0; i < scenarios_.size(); ++i) {
    auto& s = scenarios_[i];
    if (scenarios[i].empty()) continue;  // left out
    const std::string where = file_ + ": scenarios." + scenarios[i];
    loadScenario(s, where);
    if (!axes[i].empty() && s.interruption.loses == "none")
      throw ConfigError(where + ".outage.loses: = none, but the axis outage_s needs something that is lost");
    LocalizeConfig base = baseConfig(s);
    s.robot.clear();
    s.config = plainYaml([&](ParamVisitor& v) { base.visit(v); });
    for (size_t a = 0; a < algorithms_.size(); ++a) {
      LocalizeConfig config = base;
      readYamlText(algorithms_[a], file_, [&](ParamVisitor& v) { config.visit(v); });
      config.check(file_ + ": algorithms." + algorithms[a] + ".set.sensors");
      s.configs.push_back(config);
    }
    if (!s.log.empty() && load_data) loadLog(s, where);
  }
}

SignalLoss LocalizationRunner::lossOf(const StudyPlace& place) const {
  const auto& s = scenarios_[place.scenario];
  const auto& cut = s.interruption;
  SignalLoss loss{cut.loses == "theta" || cut.loses == "all", cut.loses == "xy" || cut.loses == "all", 0, 0};
  if (cut.loses == "none") return loss;
  const double length = place.x.value_or(cut.length_s);
  loss.from_s = cut.from_s;
  if (cut.drawn) {
    const double room = s.duration() - cut.settle_s - cut.recover_s - length;
    if (room < 0)
      throw ConfigError("the drive of " + shortestNumber(s.duration()) + " s is too short for a loss of " +
                        shortestNumber(length) + " s and outage.settle_s, outage.recover_s");
    loss.from_s = cut.settle_s + room * Random(place.world_seed, textHash("outage")).uniform();
  }
  loss.to_s = loss.from_s + length;
  return loss;
}

DriveResult LocalizationRunner::localize(const StudyPlace& place, const SignalLoss& loss) const {
  const auto& s = scenarios_[place.scenario];
  const auto& config = s.configs[place.algorithm];
  DriveResult result = s.simulated
                           ? localizeSimulated(*s.simulated, config, loss, place.world_seed, place.algorithm_seed)
                           : localizeRecorded(*s.recorded, config, loss, place.algorithm_seed);
  if (result.pairs.empty()) throw DatasetError::missing("no estimate where there is truth");
  align(result, config);
  return result;
}

/// The twin's errors. It is the same for all lengths and kinds of loss, so it is run once.
std::shared_ptr<const DriveErrors> LocalizationRunner::twinOf(const StudyPlace& place) const {
  const auto& s = scenarios_[place.scenario];
  const TwinKey key{textHash(s.set + '\n' + s.log + '\n' + s.ground_truth + '\n' + s.config), place.world_seed,
                    place.algorithm_seed, place.algorithm};
  {
    const std::lock_guard lock(twins_mutex_);
    if (const auto it = twins_.find(key); it != twins_.end()) return it->second;
  }
  auto made = std::make_shared<const DriveErrors>(errorsOf(localize(place, {})));  // the same, whoever makes it
  const std::lock_guard lock(twins_mutex_);
  return twins_.emplace(key, std::move(made)).first->second;
}

std::vector<double> LocalizationRunner::run(const StudyPlace& place) const {
  const SignalLoss loss = lossOf(place);
  if (loss.any() && scenarios_[place.scenario].configs[place.algorithm].row().odometry_only) {
    DriveResult reckoned = localize(place, loss);
    layOntoTruthAt(loss.from_s, reckoned);
    return valuesOf(driveMetrics(), measureDrive(reckoned, {}, loss, 0));
  }
  const auto twin = loss.any() ? twinOf(place) : std::make_shared<const DriveErrors>();
  const double settle_s = scenarios_[place.scenario].interruption.settle_s;
  return valuesOf(driveMetrics(), measureDrive(localize(place, loss), *twin, loss, settle_s));
}

bool LocalizationRunner::draw(const StudyPlace& place, const std::string& title, const std::string& png_file) const {
  const DriveResult result = localize(place, lossOf(place));
  TrajectoryFigure figure;
  figure.title = title;
  for (size_t i = 0; i < result.pairs.size(); ++i) {
    const auto& p = result.pairs[i];
    figure.truth.add(p.truth.x, p.truth.y);
    figure.estimate.add(p.estimate.x, p.estimate.y);
    figure.odometry.add(result.odometry[i].x, result.odometry[i].y);
    if (i % (result.pairs.size() / 25 + 1) == 0)
      figure.ellipses.push_back({p.estimate, p.covariance.topLeftCorner<2, 2>()});
  }
  for (const auto& f : result.fixes) figure.fixes.add(f.x, f.y);
  drawTrajectory(figure, png_file);
  return true;
}

}  // namespace

std::unique_ptr<StudyRunner> makeLocalizationRunner(const std::string& study_file) {
  return std::make_unique<LocalizationRunner>(study_file);
}

}  // namespace sidestep
