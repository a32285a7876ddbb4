// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/obs_frwds.h>

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "localization/motion_source.h"
#include "localization/pose_filter.h"
#include "localization/scan.h"
#include "localization/sensor_models.h"
#include "localization/smoother.h"
#include "localization/start_alignment.h"

namespace sidestep {

/// Everything that turns a robot's sensors into a pose, apart from the filter.
struct LocalizerParams {
  OdometryParams odometry;
  ImuParams imu;
  GpsParams gps;
  BeaconParams beacons;
  ScanParams laser;
  StartParams start;
  double late_window_s = 2;
  double coast_after_s = 1;
  double coast_accel = 0.5;       // m/s^2
  double coast_turn_accel = 0.3;  // rad/s^2
  bool zero_velocity = true;

  void visit(ParamVisitor& v);
};

/// A pose at one instant, as told to the user.
struct Estimate {
  double time_s = 0;
  PoseBelief belief;                       ///< in the map frame
  mrpt::math::TPose2D odometry;            ///< odometry alone, from the same start [m, rad]
  std::optional<uint64_t> odometry_index;  ///< which odometry reading (0, 1, ...) this belongs to; none while coasting
  std::optional<double> lost_probability;  ///< of an error over 1 m, from filters that can tell
  std::vector<PoseMode> modes;             ///< now and then, if asked for and the filter can tell (PoseFilter::modes)
};

/// How far one measurement was from what the filter expected.
struct InnovationRecord {
  int stream = 0;
  double time_s = 0;
  double nis = 0;
  int dof = 0;
  bool accepted = false;
};

/// What became of one label's measurements.
struct SensorUse {
  std::string label;
  uint64_t read = 0, used = 0;
  std::map<std::string, uint64_t> refused;  ///< by reason
  double nis_sum = 0;                       ///< of Correction::nis_single
  uint64_t nis_count = 0;
  double nis_independent = 0;  ///< how many of those are worth one of their own; fewer if neighbouring errors are alike
  int nis_dof = 0;
};

/// What the sensors in use can tell of the start.
struct Expectation {
  bool positions = false;        ///< fixes will come: wait for them
  bool heading = false;          ///< so may the IMU's heading
  double heading_offset_sd = 0;  ///< how well that is known as the robot's [rad]
};

/// Feeds a filter from a robot's sensors: motion from odometry (and gyro), measurements at their own times.
///
/// Observations come in any order within `late_window_s`. A measurement that lies between two odometry readings splits
/// the motion; one that is late goes back to where it belongs and what followed is played again (cost: the steps of
/// the lateness); one that is ahead waits for odometry, and if none comes for `coast_after_s` the robot is taken to go
/// on as it did, with growing doubt. An estimate is given out for each odometry reading once the next one has come.
/// With a position sensor and no initial pose, the start is found from the first stretch of motion (StartAlignment).
class Localizer {
 public:
  Localizer(const LocalizerParams& params, std::unique_ptr<PoseFilter> filter, const Expectation& expect);

  /// A stream of measurements; the number goes with each observation.
  int addStream(const std::string& label);
  void odometry(int stream, double time_s, const mrpt::obs::CObservationOdometry& o);
  void imu(int stream, double time_s, const mrpt::obs::CObservationIMU& o);
  void gps(int stream, double time_s, const mrpt::obs::CObservationGPS& o);
  void position(int stream, double time_s, double x, double y);
  /// What an IMU says, as plain numbers: yaw [rad], yaw rate [rad/s].
  void heading(int stream, double time_s, double heading_rad);
  /// A fix and a heading of one instant as one measurement (3.14); once the robot's start is known.
  void positionHeading(int stream, double time_s, double x, double y, double heading_rad);
  void yawRate(int stream, double time_s, double rate);
  void beacons(int stream, double time_s, const mrpt::obs::CObservationBeaconRanges& o);
  void laser(int stream, double time_s, const mrpt::obs::CObservation2DRangeScan& o);
  /// No more observations come: what waits is processed.
  void finish();
  /// From now on estimates are held until `finish`, which smooths them by the whole log (Smoother: memory grows with
  /// it); `finish` throws Error if the filter has no smoother. To be called before the first observation.
  void smoothAtEnd() { smoother_.emplace(); }

  /// From now on innovations are kept for `takeInnovations`, and the modes of the filter go with an estimate each
  /// `modes_period_s` (0: never).
  void recordMore(double modes_period_s) {
    records_innovations_ = true;
    modes_period_s_ = modes_period_s;
  }

  /// Estimates that became ready since the last call, in time order.
  std::vector<Estimate> takeEstimates();
  const std::vector<SensorUse>& sensors() const { return sensors_; }
  bool started() const { return started_; }
  /// Fixes in the map frame since the last call, for the picture.
  std::vector<mrpt::math::TPoint2D> takeFixes();
  /// Innovations since the last call, each measurement once, in the order of corrections; nothing without `recordMore`.
  std::vector<InnovationRecord> takeInnovations();

 private:
  struct Event {
    bool is_motion = true;
    double time_s = 0;  ///< end of the motion, or time of the measurement
    MotionStep motion;
    Measurement measurement;
    bool counted = false;
    double opened = 1;  ///< by how much the correction opened the covariance
    std::vector<double> state_after;
  };
  void addHeading(int stream, double time_s, double heading_rad);
  void add(const Measurement& m);
  void place(const Measurement& m);
  void insertLate(const Measurement& m);
  void advanceTo(double time_s, const MotionStep& step);
  void appendMotion(double time_s, const MotionStep& step);
  void append(Event&& event);
  void apply(Event& event);
  void replayFrom(size_t index);
  void count(Event& event, const Correction& c);
  void refuse(int stream, const char* reason);
  void coastTo(double time_s);
  void owe(std::optional<uint64_t> odometry_index);
  void gapNoise(MotionStep& motion) const;
  void addStill(const MotionSource::Step& step, int stream);
  void giveOut();
  void tryStart(bool last_chance);
  void start(const StartBelief& s);
  void trimHistory();
  void tell(const Event& event);
  void smooth();
  SensorUse& use(int stream) { return sensors_[static_cast<size_t>(stream)]; }

  LocalizerParams params_;
  std::unique_ptr<PoseFilter> filter_;
  MotionSource motion_;
  GpsModel gps_;
  StartAlignment start_;
  std::vector<SensorUse> sensors_;
  std::deque<Event> history_;
  std::vector<Measurement> pending_;  // sorted by time
  std::vector<Estimate> ready_;
  std::vector<mrpt::math::TPoint2D> fixes_;
  std::vector<InnovationRecord> innovations_;
  bool records_innovations_ = false;
  double modes_period_s_ = 0, next_modes_s_ = 0;
  struct Waiting {
    MotionSource::Step step;
    uint64_t odometry_index;
  };
  std::deque<Waiting> waiting_;     // motion before the start is known
  std::vector<double> base_state_;  // state before history_.front()
  std::vector<std::vector<double>> spare_states_;
  double base_time_s_ = 0, now_s_ = 0, last_heading_s_ = 0;
  std::optional<Smoother> smoother_;
  MotionStep last_motion_;
  mrpt::math::TPose2D odometry_pose_;
  uint64_t odometry_count_ = 0;
  double first_odometry_s_ = 0;
  bool started_ = false;
  bool owed_ = false;  // an estimate at now_s_ has not been given out yet: measurements of this instant may still come
  std::optional<uint64_t> owed_index_;
};

}  // namespace sidestep
