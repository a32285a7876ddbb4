// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "evaluation/study/study.h"

namespace sidestep {

/// One finished run.
struct StudyRun {
  size_t row = 0, algorithm = 0, run = 0;
  std::string status = "done";  ///< else why it came to nothing
  std::vector<double> values;   ///< of the runner's metrics; NaN where one is not defined
};

/// runs.csv: a row as soon as a run is finished, in that order; `finish` puts them into the order of the matrix.
class RunsFile {
 public:
  /// Opens `file`: with `resume` what is whole in it is taken over (and a row that was cut is dropped), else it is
  /// begun.
  /// @throws ConfigError if the file is not one of this study.
  RunsFile(const Study& study, const std::string& file, bool resume);
  ~RunsFile();
  RunsFile(const RunsFile&) = delete;
  RunsFile& operator=(const RunsFile&) = delete;

  const std::vector<StudyRun>& runs() const { return runs_; }
  bool has(size_t row, size_t algorithm, size_t run) const { return there_[index(row, algorithm, run)]; }
  /// @throws DatasetError if the disk is full.
  void add(StudyRun&& run);
  /// Sorts, and writes the file anew in one stroke.
  void finish();

 private:
  size_t index(size_t row, size_t algorithm, size_t run) const;
  std::string header() const;
  std::string line(const StudyRun& run) const;
  void takeOver(const std::string& text);
  bool parse(const std::string& line, StudyRun& run) const;

  const Study& study_;
  std::string name_;
  std::vector<std::string> metrics_;
  std::vector<StudyRun> runs_;
  std::vector<bool> there_;
  int file_ = -1;
};

/// Runs what of the matrix is missing in `file`, on `jobs` threads, until done or until `stop` says so.
/// @param progress  called with the number of runs that are finished and the number of all
void runMatrix(const Study& study, RunsFile& file, int jobs, const std::function<bool()>& stop,
               const std::function<void(size_t, size_t)>& progress);

}  // namespace sidestep
