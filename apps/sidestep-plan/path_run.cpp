// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-plan/path_run.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "common/program.h"
#include "datasets/ground_truth.h"
#include "figures/path_figure.h"
#include "maps/nearest_reachable.h"

namespace sidestep {
namespace {

using Json = nlohmann::ordered_json;

/// CPU time of the process [ms].
double cpuMilliseconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// In the order of GlobalPath::Status.
const char* word(GlobalPath::Status status) {
  static constexpr const char* kWords[] = {"found",        "start_outside", "goal_outside", "start_blocked",
                                           "goal_blocked", "unreachable",   "time_over"};
  return kWords[static_cast<size_t>(status)];
}

std::string fixed(double value, int decimals) {
  char out[400];
  return {out, std::to_chars(out, out + sizeof out, value, std::chars_format::fixed, decimals).ptr};
}

/// One query answered by one planner.
struct Answer {
  size_t pair = 0;
  std::string planner;
  GlobalPath path;
  PathQuality quality;
  double time_ms = 0;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n == 0 ? 0 : (values[(n - 1) / 2] + values[n / 2]) / 2;
}

/// One call of the program.
class Run {
 public:
  Run(const PathOptions& options, const PathConfig& config)
      : options_(options), config_(config), pairs_(readPairs(options)) {
    const GridMap map = readMap(options.map, config.map);
    folder_.emplace(options.output, options.overwrite);
    const double begin = cpuMilliseconds();
    field_ = std::make_shared<const DistanceField>(distanceField(map, config.obstacles, config.field));
    field_ms_ = cpuMilliseconds() - begin;
    grid_ = std::make_shared<const PlanningGrid>(field_, config.planning.clearance_m);
    grid_ms_ = cpuMilliseconds() - begin - field_ms_;
    if (options.nearest) moveEnds();
  }

  ExitCode go();

 private:
  std::vector<std::string> planners() const {
    if (!options_.all) return {config_.planner};
    auto out = globalPlanners();
    std::erase_if(out,
                  [this](const auto& word) { return !refusesSpace(word, config_.planning.sampling.space).empty(); });
    return out;
  }
  void moveEnds();
  Answer answer(GlobalPlanner& planner, const std::string& name, size_t pair) const;
  bool isSmoothed(const std::string& planner) const;
  void writePath(const Answer& a, const std::string& name) const;
  void writePaths() const;
  void writeMetrics() const;
  void draw() const;
  void printTable() const;
  void printSummary() const;
  void complain() const;

