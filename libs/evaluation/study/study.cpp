// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/study.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/errors.h"
#include "core/random.h"

namespace sidestep {
namespace {

/// Names stand in CSV cells and in statements of words.
void checkName(const std::string& name, const std::string& where) {
  static const std::string allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./=";
  if (name.empty() || name.find_first_not_of(allowed) != std::string::npos)
    throw ConfigError(where + " '" + name + "': a name is of letters, digits and _-+./=");
}

double toNumber(const std::string& text, const std::string& where) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw ConfigError(where + ": '" + text + "' is not a number");
  return value;
}

[[noreturn]] void unknown(const std::string& where, const std::string& what, const std::string& word,
                          const std::vector<std::string>& known) {
  const auto near = nearestWord(word, known);
  throw ConfigError(where + ": '" + word + "' is no " + what + (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

uint64_t textHash(const std::string& text) {
  uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

Study Study::read(const std::string& file) {
  Study study;
  study.file_ = file;
  readYaml(file, [&](ParamVisitor& v) { study.visit(v); });
  study.kept_.assign(study.scenarios_.size(), true);
  study.layOut();
  study.check();
  return study;
}

void Study::visit(ParamVisitor& v) {
  v.choice("kind", kind, studyKinds(), "what is run");
  if (!runner_) runner_ = makeStudyRunner(kind, file_);
  v.text("title", title, "headline of the report");
  v.text("about", about, "what the study shows");
  v.integer("seed", seed, {0, 2e9}, "of all random numbers");
  v.integer("runs", runs, {1, 1e6}, "runs of each scenario with each algorithm");
  v.text("baseline", baseline, "algorithm that the others are compared with, run by run; empty: none");
  v.texts("metrics", metrics, "metrics that the tables show; empty: all");
  v.texts("figures", figures, "metrics that figures show");
  v.texts("medians", medians, "metrics of which tables and figures show the median and quantiles too");
  v.texts("pictures", pictures, "algorithms whose first run of each scenario is drawn");
  v.groups("scenarios", scenarios_, "what is run through", [this](const std::string& name, ParamVisitor& w) {
    const auto i = static_cast<size_t>(std::find(scenarios_.begin(), scenarios_.end(), name) - scenarios_.begin());
    if (entries_.size() <= i) entries_.resize(i + 1);
    w.text("group", entries_[i].group,
           "scenarios of a group share a figure and the worlds of their runs; empty: the name");
    w.text("axis", entries_[i].axis, "what is varied over the values of x");
    w.texts("x", entries_[i].x, "values on that axis, one row of the matrix each");
    runner_->visitScenario(i, w);
  });
  v.groups("algorithms", algorithms_, "what is compared", [this](const std::string& name, ParamVisitor& w) {
    const auto i = static_cast<size_t>(std::find(algorithms_.begin(), algorithms_.end(), name) - algorithms_.begin());
    runner_->visitAlgorithm(i, w);
  });
  v.texts("references", references_, "published numbers: SCENARIO ALGORITHM METRIC = NUMBER");
  v.texts("expect", expect_, "what must hold: SCENARIO ALGORITHM METRIC[.STATISTIC] <= NUMBER");
}

void Study::layOut() {
  rows_.clear();
  for (size_t i = 0; i < scenarios_.size(); ++i) {
    if (!kept_[i]) continue;
    const auto& e = entries_[i];
    const std::string group = e.group.empty() ? scenarios_[i] : e.group;
    if (e.x.empty()) rows_.push_back({scenarios_[i], group, "", i, std::nullopt});
    for (const auto& x : e.x)
      rows_.push_back(
          {scenarios_[i] + "@" + x, group, e.axis, i, toNumber(x, file_ + ": scenarios." + scenarios_[i] + ".x")});
  }
  parsed_references_.clear();
  parsed_expect_.clear();
  for (const auto& line : references_) parsed_references_.push_back(parseStatement(line, file_ + ": references"));
  for (const auto& line : expect_) parsed_expect_.push_back(parseStatement(line, file_ + ": expect"));
  if (std::find(kept_.begin(), kept_.end(), false) == kept_.end()) return;
  // What is said of scenarios that are left out is left out.
  std::erase_if(parsed_expect_, [this](const StudyStatement& s) {
    return std::none_of(rows_.begin(), rows_.end(),
                        [&](const StudyRow& r) { return matchesPattern(s.scenario, r.name); });
  });
}

void Study::check() const {
  for (size_t i = 0; i < scenarios_.size(); ++i) {
    checkName(scenarios_[i], file_ + ": scenarios");
    const auto& e = entries_[i];
    const std::string where = file_ + ": scenarios." + scenarios_[i];
    if (e.axis.empty() != e.x.empty()) throw ConfigError(where + ": axis and x belong together");
    if (!e.axis.empty() && !contains(runner_->axes(), e.axis))
      unknown(where + ".axis", "axis", e.axis, runner_->axes());
  }
  for (const auto& name : algorithms_) checkName(name, file_ + ": algorithms");
  for (const auto& row : rows_)
    if (std::count_if(rows_.begin(), rows_.end(), [&](const auto& r) { return r.name == row.name; }) > 1)
      throw ConfigError(file_ + ": scenarios: '" + row.name + "' is there twice");
  const auto known = namesOf(runner_->metrics());
  for (const auto& m : metrics)
    if (!contains(known, m)) unknown(file_ + ": metrics", "metric of kind " + kind, m, known);
  for (const auto& m : figures)
    if (!contains(known, m)) unknown(file_ + ": figures", "metric of kind " + kind, m, known);
  for (const auto& m : medians)
    if (!contains(known, m)) unknown(file_ + ": medians", "metric of kind " + kind, m, known);
  for (const auto& a : pictures)
    if (!contains(algorithms_, a)) unknown(file_ + ": pictures", "algorithm of this study", a, algorithms_);
  if (!baseline.empty() && !contains(algorithms_, baseline))
    unknown(file_ + ": baseline", "algorithm of this study", baseline, algorithms_);
  const auto checkStatement = [&](const StudyStatement& s, const std::string& where) {
    if (!contains(known, s.metric)) unknown(where + " '" + s.text + "'", "metric of kind " + kind, s.metric, known);
    for (const auto& row : rows_)
      for (const auto& algorithm : algorithms_)
        if (s.matches(row.name, algorithm)) return;
    std::vector<std::string> names;
    for (const auto& row : rows_) names.push_back(row.name);
    names.insert(names.end(), algorithms_.begin(), algorithms_.end());
    const auto near = nearestWord(s.scenario, names);
    throw ConfigError(where + " '" + s.text + "': matches no scenario and algorithm of the study" +
                      (near.empty() || near == s.scenario ? "" : "; did you mean '" + near + "'?"));
  };
  for (const auto& s : parsed_references_) {
    checkStatement(s, file_ + ": references");
    if (s.comparison != "=" || s.statistic != "mean")
      throw ConfigError(file_ + ": references '" + s.text + "': write it as SCENARIO ALGORITHM METRIC = NUMBER");
  }
  for (const auto& s : parsed_expect_) checkStatement(s, file_ + ": expect");
}

void Study::keepScenarios(const std::vector<std::string>& patterns) {
  kept_.assign(scenarios_.size(), patterns.empty());
  for (const auto& pattern : patterns) {
    bool any = false;
    for (size_t i = 0; i < scenarios_.size(); ++i)
      if (matchesPattern(pattern, scenarios_[i])) kept_[i] = any = true;
    if (!any) unknown(file_, "scenario of this study", pattern, scenarios_);
  }
  layOut();
}

void Study::prepare(bool load_data) {
  if (load_data && scenarios_.empty()) throw ConfigError(file_ + ": scenarios: the study names none");
  if (load_data && algorithms_.empty()) throw ConfigError(file_ + ": algorithms: the study names none");
  std::vector<std::string> names, axes;
  for (size_t i = 0; i < scenarios_.size(); ++i) {
    names.push_back(kept_[i] ? scenarios_[i] : "");
    axes.push_back(entries_[i].axis);
  }
  runner_->prepare(names, axes, algorithms_, load_data);
}

std::vector<std::string> Study::reportedMetrics() const {
  return metrics.empty() ? namesOf(runner_->metrics()) : metrics;
}

StudyPlace Study::place(size_t row, size_t algorithm, size_t run) const {
  const StudyRow& r = rows_[row];
  StudyPlace p{r.scenario, r.x, algorithm, 0, 0};
  // By name, not by number: a scenario more or less leaves the other runs as they are.
  Random world(static_cast<uint64_t>(seed), textHash(r.group) + run);
  p.world_seed = world.bits();
  Random own(p.world_seed, textHash(algorithms_[algorithm]));
  p.algorithm_seed = own.bits();
  return p;
}

}  // namespace sidestep
