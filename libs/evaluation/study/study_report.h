// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "evaluation/study/study_figures.h"
#include "evaluation/study/study_summary.h"

namespace sidestep {

/// What a report tells apart from the numbers.
struct ReportFacts {
  std::string command, parameters;  ///< the exact command line; effective.yaml
  size_t runs_done = 0, runs_failed = 0, runs_all = 0;
  std::vector<std::string> failures;  ///< scenario, algorithm, reason; each once
  std::string more_tables;            ///< HTML of further sections, before the figures
};

/// One HTML page without any other file: tables, figures (as base64), expectations, command and parameters.
/// @param folder  where the figures' PNG lie
std::string reportHtml(const Study& study, const std::vector<SummaryLine>& lines,
                       const std::vector<ExpectationResult>& expectations, const std::vector<StudyFigure>& figures,
                       const std::string& folder, const ReportFacts& facts);

/// Text with what HTML would read as its own written out.
std::string htmlEscaped(const std::string& text);
std::string base64(const std::string& bytes);

}  // namespace sidestep
