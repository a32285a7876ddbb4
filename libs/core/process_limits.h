// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Limits for a child process that decodes what may be damaged: MRPT believes all lengths and counts of a file.
#pragma once
#include <cstddef>

namespace sidestep {

/// From now on this process gets at most `bytes` more of address space, then allocations fail; it leaves no core file.
/// Relative to what is mapped already, which under a sanitizer are terabytes of shadow.
void limitMemory(size_t bytes);

/// CPU time [s] after which the kernel ends this process (SIGPROF, default action); 0: no limit.
void limitCpuTime(double seconds);

}  // namespace sidestep
