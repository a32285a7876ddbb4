// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/obs_frwds.h>

#include <deque>
#include <string>

#include "datasets/log_writer.h"

namespace sidestep {

/// A log of input and estimates in time order, though an estimate comes only with the next odometry, and the first of
/// them late: where the robot starts may take minutes to find. The input is held back until the estimates have reached
/// it, up to 64 MiB; beyond that it goes out, the estimates after it.
class OrderedLog {
 public:
  OrderedLog(const std::string& file, const std::string& header);
  void input(double time_s, const mrpt::obs::CObservation& observation);
  void estimate(double time_s, const mrpt::obs::CObservation& observation);
  void close();

 private:
  struct Held {
    double time_s;
    std::string bytes;
  };
  void releaseUntil(double time_s);

  LogWriter log_;
  std::deque<Held> held_;
  size_t held_bytes_ = 0;
};

}  // namespace sidestep
