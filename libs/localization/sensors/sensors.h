// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/param_sections.h"
#include "core/reading.h"
#include "localization/sensors/sensor_model.h"

namespace sidestep {

/// In which frame a sensor tells positions.
enum class SensorFrame {
  kNone,      ///< it tells none
  kGeodetic,  ///< east-north-up at a datum: gps
  kSurveyed,  ///< that of the surveyed places: beacons
  kMap        ///< the map's
};

/// A sensor as the table knows it. Its word for labels and options is that of its kind.
struct SensorRow {
  SensorKind kind;
  const char* about;            ///< one line, for lists and help
  const ParamSection* section;  ///< its parameters
  SensorFrame frame = SensorFrame::kNone;
  bool needs_map = false;                                 ///< of use only to filters that have a map
  bool (*tells_heading)(const ParamSections&) = nullptr;  ///< whether it may tell an absolute heading; null: never
  /// What the parameters lack for it, as an advice; "" if nothing; null: it needs nothing.
  std::string (*lacks)(const ParamSections&) = nullptr;
  std::unique_ptr<SensorModel> (*make)(const ParamSections&) = nullptr;
};

/// The table of all sensors that localization uses. Adding one: a file with its parameters and its model, a row in
/// sensors.cpp.
const std::vector<SensorRow>& sensors();
/// The row of a kind; null if localization does not use that kind.
const SensorRow* sensorOf(SensorKind kind);
/// "odometry, imu, ...": all sensors' words.
std::string sensorWords(const std::string& separator = ", ");
/// Parameters of all sensors.
ParamSections sensorParams();

/// A list of sensors' words. @param where  what named them, for the message
/// @throws ConfigError for one that is none, with the nearest known one.
void checkSensorWords(const std::vector<std::string>& words, const std::string& where);

}  // namespace sidestep
