// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/obs_frwds.h>

#include <functional>
#include <string>

namespace sidestep {

/// Why an observation must not reach an algorithm: "not finite", "absurd value", "bad covariance", "no beams", "no
/// fix", "no range", "only bad ranges"; empty if it may. Single ranges of a set that are no ranges are taken out of it,
/// each told to `dropped`; beams of a scan that are not finite become invalid beams.
std::string screen(mrpt::obs::CObservation& observation, const std::function<void(const std::string& reason)>& dropped);

/// Why a stamp cannot be one: "no stamp", "future stamp"; empty if it can. `now_s`: Unix time [s].
std::string screenStamp(double time_s, double now_s);

}  // namespace sidestep
