// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/world_runner.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "core/data_path.h"
#include "core/errors.h"
#include "core/overlay_yaml.h"
#include "core/random.h"
#include "evaluation/experiments/scenario.h"
#include "evaluation/experiments/world_check.h"
#include "evaluation/experiments/world_controllers.h"
#include "evaluation/experiments/world_record.h"
#include "evaluation/experiments/world_scenario.h"
#include "evaluation/metrics/collision_index.h"
#include "evaluation/metrics/world_metrics.h"
#include "evaluation/study/study.h"
#include "figures/timeline_figure.h"

namespace sidestep {
namespace {

struct ScenarioEntry {
  std::string file, set, goals = "all";
  bool unchecked = false;
  // made by prepare()
  std::vector<WorldScenario> worlds;                       ///< by algorithm
  std::vector<std::shared_ptr<const WorldInputs>> inputs;  ///< by algorithm
};

struct AlgorithmEntry {
  std::string robot, others, sees_robot = "unchanged", set;

  void visit(ParamVisitor& v) {
    v.text("robot", robot, "planner of the robot under test; empty: as the scenario says");
    v.section("others", "all other robots", [this](ParamVisitor& w) {
      w.text("planner", others, "their planner; empty: as the scenario says");
      w.choice("sees_robot", sees_robot, {"unchanged", "true", "false"},
               "whether the robot under test exists for them");
    });
    v.overlay("set", set, "what the algorithm changes in each scenario, for example parameters of planners");
  }
  void apply(WorldScenario& s, const std::string& where) const {
    if (!isBlank(set)) s.layOver(set, where);
    for (size_t i = 0; i < s.world.robot_names.size(); ++i) {
      RobotParams& r = s.world.robots[s.world.robot_names[i]];
      const bool tested = i == s.world.underTest();
      const std::string& planner = tested ? robot : others;
      if (!planner.empty()) r.planner = planner;
      if (!tested && sees_robot != "unchanged") r.sees_robot = sees_robot == "true";
    }
  }
};

/// What may vary along an axis.
struct Axis {
  const char* name;
  void (*set)(WorldParams& p, double x);
};

const Axis kAxes[] = {
    {"people",
     [](WorldParams& p, double x) {
       for (const auto& name : p.people_names) p.people[name].count = std::max(1, static_cast<int>(x));
     }},
    {"people_speed",
     [](WorldParams& p, double x) {
       for (const auto& name : p.people_names) p.people[name].speed = x;
     }},
    {"robot_room_m", [](WorldParams& p, double x) { p.social_force.robot_room_m = x; }},
    {"latency_s", [](WorldParams& p, double x) { robotUnderTest(p).drive.latency_s = x; }},
    {"position_sd_m", [](WorldParams& p, double x) { robotUnderTest(p).perception.position_sd_m = x; }},
    {"velocity_sd", [](WorldParams& p, double x) { robotUnderTest(p).perception.velocity_sd = x; }},
};

class WorldRunner final : public StudyRunner {
 public:
  explicit WorldRunner(std::string study_file) : file_(std::move(study_file)) {}

  void visitScenario(size_t index, ParamVisitor& v) override {
    if (scenarios_.size() <= index) scenarios_.resize(index + 1);
    v.text("file", scenarios_[index].file, "a world, a YAML of sidestep-simulate; relative to the study's folder");
    v.overlay("set", scenarios_[index].set, "what is changed in that world");
    v.choice(
        "goals", scenarios_[index].goals, {"all", "one"},
        "of a robot under test with several goals: all of them; or the one that the run's seed says, from the place of "
        "the one before it (the first one from the start), facing it");
  }
  void visitAlgorithm(size_t index, ParamVisitor& v) override {
    if (algorithms_.size() <= index) algorithms_.resize(index + 1);
    algorithms_[index].visit(v);
  }
  std::vector<std::string> axes() const override {
    std::vector<std::string> out;
    for (const Axis& a : kAxes) out.emplace_back(a.name);
    return out;
  }
  const std::vector<MetricInfo>& metrics() const override {
    static const auto infos = infosOf(worldMetrics());
    return infos;
  }
  void prepare(const std::vector<std::string>& scenarios, const std::vector<std::string>& axes,
               const std::vector<std::string>& algorithms, bool load_data) override;
  std::vector<double> run(const StudyPlace& place) const override;
  bool draw(const StudyPlace& place, const std::string& title, const std::string& png_file) const override;
  bool drawTogether(const std::vector<StudyPlace>& places, const std::vector<std::string>& names,
                    const std::string& title, const std::string& png_file) const override;

