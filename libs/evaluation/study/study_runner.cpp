// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/study_runner.h"

#include <functional>
#include <map>

#include "core/errors.h"
#include "evaluation/experiments/laser_runner.h"
#include "evaluation/experiments/localization_runner.h"
#include "evaluation/experiments/world_runner.h"

namespace sidestep {
namespace {

using Maker = std::function<std::unique_ptr<StudyRunner>(const std::string&)>;

const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> table = {
      {"laser", makeLaserRunner}, {"localization", makeLocalizationRunner}, {"world", makeWorldRunner}};
  return table;
}

}  // namespace

const std::vector<std::string>& studyKinds() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> out;
    for (const auto& [word, maker] : makers()) out.push_back(word);
    return out;
  }();
  return words;
}

std::unique_ptr<StudyRunner> makeStudyRunner(const std::string& kind, const std::string& study_file) {
  const auto it = makers().find(kind);
  if (it == makers().end()) throw ConfigError(study_file + ": kind = " + kind + " is no kind of study");
  return it->second(study_file);
}

}  // namespace sidestep
