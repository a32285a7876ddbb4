// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <vector>

namespace sidestep {

/// One Rauch-Tung-Striebel step back over a state laid out as N numbers, then N x N of covariance; N <= 8, number 2 an
/// angle. Sizes are known at run time only, without memory from the heap: the fixed ones take a compiler minutes.
///
/// @param F         3 x N, the rows of the transition that differ from the identity
/// @param before    the filter's state before the motion
/// @param after     and after it
/// @param smoothed  the smoothed state after the motion, which becomes that before it
/// @return false, and `smoothed` as it was, if the result is not finite
bool smoothStep(const Eigen::Map<const Eigen::MatrixXd>& F, const std::vector<double>& before,
                const std::vector<double>& after, std::vector<double>& smoothed);

/// The same where nothing moved and the covariance was opened: P before, opened * P after.
void smoothReset(int n, const std::vector<double>& before, double opened, std::vector<double>& smoothed);

}  // namespace sidestep
