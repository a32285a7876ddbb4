// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/params.h"
#include "evaluation/study/study_runner.h"
#include "evaluation/study/study_statement.h"

namespace sidestep {

/// One row of the matrix: a scenario, or one x of a scenario that is run over an axis.
struct StudyRow {
  std::string name;     ///< the entry's, with `@x` where it has an axis
  std::string group;    ///< rows that share a figure, and the worlds of their runs
  std::string axis;     ///< what x is
  size_t scenario = 0;  ///< index of the entry
  std::optional<double> x;
};

/// A study: scenarios x algorithms x runs, what to measure, what is known of it, and what is expected.
class Study {
 public:
  /// @throws ConfigError / DatasetError with file, line and key.
  static Study read(const std::string& file);

  void visit(ParamVisitor& v);
  /// Keeps only the scenarios that match one of the patterns (`*` for any characters).
  /// @throws ConfigError for a pattern that matches none.
  void keepScenarios(const std::vector<std::string>& patterns);
  /// For fewer runs than the study's own, whose expectations say nothing of them.
  void dropExpectations() { parsed_expect_.clear(); }
  /// Loads what the runs need. @throws see StudyRunner::prepare
  void prepare(bool load_data = true);

  const std::vector<StudyRow>& rows() const { return rows_; }
  const std::vector<std::string>& algorithms() const { return algorithms_; }
  const std::vector<StudyStatement>& references() const { return parsed_references_; }
  const std::vector<StudyStatement>& expectations() const { return parsed_expect_; }
  /// Metrics to report, in order: those of `metrics`, or all of the kind.
  std::vector<std::string> reportedMetrics() const;
  const StudyRunner& runner() const { return *runner_; }
  StudyPlace place(size_t row, size_t algorithm, size_t run) const;
  /// The number of runs in the whole matrix, and of one: rows, then algorithms, then runs count.
  size_t size() const { return rows_.size() * algorithms_.size() * static_cast<size_t>(runs); }

  std::string kind = "localization", title, about, baseline;
  int seed = 1, runs = 20;
  std::vector<std::string> metrics, figures, pictures, medians;

 private:
  void check() const;
  void layOut();

  std::string file_;
  struct Scenario {
    std::string group, axis;
    std::vector<std::string> x;
  };
  std::vector<std::string> scenarios_, algorithms_, references_, expect_;
  std::vector<Scenario> entries_;
  std::vector<bool> kept_;
  std::vector<StudyRow> rows_;
  std::vector<StudyStatement> parsed_references_, parsed_expect_;
  std::shared_ptr<StudyRunner> runner_;
};

/// A 64-bit number of a text, the same on every machine (FNV-1a).
uint64_t textHash(const std::string& text);

}  // namespace sidestep
