// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/alignment.h"

#include "localization/sensors/gps.h"

namespace sidestep {
namespace {

bool frameIsKnown(const LocalizeConfig& config, SensorFrame frame) {
  switch (frame) {
    case SensorFrame::kMap:
      return true;
    case SensorFrame::kGeodetic:
      return config.robot.of<GpsParams>().datum_given;
    case SensorFrame::kSurveyed:
      return config.truth_frame_given;
    case SensorFrame::kNone:
      break;
  }
  return false;
}

}  // namespace

Alignment alignmentFor(const LocalizeConfig& config, const std::vector<SensorUse>& used) {
  if (config.align == "none") return Alignment::kNone;
  if (config.align == "first") return Alignment::kFirstPose;
  if (config.align == "se2") return Alignment::kLeastSquares;
  bool told_positions = false;
  for (const auto& row : sensors()) {
    if (row.frame == SensorFrame::kNone || !wasUsed(used, row.kind)) continue;
    if (frameIsKnown(config, row.frame)) return Alignment::kNone;
    told_positions = true;
  }
  return told_positions ? Alignment::kLeastSquares : Alignment::kFirstPose;
}

}  // namespace sidestep
