// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/laser_runner.h"

#include <filesystem>

#include "core/data_path.h"
#include "core/errors.h"
#include "evaluation/experiments/laser_trial.h"
#include "evaluation/experiments/map_drive.h"
#include "figures/trajectory_figure.h"

namespace sidestep {
namespace {

struct LaserScenario {
  std::string log, ground_truth, robot, map, config;
  std::vector<std::string> labels;
  MapReadParams map_read;
  MapDriveParams drive;
  LaserTrialParams trial;
  // made by prepare()
  std::shared_ptr<const RecordedDrive> recorded;
  std::shared_ptr<const GridMap> grid;  ///< to drive on
  std::vector<LocalizeConfig> configs;  ///< by algorithm
};

class LaserRunner final : public StudyRunner {
 public:
  explicit LaserRunner(std::string study_file) : file_(std::move(study_file)) {}

  void visitScenario(size_t index, ParamVisitor& v) override {
    if (scenarios_.size() <= index) scenarios_.resize(index + 1);
    auto& s = scenarios_[index];
    v.text("map", s.map, "the map; may hold ${SIDESTEP_DATA}");
    v.section("map_read", "what some maps do not say themselves", [&](ParamVisitor& w) { s.map_read.visit(w); });
    v.text("log", s.log, "a rawlog; may hold ${SIDESTEP_DATA}; empty: a drive is made on the map, by the run's seed");
    v.texts("labels", s.labels, "which of its labels serves as a kind of sensor, kind=label");
    v.text("ground_truth", s.ground_truth, "file of true poses; empty: the log's own");
    v.section("drive", "the drive that is made", [&](ParamVisitor& w) { s.drive.visit(w); });
    v.text("robot", s.robot, "the robot, a YAML of sidestep-localize");
    v.overlay("config", s.config, "what is changed in that");
    v.section("trial", "what the localizer has to do", [&](ParamVisitor& w) { s.trial.visit(w); });
  }
  void visitAlgorithm(size_t index, ParamVisitor& v) override {
    if (algorithms_.size() <= index) algorithms_.resize(index + 1);
    v.overlay("set", algorithms_[index], "what the algorithm changes in each scenario's configuration");
  }
  std::vector<std::string> axes() const override { return {"carried_after_s", "off_m"}; }
  const std::vector<MetricInfo>& metrics() const override {
    static const auto infos = infosOf(laserMetrics());
    return infos;
  }

  void prepare(const std::vector<std::string>& scenarios, const std::vector<std::string>& axes,
               const std::vector<std::string>& algorithms, bool load_data) override;
  std::vector<double> run(const StudyPlace& place) const override;
  bool draw(const StudyPlace& place, const std::string& title, const std::string& png_file) const override;

 private:
  std::string found(const std::string& name, const std::string& where) const;
  void load(LaserScenario& s, const std::string& where) const;
  std::vector<LaserSample> localize(const StudyPlace& place) const;

  std::string file_;
  std::vector<LaserScenario> scenarios_;
  std::vector<std::string> axes_, algorithms_;
};

std::string LaserRunner::found(const std::string& name, const std::string& where) const {
  const auto path = resolvedPath(name, file_);
  if (std::filesystem::exists(path)) return path;
  throw DatasetError::missing(where + ": " + path +
                              " is not there; get the data, or leave the scenario out with --scenarios");
}

void LaserRunner::load(LaserScenario& s, const std::string& where) const {
  const auto map = found(s.map, where + ".map");
  for (auto& c : s.configs) c.map = map;
  if (s.log.empty()) {
    s.grid = std::make_shared<const GridMap>(readMap(map, s.map_read));
    return;
  }
  const auto truth = s.ground_truth.empty() ? "" : found(s.ground_truth, where + ".ground_truth");
  auto drive = readDrive(found(s.log, where + ".log"), truth, s.labels, kindsUsedBy(s.configs));
  if (!s.configs.empty())
    for (auto& p : drive.truth) p.pose = s.configs[0].truthInMap(p.pose);
  s.recorded = std::make_shared<const RecordedDrive>(std::move(drive));
}

void LaserRunner::prepare(const std::vector<std::string>& scenarios, const std::vector<std::string>& axes,
                          const std::vector<std::string>& algorithms, bool load_data) {
  axes_ = axes;
  for (size_t i = 0; i < scenarios_.size(); ++i) {
    auto& s = scenarios_[i];
    if (scenarios[i].empty()) continue;  // left out
    const std::string where = file_ + ": scenarios." + scenarios[i];
    if (s.map.empty()) throw ConfigError(where + ".map: is missing; laser studies are about localization in a map");
    for (size_t a = 0; a < algorithms_.size(); ++a) {
      LocalizeConfig config;
      config.filter = "mcl";
      config.sensors = {"odometry", "laser"};
      config.map = s.map;
      config.map_read = s.map_read;
      const Visit fields = [&](ParamVisitor& v) { config.visit(v); };
      if (!s.robot.empty()) readYaml(resolvedPath(s.robot, file_), fields);
      readYamlText(s.config, file_, fields);
      readYamlText(algorithms_[a], file_, fields);
      config.check(file_ + ": algorithms." + algorithms[a] + ".set.sensors");
      s.configs.push_back(config);
    }
    if (load_data) load(s, where);
  }
}

std::vector<LaserSample> LaserRunner::localize(const StudyPlace& place) const {
  const auto& s = scenarios_[place.scenario];
  LaserTrialParams trial = s.trial;
  if (place.x) (axes_[place.scenario] == "off_m" ? trial.off_m : trial.carried_after_s) = *place.x;
  const RecordedDrive made = s.grid ? driveOnMap(*s.grid, s.drive, place.world_seed) : RecordedDrive{};
  auto samples = localizeTrial(makeTrial(s.grid ? made : *s.recorded, trial, place.world_seed),
                               s.configs[place.algorithm], place.algorithm_seed);
  if (samples.empty()) throw DatasetError::missing("no estimate where there is truth");
  return samples;
}

std::vector<double> LaserRunner::run(const StudyPlace& place) const {
  return valuesOf(laserMetrics(), measureTrial(localize(place), scenarios_[place.scenario].trial.settle_s));
}

bool LaserRunner::draw(const StudyPlace& place, const std::string& title, const std::string& png_file) const {
  TrajectoryFigure figure;
  figure.title = title;
  for (const auto& s : localize(place)) {
    figure.truth.add(s.pair.truth.x, s.pair.truth.y);
    figure.estimate.add(s.pair.estimate.x, s.pair.estimate.y);
  }
  drawTrajectory(figure, png_file);
  return true;
}

}  // namespace

std::unique_ptr<StudyRunner> makeLaserRunner(const std::string& study_file) {
  return std::make_unique<LaserRunner>(study_file);
}

}  // namespace sidestep
