// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "localization/pose_filter.h"

namespace sidestep {

/// Rauch-Tung-Striebel smoothing (1965) of a whole log: keeps what a filter went through, then walks back.
///
/// x_k|n = x_k + C (x_k+1|n - x_k+1|k),  P_k|n = P_k + C (P_k+1|n - P_k+1|k) C',  C = P_k F' P_k+1|k^-1
///
/// Memory: one state of the filter a step (12 numbers with 3 states, 75 with 8), linear in the log, unlike the filter.
class Smoother {
 public:
  /// The state at the start; forgets all before.
  void start(double time_s, const std::vector<double>& state);
  void motion(double time_s, const MotionStep& step, const std::vector<double>& state_after);
  /// @param opened  by how much the covariance was opened for it, 1 = not
  void correction(double time_s, double opened, const std::vector<double>& state_after);

  /// Beliefs given the whole log, at times that steps ended at; each of the last step at or before its time.
  /// @param filter   of the kind that made the states; it is left in another state
  /// @param times_s  in time order
  /// @throws Error if the filter has no smoother
  std::vector<PoseBelief> beliefs(PoseFilter& filter, const std::vector<double>& times_s) const;

 private:
  struct Step {
    double time_s;
    bool is_motion;
    MotionStep motion;
    double opened;
  };
  void push(const Step& step, const std::vector<double>& state);
  void stateAt(size_t i, std::vector<double>& out) const;

  size_t size_ = 0;  // of a state
  std::vector<Step> steps_;
  std::vector<double> states_;
};

}  // namespace sidestep
