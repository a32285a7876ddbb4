// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

namespace sidestep {

/// One line of a file of recorded people.
struct TrackRow {
  double time_s = 0, x = 0, y = 0;
};

/// Reads a CSV of t,id,x,y [s, -, m, m], with or without a heading line, in any order.
/// @return rows by id, in time order
/// @throws DatasetError missing, or corrupt (file:line, what is wrong), also for two places of one id at one time.
std::map<int, std::vector<TrackRow>> readTracks(const std::string& file);

}  // namespace sidestep
