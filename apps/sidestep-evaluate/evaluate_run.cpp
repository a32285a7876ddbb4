// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-evaluate/evaluate_run.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "common/program.h"
#include "evaluation/metrics/metrics_json.h"
#include "evaluation/study/study_consistency.h"
#include "evaluation/study/study_figures.h"
#include "evaluation/study/study_quantiles.h"
#include "evaluation/study/study_report.h"
#include "evaluation/study/study_runs.h"
#include "evaluation/study/study_summary.h"

namespace sidestep {
namespace {

double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Study studyFor(const EvaluateOptions& o, bool load_data = true) {
  if (o.study.empty())
    throw ConfigError("no STUDY given; for example sidestep-evaluate share/studies/table-3.1-3.2.yaml");
  Study study = Study::read(o.study);
  if (o.seed) study.seed = *o.seed;
  const bool fewer = o.runs && *o.runs < study.runs;
  if (o.runs) study.runs = *o.runs;
  study.keepScenarios(o.scenarios);
  if (fewer) study.dropExpectations();
  study.prepare(load_data);
  return study;
}

/// Without comments and the number of runs: a study may be resumed with more of them.
std::string identity(const std::string& yaml) {
  std::string out, line;
  std::istringstream in(yaml);
  while (std::getline(in, line))
    if (!line.starts_with("#") && !line.starts_with("runs:")) out += line + "\n";
  return out;
}

class Evaluation {
 public:
  explicit Evaluation(const EvaluateOptions& options)
      : options_(options),
        study_(studyFor(options)),
        parameters_(writeYaml([this](ParamVisitor& v) { study_.visit(v); })),
        folder_(options.output, options.overwrite || options.resume) {
    checkResume();
    folder_.writeConfiguration([this](ParamVisitor& v) { study_.visit(v); });
    runs_ = std::make_unique<RunsFile>(study_, folder_.file("runs.csv"), options.resume);
  }
  ExitCode go();

 private:
  void checkResume() const;
  void run();
  void save();
  std::string metricsText(const std::vector<ExpectationResult>& expectations) const;
  ReportFacts facts() const;

  const EvaluateOptions& options_;
  Study study_;
  std::string parameters_;
  OutputFolder folder_;
  std::unique_ptr<RunsFile> runs_;
  std::vector<SummaryLine> lines_;
  std::vector<ExpectationResult> expectations_;
  double begin_s_ = steadySeconds();
};

void Evaluation::checkResume() const {
  const auto file = folder_.file("effective.yaml");
  if (!options_.resume || !std::filesystem::exists(file)) return;
  std::ifstream in(file, std::ios::binary);
  const std::string before{std::istreambuf_iterator<char>(in), {}};
  if (identity(before) != identity(parameters_))
    throw ConfigError(folder_.file("") + ": was made by another study or with other parameters; " +
                      "give another --output, or --overwrite without --resume");
}

void Evaluation::run() {
  ProgressBar bar("evaluating", options_.quiet);
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  runMatrix(study_, *runs_, options_.jobs > 0 ? options_.jobs : cores, interrupted,
            [&](size_t done, size_t all) { bar.update(static_cast<double>(done) / static_cast<double>(all)); });
}

ReportFacts Evaluation::facts() const {
  ReportFacts f;
  f.command = commandLine();
  f.parameters = parameters_;
  f.runs_all = study_.size();
  f.runs_done = runs_->runs().size();
  std::set<std::string> told;
  for (const auto& r : runs_->runs()) {
    if (r.status == "done") continue;
    ++f.runs_failed;
    const std::string line = study_.rows()[r.row].name + ", " + study_.algorithms()[r.algorithm] + ": " + r.status;
    if (told.insert(line).second) f.failures.push_back(line);
  }
  return f;
}

std::string Evaluation::metricsText(const std::vector<ExpectationResult>& expectations) const {
  const ReportFacts f = facts();
  nlohmann::ordered_json json;
  json["study"] = study_.title;
  json["seed"] = study_.seed;
  json["runs"] = f.runs_all;
  json["finished"] = f.runs_done;
  json["failed"] = f.runs_failed;
  json["failures"] = f.failures;
  json["partial"] = f.runs_done < f.runs_all;
  json["wall_s"] = steadySeconds() - begin_s_;
  json["peak_memory_mb"] = peakMemoryMb();
  json["expectations"] = nlohmann::ordered_json::array();
  for (const auto& e : expectations)
    json["expectations"].push_back({{"expected", e.text}, {"seen", e.seen}, {"met", e.met}});
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void tellFailures(const std::vector<StudyFigure>& figures) {
  for (const auto& figure : figures)
    if (!figure.failure.empty())
      std::fprintf(stderr, "sidestep-evaluate: %s: could not be drawn: %s\n", figure.file.c_str(),
                   figure.failure.c_str());
}

void Evaluation::save() {
  runs_->finish();
  lines_ = summarizeRuns(study_, runs_->runs());
  folder_.writeText("summary.csv", summaryCsv(lines_));
  const bool whole = runs_->runs().size() == study_.size();
  if (whole) expectations_ = checkExpectations(study_, lines_);
  const auto quantiles = quantilesOfRuns(study_, runs_->runs());
  folder_.writeText("quantiles.csv", quantilesCsv(quantiles));
  const auto consistency = consistencyOf(lines_);
  if (!consistency.empty()) folder_.writeText("consistency.csv", consistencyCsv(consistency));
  const auto figures = drawStudy(study_, lines_, medianLines(study_, quantiles), folder_.file(""));
  tellFailures(figures);
  ReportFacts f = facts();
  f.more_tables = quantilesHtml(study_, quantiles) + consistencyHtml(consistency);
  folder_.writeText("report.html", reportHtml(study_, lines_, expectations_, figures, folder_.file(""), f));
  folder_.writeText("metrics.json", metricsText(expectations_));
}

ExitCode Evaluation::go() {
  run();
  save();
  std::fputs(summaryTable(study_, lines_).c_str(), stdout);
  for (const auto& line : facts().failures) std::fprintf(stderr, "sidestep-evaluate: %s\n", line.c_str());
  if (runs_->runs().size() < study_.size()) {
    std::fprintf(stderr, "sidestep-evaluate: interrupted after %zu of %zu runs; --resume goes on from there\n",
                 runs_->runs().size(), study_.size());
    return ExitCode::kInterrupted;
  }
  ExitCode code = ExitCode::kDone;
  for (const auto& e : expectations_) {
    if (e.met) continue;
    std::fprintf(stderr, "sidestep-evaluate: missed: %s: %s\n", e.text.c_str(), e.seen.c_str());
    code = ExitCode::kThresholdMissed;
  }
  return code;
}

}  // namespace

ExitCode evaluate(const EvaluateOptions& options) {
  if (options.write_config) {
    Study study;
    if (!options.study.empty()) study = studyFor(options, false);
    std::fputs(writeYaml([&](ParamVisitor& v) { study.visit(v); }).c_str(), stdout);
    return ExitCode::kDone;
  }
  return Evaluation(options).go();
}

}  // namespace sidestep