 private:
  WorldScenario load(ScenarioEntry& s, const std::string& where) const;
  std::shared_ptr<const WorldInputs> inputsOf(const WorldParams& p, bool load_data);
  void checkRunnable(const WorldParams& world, const WorldInputs& inputs, const std::string& scenario,
                     const std::string& algorithm) const;

  std::string file_;
  std::vector<ScenarioEntry> scenarios_;
  std::vector<std::string> axes_;
  std::vector<AlgorithmEntry> algorithms_;
  std::map<std::string, std::shared_ptr<const WorldInputs>> inputs_;  ///< by what is read
};

/// A path of a scenario so that it is found from anywhere.
std::string fromAnywhere(const std::string& path, const std::string& scenario_file) {
  if (path.empty() || path.find("${") != std::string::npos) return path;
  return std::filesystem::absolute(scenarioPath(path, scenario_file)).lexically_normal().string();
}

/// The scenario's file and changes; from then on all of it stands in `set`.
WorldScenario WorldRunner::load(ScenarioEntry& s, const std::string& where) const {
  const std::string file = s.file.empty() ? file_ : resolvedPath(s.file, file_);
  WorldScenario world;
  if (!s.file.empty()) world = readWorldScenario(file);
  if (!isBlank(s.set)) world.layOver(s.set, file_);
  try {
    world.check();
  } catch (const ConfigError& e) {
    throw ConfigError(where + ": " + e.what());
  }
  world.world.map = fromAnywhere(world.world.map, file);
  world.world.tracks = fromAnywhere(world.world.tracks, file);
  s.file.clear();
  s.set = plainYaml([&](ParamVisitor& v) { world.visit(v); });
  return world;
}

std::shared_ptr<const WorldInputs> WorldRunner::inputsOf(const WorldParams& p, bool load_data) {
  if (!load_data) return nullptr;
  auto& known = inputs_[p.map + "\n" + p.tracks + "\n" + shortestNumber(p.tracks_from_s)];
  if (!known) known = std::make_shared<const WorldInputs>(readWorldInputs(p, file_));
  return known;
}

/// @throws ConfigError with all that overlaps or cannot be reached.
void WorldRunner::checkRunnable(const WorldParams& world, const WorldInputs& inputs, const std::string& scenario,
                                const std::string& algorithm) const {
  const auto problems = findProblems(world, inputs.walls);
  if (problems.empty()) return;
  std::string text = file_ + ": scenarios." + scenario + " with algorithms." + algorithm + ":";
  for (const auto& p : problems) text += "\n  " + p.key + ": " + p.what;
  throw ConfigError(text + "\n(unchecked: true in the scenario's entry runs it anyway)");
}

/// @param where  for the message
void check(const WorldScenario& world, const std::string& where) {
  try {
    world.check();
  } catch (const ConfigError& e) {
    throw ConfigError(where + ": " + e.what());
  }
}

void WorldRunner::prepare(const std::vector<std::string>& scenarios, const std::vector<std::string>& axes,
                          const std::vector<std::string>& algorithms, bool load_data) {
  axes_ = axes;
  for (size_t i = 0; i < scenarios_.size(); ++i) {
    auto& s = scenarios_[i];
    if (scenarios[i].empty()) continue;  // left out
    const WorldScenario base = load(s, file_ + ": scenarios." + scenarios[i]);
    for (size_t a = 0; a < algorithms_.size(); ++a) {
      WorldScenario world = base;
      algorithms_[a].apply(world, file_);
      check(world, file_ + ": algorithms." + algorithms[a]);
      s.inputs.push_back(inputsOf(world.world, load_data));
      if (load_data && !s.unchecked && (a == 0 || !isBlank(algorithms_[a].set)))
        checkRunnable(world.world, *s.inputs.back(), scenarios[i], algorithms[a]);
      s.worlds.push_back(std::move(world));
    }
  }
}

/// A run, with what is noted on the way.
struct WatchedRun {
  WatchedRun(const WorldScenario& scenario, const WorldInputs& inputs, uint64_t seed)
      : world(scenario.world, seed, inputs, navigatorControllers(scenario.planners)), recorder(world) {
    watchRobotUnderTest(world, scenario, false, [this](const PlanInput&, const PlanOutput& out) { plans.add(out); });
    world.run([this] {
      recorder.note();
      return true;
    });
  }

