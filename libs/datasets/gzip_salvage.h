// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sidestep {

/// A stretch [begin, end) of uncompressed bytes without a break in it.
struct IntactRange {
  uint64_t begin = 0;
  uint64_t end = 0;
};

/// All bytes of a gzip file that can still be had.
struct SalvagedBytes {
  std::vector<IntactRange> ranges;  ///< of the output file
  uint64_t skipped = 0;             ///< compressed bytes that could not be inflated
};

/// Inflates `in` into `out`. After damage goes on at the next place where nothing before is needed: a full flush (00 00
/// FF FF) or the next gzip member.
/// @throws DatasetError if `in` cannot be read or `out` not be written.
SalvagedBytes salvageGzip(const std::string& in, const std::string& out);

/// Whether the file begins as gzip files do. @throws DatasetError (missing) if it cannot be read.
bool isGzip(const std::string& file);

}  // namespace sidestep