  const PathOptions& options_;
  const PathConfig& config_;
  std::vector<PathPair> pairs_;
  std::optional<OutputFolder> folder_;
  std::shared_ptr<const DistanceField> field_;
  std::shared_ptr<const PlanningGrid> grid_;
  double field_ms_ = 0, grid_ms_ = 0;
  std::vector<Answer> answers_;
  std::vector<std::string> moved_;
};

void Run::moveEnds() {
  for (auto& pair : pairs_)
    for (auto* pose : {&pair.start, &pair.goal}) {
      const auto way =
          wayToClearance(*field_, {pose->x, pose->y}, config_.planning.clearance_m, config_.nearest_within_m);
      const std::string end = pose == &pair.start ? "start" : "goal";
      if (way.empty())
        std::fprintf(stderr,
                     "sidestep-plan: %s not moved: no way of at most %s m (nearest_within_m) leads to free space\n",
                     end.c_str(), shortestNumber(config_.nearest_within_m).c_str());
      if (way.size() < 2) continue;
      const auto place = way.back();
      moved_.push_back(end + " moved by " + fixed((place - way.front()).norm(), 2) + " m to (" + fixed(place.x, 2) +
                       ", " + fixed(place.y, 2) + ")");
      std::fprintf(stderr, "sidestep-plan: %s\n", moved_.back().c_str());
      pose->x = place.x, pose->y = place.y;
    }
}

/// Arcs are smooth, and would lose their radius.
bool Run::isSmoothed(const std::string& planner) const {
  const auto& ompl = samplingPlanners();
  const bool samples = std::find(ompl.begin(), ompl.end(), planner) != ompl.end();
  return config_.smooth && (!samples || config_.planning.sampling.space == "se2");
}

Answer Run::answer(GlobalPlanner& planner, const std::string& name, size_t pair) const {
  Answer out{pair, name, {}, {}, 0};
  const double begin = cpuMilliseconds();
  out.path = planner.plan(pairs_[pair].start, pairs_[pair].goal);
  if (out.path.found() && isSmoothed(name))
    out.path.poses = smoothPath(*field_, config_.planning.clearance_m, config_.smoothing, out.path.poses);
  out.time_ms = cpuMilliseconds() - begin;
  out.quality = pathQuality(*field_, out.path.poses);
  return out;
}

void Run::writePath(const Answer& a, const std::string& name) const {
  std::string csv = "x,y,heading_deg,clearance_m\n";
  TumWriter tum(folder_->file(name + ".tum"));
  double s = 0;
  for (size_t i = 0; i < a.path.poses.size(); ++i) {
    const auto& p = a.path.poses[i];
    if (i > 0) s += std::hypot(p.x - a.path.poses[i - 1].x, p.y - a.path.poses[i - 1].y);
    csv += shortestNumber(p.x) + "," + shortestNumber(p.y) + "," + shortestNumber(p.phi * 180 / M_PI) + "," +
           shortestNumber(field_->clearance(p.x, p.y)) + "\n";
    tum.write(s, p);
  }
  tum.close();
  folder_->writeText(name + ".csv", csv);
}

void Run::writePaths() const {
  std::string csv = "pair,planner,status,length_m,clearance_m,time_ms\n";
  for (const auto& a : answers_) {
    csv += std::to_string(a.pair) + "," + a.planner + "," + word(a.path.status) + ",";
    csv += a.path.found() ? fixed(a.quality.length_m, 6) + "," + fixed(a.quality.clearance_m, 6) + "," : ",,";
    csv += fixed(a.time_ms, 3) + "\n";
  }
  folder_->writeText("paths.csv", csv);
}

void Run::writeMetrics() const {
  Json json;
  json["map"] = options_.map;
  json["cells"] = {field_->frame().width, field_->frame().height};
  json["distance_field_ms"] = field_ms_;
  json["planning_grid_ms"] = grid_ms_;
  json["moved"] = moved_;
  json["partial"] = interrupted();
  json["paths"] = Json::array();
  for (const auto& a : answers_) {
    Json p = {{"pair", a.pair}, {"planner", a.planner}, {"status", word(a.path.status)}};
    if (!a.path.found()) p["reason"] = a.path.reason;
    if (a.path.found())
      p.update({{"length_m", a.quality.length_m},
                {"clearance_m", a.quality.clearance_m},
                {"mean_clearance_m", a.quality.mean_clearance_m},
                {"turning_rad", a.quality.turning_rad},
                {"bending_per_m2", a.quality.bending},
                {"poses", a.path.poses.size()},
                {"expanded", a.path.expanded}});
    p["time_ms"] = a.time_ms;
    json["paths"].push_back(p);
  }
  folder_->writeText("metrics.json", json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void Run::draw() const {
  PathFigure figure;
  figure.title = options_.map.substr(options_.map.find_last_of('/') + 1);
  figure.field = field_.get();
  figure.clearance_m = config_.planning.clearance_m;
  figure.start = pairs_[0].start, figure.goal = pairs_[0].goal;
  for (const auto& a : answers_)
    if (a.path.found()) figure.lines.push_back({a.planner + ", " + fixed(a.quality.length_m, 2) + " m", a.path.poses});
  if (!figure.lines.empty()) drawPaths(figure, folder_->file("path.png"));
}

void Run::printTable() const {
  std::printf("%-17s %-14s %9s %11s %9s %10s %9s\n", "planner", "status", "length m", "clearance m", "turns deg",
              "bend 1/m2", "cpu ms");
  for (const auto& a : answers_) {
    const auto& q = a.quality;
    if (a.path.found())
      std::printf("%-17s %-14s %9.3f %11.3f %9.1f %10.4f %9.2f\n", a.planner.c_str(), word(a.path.status), q.length_m,
                  q.clearance_m, q.turning_rad * 180 / M_PI, q.bending, a.time_ms);
    else
      std::printf("%-17s %-14s %9s %11s %9s %10s %9.2f\n", a.planner.c_str(), word(a.path.status), "-", "-", "-", "-",
                  a.time_ms);
  }
}

void Run::printSummary() const {
  std::printf("%-17s %9s %15s %14s %13s %11s\n", "planner", "found", "median length m", "least clear. m",
              "median cpu ms", "max cpu ms");
  for (const auto& planner : planners()) {
    std::vector<double> lengths, times;
    double clearance = field_->cap();
    size_t asked = 0;
    for (const auto& a : answers_) {
      if (a.planner != planner) continue;
      ++asked;
      times.push_back(a.time_ms);
      if (!a.path.found()) continue;
      lengths.push_back(a.quality.length_m);
      clearance = std::min(clearance, a.quality.clearance_m);
    }
    if (asked == 0) continue;
    const std::string found = std::to_string(lengths.size()) + "/" + std::to_string(asked);
    std::printf("%-17s %9s %15.3f %14.3f %13.2f %11.2f\n", planner.c_str(), found.c_str(), median(lengths), clearance,
                median(times), *std::max_element(times.begin(), times.end()));
  }
}

void Run::complain() const {
  for (const auto& a : answers_)
    if (!a.path.found())
      std::fprintf(stderr, "sidestep-plan: %s%s: no path: %s\n",
                   pairs_.size() > 1 ? ("pair " + std::to_string(a.pair) + ", ").c_str() : "", a.planner.c_str(),
                   a.path.reason.c_str());
}

ExitCode Run::go() {
  folder_->writeConfiguration(fieldsOf(config_));
  const auto names = planners();
  for (const auto& word : globalPlanners())
    if (options_.all && std::find(names.begin(), names.end(), word) == names.end())
      std::fprintf(stderr, "sidestep-plan: left out: %s\n",
                   refusesSpace(word, config_.planning.sampling.space).c_str());
  const bool batch = !options_.pairs_file.empty();
  {
    ProgressBar bar("planning", options_.quiet);
    for (size_t k = 0; k < names.size() && !interrupted(); ++k) {
      const auto planner = makeGlobalPlanner(names[k], grid_, config_.planning);
      for (size_t i = 0; i < pairs_.size() && !interrupted(); ++i) {
        answers_.push_back(answer(*planner, names[k], i));
        bar.update(static_cast<double>(answers_.size()) / static_cast<double>(names.size() * pairs_.size()));
      }
    }
  }
  if (batch) writePaths();
  for (const auto& a : answers_)
    if (!batch && a.path.found()) writePath(a, options_.all ? "path-" + a.planner : "path");
  writeMetrics();
  if (!batch && !options_.no_picture) draw();
  batch ? printSummary() : printTable();
  complain();
  if (interrupted()) return ExitCode::kInterrupted;
  const bool all = std::all_of(answers_.begin(), answers_.end(), [](const Answer& a) { return a.path.found(); });
  return all ? ExitCode::kDone : ExitCode::kAlgorithmGaveUp;
}

}  // namespace

ExitCode planPaths(const PathOptions& options) {
  const PathConfig config = effectivePathConfig(options);
  if (options.write_config) {
    std::fputs(writeYaml(fieldsOf(config)).c_str(), stdout);
    return ExitCode::kDone;
  }
  if (options.map.empty()) throw ConfigError("no --map given; for example --map office.yaml");
  return Run(options, config).go();
}

}  // namespace sidestep
