// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "common/program.h"
#include "evaluation/batch/thread_pool.h"
#include "evaluation/experiments/band_benchmark.h"
#include "figures/band_figure.h"
#include "planning/global/way_exists.h"
#include "sidestep-plan/commands.h"

namespace sidestep {
namespace {

struct Options : BandCommandOptions {
  bool moving = false, picture = false, verify = false, explain = false;
  std::optional<int> classes;
  int repeats = 5;
  Options() { output = "sidestep-plan-band-out"; }
};

/// CPU time of this thread, so that others on the machine do not count; with more threads wall time.
double nowMs(bool one_thread) {
  timespec t{};
  clock_gettime(one_thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

std::string csvLine(const BandResult& r, const std::string& planner) {
  std::string line = std::to_string(r.n_obs) + "," + std::to_string(r.seed) + "," + planner + "," + r.status;
  char text[400];
  std::snprintf(text, sizeof text, ",%.4f,%.4f,%d,%.4f,%.4f,%.5f,%.5f,%.5f,%.5f,%.4f", r.time_ms, r.warm_ms, r.poses,
                r.transition_s, r.min_dist_m, r.max_v, r.max_w, r.max_a, r.max_alpha, r.cost);
  line += text;
  if (r.way_exists.empty()) return line + "\n";
  std::snprintf(text, sizeof text, ",%s,%.4f\n", r.way_exists.c_str(), r.least_s);
  return line + text;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Medians by number of obstacles, as JSON and as a table on stdout.
std::string summary(const std::vector<BandResult>& rows, const std::string& planner) {
  std::map<int, std::vector<BandResult>> groups;
  for (const auto& r : rows) groups[r.n_obs].push_back(r);
  std::string json = "{\n  \"planner\": \"" + planner + "\"";
  std::printf("%s: medians\n  n_obs problems clear  cold ms  warm ms  transition s  largest a  largest alpha\n",
              planner.c_str());
  for (const auto& [n, group] : groups) {
    const auto of = [&group = group](double BandResult::*field) {
      std::vector<double> out;
      for (const auto& r : group) out.push_back(r.*field);
      return out;
    };
    const auto most = [](const std::vector<double>& v) { return *std::max_element(v.begin(), v.end()); };
    const auto clear = std::count_if(group.begin(), group.end(), [](const auto& r) { return r.status == "clear"; });
    std::printf("  %5d %8zu %5td %8.3f %8.3f %13.2f %10.4f %14.4f\n", n, group.size(), clear,
                median(of(&BandResult::time_ms)), median(of(&BandResult::warm_ms)),
                median(of(&BandResult::transition_s)), most(of(&BandResult::max_a)), most(of(&BandResult::max_alpha)));
    const auto ways = std::count_if(group.begin(), group.end(), [](const auto& r) { return r.way_exists == "yes"; });
    if (!group.front().way_exists.empty())
      std::printf("        a way exists in %td; shortest way without bends, median %.2f s\n", ways,
                  median(of(&BandResult::least_s)));
    char text[400];
    std::snprintf(text, sizeof text,
                  ",\n  \"%d\": {\"problems\": %zu, \"clear\": %td, \"time_ms\": %.4f, \"warm_ms\": %.4f, "
                  "\"transition_s\": %.4f}",
                  n, group.size(), clear, median(of(&BandResult::time_ms)), median(of(&BandResult::warm_ms)),
                  median(of(&BandResult::transition_s)));
    json += text;
  }
  return json + "\n}\n";
}

void verify(const PlanningProblem& problem, const BandBenchmark& run, BandResult& row) {
  const WayVerdict way =
      run.moving ? movingWay(problem.obstacles, run.robot) : standingWay(problem.obstacles, run.robot);
  row.way_exists = way.exists;
  row.least_s = way.least_s;
}

std::string candidatesHead(const PlanCandidate& first) {
  std::string line = "n_obs,seed,candidate,chosen,rejected,total,transition_s";
  for (const auto& [term, cost] : first.costs) line += "," + term;
  return line + "\n";
}

/// Each candidate of a cold plan with the cost of each term, and why it was not chosen; a header before the first.
std::string candidateLines(const PlanningProblem& p, const PlanOutput& out, bool header) {
  std::string lines;
  const auto add = [&lines](double value) { lines += ',' + shortestNumber(value); };
  if (header && !out.candidates.empty()) lines = candidatesHead(out.candidates.front());
  int n = 0;
  for (const auto& c : out.candidates) {
    lines += std::to_string(p.n_obs) + "," + std::to_string(p.seed) + "," + std::to_string(n++) + ",";
    lines += (c.rejected.empty() ? "1," : "0,") + c.rejected;
    add(c.total);
    add(c.trajectory.back().after_s);
    for (const auto& [term, cost] : c.costs) add(cost);
    lines += "\n";
  }
  return lines;
}

BandFigure::Panel panelOf(const PlanningProblem& problem, const BandPlanner& planner) {
  BandFigure::Panel panel;
  panel.title = std::to_string(problem.n_obs) + " obstacles, seed " + std::to_string(problem.seed);
  for (const auto& o : problem.obstacles) panel.obstacles.push_back(o.position);
  for (const auto& c : planner.candidates()) {
    if (!c.alive) continue;
    auto& line = (c.chosen ? panel.chosen : panel.others).emplace_back();
    for (const auto& p : c.band) line.emplace_back(p.x, p.y);
  }
  return panel;
}

/// Appends the lines of each plan's candidates to a text, which must outlive what is returned.
auto appendTo(std::string& lines) {
  return [&](const PlanningProblem& p, const PlanOutput& out) { lines += candidateLines(p, out, lines.empty()); };
}

std::string csvHead(bool verify) {
  return std::string("n_obs,seed,planner,status,time_ms,warm_ms,poses,transition_s,min_dist_m,max_v,max_w,max_a,") +
         "max_alpha,cost" + (verify ? ",way_exists,least_s\n" : "\n");
}

/// Adds nine problems, evenly chosen, to the picture. Both arguments must outlive what is returned.
auto drawNineOf(const std::vector<PlanningProblem>& problems, BandFigure& picture) {
  return [&](const PlanningProblem& p, const BandPlanner& bands) {
    const size_t apart = std::max<size_t>(problems.size() / 9, 1);
    if (static_cast<size_t>(&p - problems.data()) % apart == 0 && picture.panels.size() < 9)
      picture.panels.push_back(panelOf(p, bands));
  };
}

ExitCode runBand(const Options& o) {
  BandPlannerParams params = bandPlannerParams(o.planner);
  RobotLimits robot;
  const auto visit = [&](ParamVisitor& v) {
    v.section("robot", "the robot", [&](ParamVisitor& s) { robot.visit(s); });
    v.section("planner", "the band planner", [&](ParamVisitor& s) { params.visit(s); });
  };
  if (!o.config_file.empty()) readYaml(o.config_file, visit);
  if (o.classes) params.exploration.classes_max = *o.classes;
  if (o.write_config) {
    std::fputs(writeYaml(visit).c_str(), stdout);
    return ExitCode::kDone;
  }
  if (o.problems.empty()) throw ConfigError("--problems is missing; name a CSV of problems");
  const auto problems = readProblems(o.problems, true, 0);
  const OutputFolder folder(o.output, o.overwrite);
  folder.writeConfiguration(visit);
  ThreadPool pool(o.threads);
  BandPlanner planner(params);
  if (o.threads > 1) planner.useThreads([&](int n, const auto& f) { pool.run(n, f); });
  BandBenchmark run{robot, o.moving, o.repeats, 50, [one = o.threads == 1] { return nowMs(one); }, {}, {}};
  BandFigure picture;
  picture.radius_m = robot.radius_m;
  if (o.picture) run.planned_cold = drawNineOf(problems, picture);
  std::string explained;
  planner.explain(o.explain);
  if (o.explain) run.explained = appendTo(explained);
  ProgressBar bar("band", o.quiet);
  std::string csv = csvHead(o.verify);
  std::vector<BandResult> rows;
  for (const auto& problem : problems) {
    if (interrupted()) break;
    rows.push_back(benchmarkBand(problem, run, planner));
    if (o.verify) verify(problem, run, rows.back());
    csv += csvLine(rows.back(), o.planner);
    bar.update(static_cast<double>(rows.size()) / static_cast<double>(problems.size()));
  }
  folder.writeText("results.csv", csv);
  if (o.explain) folder.writeText("candidates.csv", explained);
  if (o.picture) drawBands(picture, folder.file("bands.png"));
  if (!rows.empty()) folder.writeText("metrics.json", summary(rows, o.planner));
  return rows.size() < problems.size() ? ExitCode::kInterrupted : ExitCode::kDone;
}

}  // namespace

void addBandCommand(CLI::App& app, Work& work) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("band", "benchmark timed elastic bands on a CSV of problems");
  sub->add_option("--problems", o->problems, "n_obs,seed,i,x,y,vx,vy: point obstacles between (0,0,0) and (8,0)")
      ->type_name("FILE");
  sub->add_option("--planner", o->planner, "teb, pteb, eteb, eteb-printed, pteb+eteb")
      ->check(CLI::IsMember(bandPlannerNames()))
      ->type_name("NAME")
      ->capture_default_str();
  sub->add_flag("--moving", o->moving, "obstacles move at their velocities");
  sub->add_flag("--picture", o->picture, "draw nine of the cold plans, bands.png");
  sub->add_flag(
      "--verify", o->verify,
      "look for a way without bands too: columns way_exists and least_s, the time of the shortest way without bends");
  sub->add_flag("--explain", o->explain, "candidates.csv: all classes of each cold plan, cost by term, why not chosen");
  sub->add_option("--threads", o->threads, "for the bands of a plan; the results are the same")
      ->check(CLI::Range(1, 64))
      ->type_name("N")
      ->capture_default_str();
  sub->add_option("--classes", o->classes, "bands side by side; default: as configured")
      ->check(CLI::Range(1, 16))
      ->type_name("N");
  sub->add_option("--repeats", o->repeats, "cold plans of each problem; times are their medians")
      ->check(CLI::Range(1, 1000))
      ->type_name("N")
      ->capture_default_str();
  sub->add_option("-c,--config", o->config_file, "robot and planner (YAML)")->type_name("FILE");
  sub->add_option("-o,--output", o->output, "output folder")->type_name("DIR")->capture_default_str();
  sub->add_flag("-w,--overwrite", o->overwrite, "write into a folder that holds something");
  sub->add_flag("-q,--quiet", o->quiet, "no progress bar");
  sub->add_flag("--write-config", o->write_config, "print all parameters as commented YAML and exit");
  sub->footer(
      "Makes results.csv (min_dist_m is from rim to point; negative: contact), metrics.json, effective.yaml, "
      "command.txt.\n"
      "Example:\n"
      "  sidestep-plan band --problems share/problems/band.csv --planner teb -o out-band");
  sub->callback([o, &work] { work = [o] { return runBand(*o); }; });
}

}  // namespace sidestep
