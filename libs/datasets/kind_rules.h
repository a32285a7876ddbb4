// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/reading.h"

namespace sidestep {

/// Says what each label of a log is for. Without an option, one label a kind serves: the one that is the kind's word,
/// else the first seen; other labels of the class are kOther.
class KindRules {
 public:
  /// @param labels kind word -> label, see LogReaderOptions.
  /// @throws ConfigError for a word that is no kind.
  explicit KindRules(const std::map<std::string, std::string>& labels);
  /// Also gives the observation's label: its own, or the kind's word if it has none.
  SensorKind classify(const mrpt::obs::CObservation& observation, std::string& label);

 private:
  SensorKind byClass(const mrpt::obs::CObservation& observation) const;
  bool serves(SensorKind kind, const std::string& label);

  std::map<SensorKind, std::string> named_;   ///< by the options
  std::map<SensorKind, std::string> chosen_;  ///< at first sight
};

/// "kind=label" words, as a command line gives them, by kind. @throws ConfigError
std::map<std::string, std::string> labelMap(const std::vector<std::string>& words);

}  // namespace sidestep
