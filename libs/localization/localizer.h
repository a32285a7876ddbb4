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
#include "localization/sensors/sensors.h"
#include "localization/smoother.h"
#include "localization/start_alignment.h"

namespace sidestep {

/// Everything that turns a robot's sensors into a pose, apart from the filter.
struct LocalizerParams {
  ParamSections sensors = sensorParams();
  StartParams start;
  double late_window_s = 2;
  double coast_after_s = 1;
  double coast_accel = 0.5;       // m/s^2
  double coast_turn_accel = 0.3;  // rad/s^2
  bool zero_velocity = true;

  void visit(ParamVisitor& v);
  /// Parameters of one sensor, for example `of<GpsParams>()`.
  template <class Params>
  Params& of() {
    return sensors.of<Params>();
  }
  template <class Params>
  const Params& of() const {
    return sensors.of<Params>();
  }
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
  SensorKind kind = SensorKind::kOther;
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

/// What a localizer is told besides its parameters.
struct LocalizerSetup {
  Expectation start;
  std::vector<SensorKind> sensors;  ///< readings of other kinds are left out; empty: none are
  bool joins_instants = false;      ///< a fix and a heading of one instant are one measurement (3.14)
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
  Localizer(const LocalizerParams& params, std::unique_ptr<PoseFilter> filter, const LocalizerSetup& setup);
  ~Localizer();
  Localizer(Localizer&&) noexcept;

  /// The one door for sensors. Readings whose stamps lie within kInstant_s are of one instant: that of the odometry
  /// among them, else their own; their order does not matter. They are processed once a reading of another instant, or
  /// `finish`, comes.
  void observe(const Reading& reading);
  /// Nothing more of the present instant comes: processes it now.
  void completeInstant();
  /// No more observations come: what waits is processed.
  void finish();
  /// From now on estimates are held until `finish`, which smooths them by the whole log (Smoother: memory grows with
  /// it); `finish` throws Error if the filter has no smoother. To be called before the first observation.
  void smoothAtEnd() { smoother_.emplace(); }
  static constexpr double kInstant_s = 2e-5;

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
  struct Heard {
    Reading reading;
    SensorSays says;
    int stream = 0;
  };
  int streamOf(const Reading& reading);
  void joinInstant();
  void motion(const Heard& heard);
  void measurements(Heard& heard);
  void add(const Measurement& m);
  void place(const Measurement& m);
  void insertOutOfSequence(const Measurement& m);
  void advanceTo(double time_s, const MotionStep& step);
  void appendMotion(double time_s, const MotionStep& step);
  void append(Event&& event);
  void apply(Event& event);
  void replayFrom(size_t index);
  void count(Event& event, const Correction& c);
  void refuse(int stream, const char* reason);
  void coastTo(double time_s);
  void scheduleEstimate(std::optional<uint64_t> odometry_index);
  void gapNoise(MotionStep& motion) const;
  void addStill(const MotionSource::Step& step, int stream);
  void emitEstimate();
  void tryStart(bool last_chance);
  void start(const StartBelief& s);
  void trimHistory();
  void feedSmoother(const Event& event);
  void smooth();
  SensorUse& use(int stream) { return sensors_[static_cast<size_t>(stream)]; }

  LocalizerParams params_;
  std::unique_ptr<PoseFilter> filter_;
  MotionSource motion_;
  LocalizerSetup setup_;
  std::map<SensorKind, std::unique_ptr<SensorModel>> models_;
  std::map<std::pair<SensorKind, std::string>, int> streams_;
  std::vector<Heard> instant_;  // the first heard_ count: readings of the present instant
  size_t heard_ = 0;
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
  double base_time_s_ = 0, now_s_ = 0;
  std::optional<Smoother> smoother_;
  MotionStep last_motion_;
  mrpt::math::TPose2D odometry_pose_;
  uint64_t odometry_count_ = 0;
  double first_odometry_s_ = 0;
  bool started_ = false;
  bool scheduled_ =
      false;  // an estimate at now_s_ has not been given out yet: measurements of this instant may still come
  std::optional<uint64_t> scheduled_index_;
};

}  // namespace sidestep
