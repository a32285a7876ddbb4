// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/reading.h"

namespace sidestep {

const std::vector<std::string>& kindWords() {
  static const std::vector<std::string> words{"odometry", "imu",  "gps",          "beacons",  "landmarks",
                                              "laser",    "rgbd", "ground_truth", "estimate", "other"};
  return words;
}

std::string word(SensorKind kind) { return kindWords()[static_cast<size_t>(kind)]; }

}  // namespace sidestep
