// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "core/errors.h"

namespace sidestep {

/// What the command line says.
struct RawlogOptions {
  std::string log;
  std::string output, script;
  std::vector<std::string> labels;  ///< "kind=label"
  bool json = false, quiet = false, overwrite = false;
};

/// Prints what the log holds. @return kDone, or kInputCorrupt if it is damaged or cut short.
ExitCode showLog(const RawlogOptions& options);
/// The verdict and its reasons only.
ExitCode checkLog(const RawlogOptions& options);
/// Writes what can be read of the log to `output`. @return kInputCorrupt if that is nothing.
ExitCode recoverDamagedLog(const RawlogOptions& options);
/// Writes the log to `output` with what `script` does to it.
ExitCode degradeLog(const RawlogOptions& options);

}  // namespace sidestep
