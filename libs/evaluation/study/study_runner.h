// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/params.h"
#include "evaluation/metrics/metric.h"

namespace sidestep {

/// One run's place in the matrix of a study.
struct StudyPlace {
  size_t scenario = 0;      ///< entry of the study's list of scenarios
  std::optional<double> x;  ///< the entry's value on the axis, if it has any
  size_t algorithm = 0;
  uint64_t world_seed = 0;      ///< same for all algorithms, and all scenarios of a group: they meet the same world
  uint64_t algorithm_seed = 0;  ///< of what the algorithm itself draws
};

/// A kind of study: what its scenarios and algorithms are, and how one run of them goes.
///
/// First the study's file shows `visitScenario` and `visitAlgorithm` the entries, scenarios first; `prepare` then loads
/// and checks; after that `run` is called from several threads at once and must depend on its place alone.
class StudyRunner {
 public:
  virtual ~StudyRunner() = default;
  /// Fields of the `index`-th scenario's (algorithm's) entry; an entry is made when it is first shown.
  virtual void visitScenario(size_t index, ParamVisitor& v) = 0;
  virtual void visitAlgorithm(size_t index, ParamVisitor& v) = 0;
  /// What the x of a scenario may stand for; checked by the study's reader.
  virtual std::vector<std::string> axes() const = 0;
  /// @throws ConfigError, DatasetError with one line that says which entry needs what.
  /// @param load_data  false: check the parameters only, recorded data need not be there
  virtual void prepare(const std::vector<std::string>& scenarios, const std::vector<std::string>& axes,
                       const std::vector<std::string>& algorithms, bool load_data) = 0;
  virtual const std::vector<MetricInfo>& metrics() const = 0;
  /// The values of `metrics()`, not finite where one is not defined. Throws if the run came to nothing.
  virtual std::vector<double> run(const StudyPlace& place) const = 0;
  /// Draws the run into `png_file`; false if this kind has no picture of it.
  virtual bool draw(const StudyPlace& place, const std::string& title, const std::string& png_file) const = 0;
  /// Draws runs of several algorithms over each other; false if this kind has no picture of that.
  /// @param names  of the algorithms, in the order of `places`
  virtual bool drawTogether(const std::vector<StudyPlace>& /*places*/, const std::vector<std::string>& /*names*/,
                            const std::string& /*title*/, const std::string& /*png_file*/) const {
    return false;
  }
};

/// Kinds of study by name: the one place to add a line to.
const std::vector<std::string>& studyKinds();
/// @param study_file  for messages, and because relative paths in it start at its folder
std::unique_ptr<StudyRunner> makeStudyRunner(const std::string& kind, const std::string& study_file);

}  // namespace sidestep
