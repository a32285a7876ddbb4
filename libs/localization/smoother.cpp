// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/smoother.h"

#include "core/errors.h"

namespace sidestep {

void Smoother::start(double time_s, const std::vector<double>& state) {
  steps_.clear();
  states_.clear();
  size_ = state.size();
  push({time_s, false, {}, 1}, state);
}

void Smoother::motion(double time_s, const MotionStep& step, const std::vector<double>& state_after) {
  push({time_s, true, step, 1}, state_after);
}

void Smoother::correction(double time_s, double opened, const std::vector<double>& state_after) {
  push({time_s, false, {}, opened}, state_after);
}

void Smoother::push(const Step& step, const std::vector<double>& state) {
  steps_.push_back(step);
  states_.insert(states_.end(), state.begin(), state.end());
}

void Smoother::stateAt(size_t i, std::vector<double>& out) const {
  const double* from = states_.data() + i * size_;
  out.assign(from, from + size_);
}

std::vector<PoseBelief> Smoother::beliefs(PoseFilter& filter, const std::vector<double>& times_s) const {
  std::vector<PoseBelief> out(times_s.size());
  if (steps_.empty()) return out;
  std::vector<double> smoothed, before, after;
  stateAt(steps_.size() - 1, smoothed);
  size_t wanted = times_s.size();
  for (size_t i = steps_.size(); i-- > 0;) {
    // A correction changes no state that is smoothed: `smoothed` is that of its moment, before and after.
    while (wanted > 0 && (times_s[wanted - 1] >= steps_[i].time_s || i == 0)) {
      filter.restore(smoothed);
      out[--wanted] = filter.estimate();
    }
    if (i == 0) break;
    stateAt(i - 1, before);
    if (!steps_[i].is_motion) {
      if (steps_[i].opened > 1) filter.smoothReset(before, steps_[i].opened, smoothed);
      continue;
    }
    stateAt(i, after);
    if (!filter.smoothBack(before, steps_[i].motion, after, smoothed))
      throw Error(ExitCode::kAlgorithmGaveUp,
                  "smoothing: this filter cannot be smoothed, or its numbers are not finite");
  }
  return out;
}

}  // namespace sidestep
