// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "evaluation/study/study_summary.h"

namespace sidestep {

struct StudyFigure {
  std::string file, title;  ///< PNG in the output folder
  std::string failure;      ///< why there is no such file; empty: it is there
};

/// Draws the study's figures into `folder`: for each metric of `figures` bars with 95 % intervals and the published
/// numbers, or, for rows on an axis, curves with 95 % bands, one figure a group; for each algorithm of `pictures` the
/// first run of each scenario. Same results, same bytes.
/// A figure that cannot be drawn has its `failure`, and the others are drawn.
/// @param medians  lines whose mean is a median (medianLines), drawn as further figures
std::vector<StudyFigure> drawStudy(const Study& study, const std::vector<SummaryLine>& lines,
                                   const std::vector<SummaryLine>& medians, const std::string& folder);

}  // namespace sidestep
