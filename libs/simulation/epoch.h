// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sidestep {

/// Unix time at which all simulated runs begin [s]: no clock is read, so that the same run gives the same bytes.
inline constexpr double kSimulationStart_s = 1.6e9;

}  // namespace sidestep