  World world;
  WorldRecorder recorder;
  PlanCount plans;
};

/// Leaves the robot one of its goals.
void keepOneGoal(RobotParams& robot, uint64_t seed) {
  if (robot.goals.size() < 2) return;
  const auto n = static_cast<double>(robot.goals.size());
  const auto k = static_cast<size_t>(std::min(n * Random(seed, textHash("goal")).uniform(), n - 1));
  if (k > 0) robot.x_m = robot.goals[k - 1][0], robot.y_m = robot.goals[k - 1][1];
  robot.goals = {robot.goals[k]};
  robot.yaw = std::atan2(robot.goals[0][1] - robot.y_m, robot.goals[0][0] - robot.x_m);
}

WatchedRun runOf(const ScenarioEntry& s, const std::string& axis, const StudyPlace& place) {
  const WorldScenario& base = s.worlds[place.algorithm];
  if (!place.x && s.goals == "all") return WatchedRun(base, *s.inputs[place.algorithm], place.world_seed);
  WorldScenario varied = base;
  if (s.goals == "one") keepOneGoal(robotUnderTest(varied.world), place.world_seed);
  if (!place.x) return WatchedRun(varied, *s.inputs[place.algorithm], place.world_seed);
  for (const Axis& a : kAxes)
    if (axis == a.name) a.set(varied.world, *place.x);
  return WatchedRun(varied, *s.inputs[place.algorithm], place.world_seed);
}

std::vector<double> WorldRunner::run(const StudyPlace& place) const {
  const WatchedRun run = runOf(scenarios_[place.scenario], axes_[place.scenario], place);
  const WorldRecorder& r = run.recorder;
  return valuesOf(worldMetrics(), {summarize(run.world), r.largestCollisionIndex(), r.timeAboveThreshold(),
                                   r.timeStanding(), run.plans});
}

bool WorldRunner::draw(const StudyPlace& place, const std::string& title, const std::string& png_file) const {
  WatchedRun run = runOf(scenarios_[place.scenario], axes_[place.scenario], place);
  run.recorder.figure().title = title;
  drawWorld(run.recorder.figure(), png_file);
  return true;
}

bool WorldRunner::drawTogether(const std::vector<StudyPlace>& places, const std::vector<std::string>& names,
                               const std::string& title, const std::string& png_file) const {
  TimelineFigure figure;
  figure.title = title;
  figure.index_threshold = kCollisionIndexThreshold;
  for (size_t i = 0; i < places.size(); ++i) {
    const WatchedRun run = runOf(scenarios_[places[i].scenario], axes_[places[i].scenario], places[i]);
    figure.runs.push_back({names[i], run.recorder.timeline()});
  }
  drawTimeline(figure, png_file);
  return true;
}

}  // namespace

std::unique_ptr<StudyRunner> makeWorldRunner(const std::string& study_file) {
  return std::make_unique<WorldRunner>(study_file);
}

}  // namespace sidestep
