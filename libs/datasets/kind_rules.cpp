// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/kind_rules.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <cctype>

#include "core/errors.h"
#include "core/params.h"
#include "datasets/log_reader.h"

namespace sidestep {
namespace {

SensorKind kindOf(const std::string& text) {
  const auto& words = kindWords();
  const auto at = std::find(words.begin(), words.end(), text);
  if (at != words.end()) return static_cast<SensorKind>(at - words.begin());
  const std::string near = nearestWord(text, words);
  throw ConfigError("label " + text + "=...: no such kind of sensor" +
                    (near.empty()
                         ? ", known: odometry, imu, gps, beacons, landmarks, laser, rgbd, ground_truth, estimate"
                         : ", did you mean " + near + "?"));
}

SensorKind poseKind(std::string label) {
  std::transform(label.begin(), label.end(), label.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const char* truth : {"ground_truth", "groundtruth", "gt", "truth"})
    if (label == truth) return SensorKind::kGroundTruth;
  return label == word(SensorKind::kEstimate) ? SensorKind::kEstimate : SensorKind::kOther;
}

bool isPose(const mrpt::obs::CObservation& observation) {
  return dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation) != nullptr;
}

}  // namespace

KindRules::KindRules(const std::map<std::string, std::string>& labels) {
  for (const auto& [text, label] : labels) named_[kindOf(text)] = label;
}

SensorKind KindRules::byClass(const mrpt::obs::CObservation& observation) const {
  const auto* o = &observation;
  if (dynamic_cast<const mrpt::obs::CObservationOdometry*>(o)) return SensorKind::kOdometry;
  if (dynamic_cast<const mrpt::obs::CObservationIMU*>(o)) return SensorKind::kImu;
  if (dynamic_cast<const mrpt::obs::CObservationGPS*>(o)) return SensorKind::kGps;
  if (dynamic_cast<const mrpt::obs::CObservationBeaconRanges*>(o)) return SensorKind::kBeacons;
  if (dynamic_cast<const mrpt::obs::CObservationBearingRange*>(o)) return SensorKind::kLandmarks;
  if (dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(o)) return SensorKind::kLaser;
  if (dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(o)) return SensorKind::kRgbd;
  return isPose(observation) ? poseKind(observation.sensorLabel) : SensorKind::kOther;
}

SensorKind KindRules::classify(const mrpt::obs::CObservation& observation, std::string& label) {
  const SensorKind kind = byClass(observation);
  label = observation.sensorLabel.empty() ? word(kind) : observation.sensorLabel;
  for (const auto& [named, name] : named_) {
    const bool pose_fits = isPose(observation) && (named == SensorKind::kGps || named == SensorKind::kGroundTruth ||
                                                   named == SensorKind::kEstimate);
    if (name == label && (named == kind || pose_fits)) return named;
  }
  return kind != SensorKind::kOther && serves(kind, label) ? kind : SensorKind::kOther;
}

bool KindRules::serves(SensorKind kind, const std::string& label) {
  if (named_.contains(kind)) return false;  // classify() has compared the label with it
  if (label == word(kind)) chosen_[kind] = label;
  return chosen_.try_emplace(kind, label).first->second == label;
}

std::map<std::string, std::string> labelMap(const std::vector<std::string>& words) {
  std::vector<std::string> kinds = kindWords();
  kinds.pop_back();  // other
  std::map<std::string, std::string> out;
  for (const auto& w : words) {
    const auto eq = w.find('=');
    if (eq == std::string::npos || eq + 1 == w.size())
      throw ConfigError("--label " + w + ": write it as kind=label, for example gps=GPS_RTK_REAR");
    const auto kind = w.substr(0, eq);
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
      const auto near = nearestWord(kind, kinds);
      throw ConfigError("--label " + w + ": '" + kind + "' is no kind of sensor" +
                        (near.empty() ? "" : "; did you mean '" + near + "'?"));
    }
    if (!out.emplace(kind, w.substr(eq + 1)).second)
      throw ConfigError("--label " + w + ": " + kind + " is given twice");
  }
  return out;
}

}  // namespace sidestep
