// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/study_statement.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/errors.h"
#include "core/params.h"

namespace sidestep {

const std::vector<std::string>& statisticWords() {
  static const std::vector<std::string> words = {"n",       "mean",      "sd",         "ci_low",
                                                 "ci_high", "reference", "difference", "p_value"};
  return words;
}

bool matchesPattern(const std::string& pattern, const std::string& text) {
  const auto star = pattern.find('*');
  if (star == std::string::npos) return pattern == text;
  if (text.compare(0, star, pattern, 0, star) != 0 || text.size() < star) return false;
  const std::string rest = pattern.substr(star + 1);
  for (size_t i = star; i <= text.size(); ++i)
    if (matchesPattern(rest, text.substr(i))) return true;
  return false;
}

bool StudyStatement::matches(const std::string& scenario_name, const std::string& algorithm_name) const {
  return matchesPattern(scenario, scenario_name) && matchesPattern(algorithm, algorithm_name);
}

bool StudyStatement::holds(double seen) const {
  if (std::isnan(seen)) return false;
  if (comparison == "<=") return seen <= value;
  if (comparison == ">=") return seen >= value;
  if (comparison == "<") return seen < value;
  if (comparison == ">") return seen > value;
  return seen == value;
}

StudyStatement parseStatement(const std::string& text, const std::string& where) {
  const auto fail = [&](const std::string& what) {
    throw ConfigError(where + " '" + text + "': " + what +
                      "; write it as SCENARIO ALGORITHM METRIC <= NUMBER (or =, >=, <, >)");
  };
  StudyStatement s;
  s.text = text;
  std::istringstream in(text);
  std::string number, rest;
  if (!(in >> s.scenario >> s.algorithm >> s.metric >> s.comparison >> number) || (in >> rest))
    fail("is not five words");
  static const std::vector<std::string> comparisons = {"<=", ">=", "<", ">", "="};
  if (std::find(comparisons.begin(), comparisons.end(), s.comparison) == comparisons.end())
    fail("'" + s.comparison + "' is no comparison");
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), s.value);
  if (error != std::errc() || end != number.data() + number.size() || !std::isfinite(s.value))
    fail("'" + number + "' is not a number");
  if (const auto dot = s.metric.find('.'); dot != std::string::npos) {
    s.statistic = s.metric.substr(dot + 1);
    s.metric.resize(dot);
  }
  const auto& words = statisticWords();
  if (std::find(words.begin(), words.end(), s.statistic) == words.end()) {
    const auto near = nearestWord(s.statistic, words);
    fail("'" + s.statistic + "' is no column of summary.csv" + (near.empty() ? "" : ", did you mean '" + near + "'?"));
  }
  return s;
}

}  // namespace sidestep
