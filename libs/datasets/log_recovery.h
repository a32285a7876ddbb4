// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "datasets/decoder_child.h"

namespace sidestep {

/// What was got out of a damaged log.
struct RecoveryReport {
  uint64_t entries = 0;        ///< objects written
  uint64_t bytes = 0;          ///< uncompressed bytes of these
  uint64_t lost_bytes = 0;     ///< uncompressed bytes that belong to no whole object
  uint64_t skipped_bytes = 0;  ///< compressed bytes that could not even be inflated
  uint64_t breaks = 0;         ///< places where something is missing
  std::string first_damage;    ///< what the first was, in a few words; empty if the log was whole
};

/// Copies all whole objects of `in` to `out`, a log of our own with header and end marker: what lies before the damage,
/// and after it from the next object on that can be found. Logs that LogWriter wrote can be entered anew each second;
/// a gzip log of MRPT's only at its beginning.
/// @throws DatasetError if `in` cannot be read or `out` not be written.
RecoveryReport recoverLog(const std::string& in, const std::string& out, const DecodeLimits& limits = {});

/// Place of the first byte from `from` on that may begin an observation, action collection or sensory frame of a class
/// that is known; npos if there is none. Old class names without namespace too.
size_t findObject(std::string_view bytes, size_t from);

}  // namespace sidestep
