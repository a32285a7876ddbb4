// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "common/program.h"
#include "evaluation/batch/thread_pool.h"
#include "evaluation/experiments/crossing_run.h"
#include "planning/band/band_planner.h"
#include "sidestep-plan/commands.h"

namespace sidestep {
namespace {

struct Options : BandCommandOptions {
  Options() {
    output = "sidestep-plan-crossing-out";
    planner = "teb,pteb,eteb,pteb+eteb";
  }
};

double nowMs(bool one_thread) {
  timespec t{};
  clock_gettime(one_thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

std::vector<std::string> wordsOf(const std::string& list) {
  std::vector<std::string> out(1);
  for (char c : list) {
    if (c == ',')
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

std::string csvLine(const CrossingRow& r, const std::string& planner) {
  char text[200];
  std::snprintf(text, sizeof text, ",%s,%.2f,%.4f,%.4f,%.4f\n", r.outcome.c_str(), r.time_s, r.min_clearance_m,
                quantile(r.plan_ms, 0.5), quantile(r.plan_ms, 0.95));
  return std::to_string(r.seed) + "," + planner + text;
}

/// What all runs of a planner come to, as JSON; a line of the table on stdout.
std::string summary(const std::vector<CrossingRow>& rows, const std::string& planner) {
  const auto count = [&](const char* outcome) {
    return std::count_if(rows.begin(), rows.end(), [&](const auto& r) { return r.outcome == outcome; });
  };
  double time = 0, least = 1e9;
  std::vector<double> ms;
  for (const auto& r : rows) {
    if (r.outcome == "goal") time += r.time_s;
    least = std::min(least, r.min_clearance_m);
    ms.insert(ms.end(), r.plan_ms.begin(), r.plan_ms.end());
  }
  const auto goal = count("goal");
  time = goal > 0 ? time / static_cast<double>(goal) : 0;
  std::printf("  %-12s %4td %7td %7td %11.2f %19.3f %14.3f %11.3f\n", planner.c_str(), goal, count("contact"),
              count("timeout"), time, least, quantile(ms, 0.5), quantile(ms, 0.95));
  char text[300];
  std::snprintf(text, sizeof text,
                "  \"%s\": {\"goal\": %td, \"contact\": %td, \"timeout\": %td, \"mean_time_s\": %.3f, "
                "\"min_clearance_m\": %.4f, \"plan_ms_median\": %.4f, \"plan_ms_p95\": %.4f}",
                planner.c_str(), goal, count("contact"), count("timeout"), time, least, quantile(ms, 0.5),
                quantile(ms, 0.95));
  return text;
}

/// @throws Error for a command beyond the limits
CrossingRow checkedRun(const PlanningProblem& problem, const CrossingRun& run, LocalPlanner& planner) {
  auto row = runCrossing(problem, run, planner);
  if (row.outside_limits)
    throw Error(ExitCode::kInternalError, "seed " + std::to_string(problem.seed) + ": a command beyond the limits");
  return row;
}

/// The parameters of the planner of that name; which obstacles it sees comes from its name, the rest from `params`.
BandPlannerParams named(BandPlannerParams params, const std::string& name) {
  const auto view = bandPlannerParams(name).view;
  params.view.obstacles = view.obstacles;
  params.view.heading_of_hrvo = view.heading_of_hrvo;
  return params;
}

ExitCode runAll(const Options& o) {
  CrossingRun run;
  const auto names = wordsOf(o.planner);
  BandPlannerParams params = bandPlannerParams(names.front());
  const auto visit = [&](ParamVisitor& v) {
    v.section("robot", "the robot", [&](ParamVisitor& s) { run.robot.visit(s); });
    v.section("predictor", "motion prediction", [&](ParamVisitor& s) { run.predictor.visit(s); });
    v.section("planner", "the band planner; which obstacles it sees comes from its name",
              [&](ParamVisitor& s) { params.visit(s); });
  };
  if (!o.config_file.empty()) readYaml(o.config_file, visit);
  if (o.write_config) {
    std::fputs(writeYaml(visit).c_str(), stdout);
    return ExitCode::kDone;
  }
  if (o.problems.empty()) throw ConfigError("--problems is missing; name a CSV of crossings");
  const auto problems = readProblems(o.problems, false, 0.3);
  const OutputFolder folder(o.output, o.overwrite);
  folder.writeConfiguration(visit);
  ThreadPool pool(o.threads);
  run.cpu_ms = [one = o.threads == 1] { return nowMs(one); };
  ProgressBar bar("crossing", o.quiet);
  std::string csv = "seed,planner,outcome,time_s,min_clearance_m,plan_ms_median,plan_ms_p95\n", json = "{\n";
  std::printf("  planner      goal contact timeout mean time s least clearance (m) plan ms median plan ms p95\n");
  double done = 0;
  for (const auto& name : names) {
    BandPlanner planner(named(params, name));
    if (o.threads > 1) planner.useThreads([&](int n, const auto& f) { pool.run(n, f); });
    std::vector<CrossingRow> rows;
    for (const auto& problem : problems) {
      if (interrupted()) break;
      rows.push_back(checkedRun(problem, run, planner));
      csv += csvLine(rows.back(), name);
      bar.update(++done / static_cast<double>(problems.size() * names.size()));
    }
    json += (json.size() > 2 ? ",\n" : "") + summary(rows, name);
  }
  folder.writeText("results.csv", csv);
  folder.writeText("metrics.json", json + "\n}\n");
  return interrupted() ? ExitCode::kInterrupted : ExitCode::kDone;
}

}  // namespace

void addCrossingCommand(CLI::App& app, Work& work) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("crossing", "drive through people that cross, in a closed loop");
  sub->add_option("--problems", o->problems, "seed,i,x,y,vx,vy: discs of 0.3 m; robot from (0,0,0) to (10,0)")
      ->type_name("FILE");
  sub->add_option("--planner", o->planner, "one or more of teb, pteb, eteb, eteb-printed, pteb+eteb, with commas")
      ->type_name("LIST")
      ->capture_default_str();
  sub->add_option("--threads", o->threads, "for the bands of a plan; the results are the same")
      ->check(CLI::Range(1, 64))
      ->type_name("N")
      ->capture_default_str();
  sub->add_option("-c,--config", o->config_file, "robot, prediction and planner (YAML)")->type_name("FILE");
  sub->add_option("-o,--output", o->output, "output folder")->type_name("DIR")->capture_default_str();
  sub->add_flag("-w,--overwrite", o->overwrite, "write into a folder that holds something");
  sub->add_flag("-q,--quiet", o->quiet, "no progress bar");
  sub->add_flag("--write-config", o->write_config, "print all parameters as commented YAML and exit");
  sub->footer(
      "Makes results.csv, metrics.json, effective.yaml, command.txt.\n"
      "Example:\n"
      "  sidestep-plan crossing --problems share/problems/crossing.csv --planner eteb -o out-crossing");
  sub->callback([o, &work] { work = [o] { return runAll(*o); }; });
}

}  // namespace sidestep
