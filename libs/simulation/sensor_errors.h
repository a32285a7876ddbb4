// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstdint>
#include <string>

#include "core/params.h"
#include "core/random.h"

namespace sidestep {

/// A sensor's time to speak: true at the first of evenly spaced instants that `time_s` has reached.
class SampleClock {
 public:
  /// @param rate_hz 0: never
  explicit SampleClock(double rate_hz) : rate_hz_(rate_hz) {}
  /// To be asked with growing times.
  bool due(double time_s) {
    const double ticks = rate_hz_ * time_s;
    if (rate_hz_ <= 0 || ticks + 1e-6 < static_cast<double>(next_)) return false;
    next_ = static_cast<int64_t>(ticks + 1e-6) + 1;
    return true;
  }

 private:
  double rate_hz_;
  int64_t next_ = 1;
};

/// A zero-mean error that stays alike for a while: first-order Gauss-Markov, E[e(t) e(t+s)] = sd^2 exp(-|s| / tau).
class CorrelatedError {
 public:
  CorrelatedError(double sd, double correlation_s) : sd_(sd), correlation_s_(correlation_s) {}
  /// The error `dt_s` after the last call. With tau = 0 each call is independent.
  double step(double dt_s, Random& random) {
    if (sd_ <= 0) return 0;
    const double keep = started_ && correlation_s_ > 0 ? std::exp(-dt_s / correlation_s_) : 0;
    started_ = true;
    return value_ = keep * value_ + sd_ * std::sqrt(1 - keep * keep) * random.gaussian();
  }

 private:
  double sd_, correlation_s_, value_ = 0;
  bool started_ = false;
};

/// Wheel encoders. `v` and `w` of the motion get white noise, become the ways of two wheels, which slip and whose true
/// size and track are not quite what the robot thinks, and are counted in whole ticks:
///
///   s_L = ((v + n_v) - (w + n_w) L' / 2) dt (1 + slip_L) / c_L,  s_R likewise with +      (2.2) inverted
///
/// with n_v, n_w as the Q of (3.16), L' = track_m * track_scale the true track and c_L, c_R the true wheel sizes by the
/// nominal ones. What the robot reads are the ways in ticks, put together with the nominal track L.
struct EncoderParams {
  double v_sd = 0.1, w_sd = 0.26172504656604804;  // m/s, rad/s: diag(0.01, 0.0685)
  double track_m = 0.4;
  double track_scale = 1, left_scale = 1, right_scale = 1;
  double tick_m = 0;  // m a tick, 0: not counted
  double slip_mean = 0, slip_sd = 0, slip_correlation_s = 1;

  void visit(ParamVisitor& v);
};

class EncoderModel {
 public:
  EncoderModel(const EncoderParams& params, Random random);

  struct Reading {
    double distance_m = 0, turn_rad = 0;
    int64_t left_ticks = 0, right_ticks = 0;
  };
  /// What is read after a true way and turn within `dt_s` > 0.
  Reading step(double dt_s, double distance_m, double turn_rad);

 private:
  double wheel(double way_m, double scale, CorrelatedError& slip, double dt_s);

  EncoderParams params_;
  Random random_;
  CorrelatedError left_slip_, right_slip_;
  double left_way_ = 0, right_way_ = 0;
  int64_t left_ticks_ = 0, right_ticks_ = 0;
};

/// An IMU's heading, yaw + offset + drift t + white noise, and its gyro, rate * scale + bias + white noise + a bias
/// that walks.
struct ImuErrorParams {
  double rate_hz = 100;
  double heading_sd = 0.26172504656604804;                       // rad: 0.0685 of (3.17)
  double heading_offset = 0;                                     // rad
  double heading_drift = 0;                                      // rad/s
  double heading_correlated_sd = 0, heading_correlation_s = 10;  // rad, s
  double gyro_sd = 0;                                            // rad/s, of one reading
  double gyro_bias = 0;                                          // rad/s
  double gyro_bias_walk = 0;                                     // rad/s/sqrt(s)
  double gyro_scale = 1;

  void visit(ParamVisitor& v);
};

class ImuModel {
 public:
  ImuModel(const ImuErrorParams& params, Random random);
  bool due(double time_s) { return clock_.due(time_s); }

  struct Reading {
    double yaw = 0, yaw_rate = 0;
  };
  /// @return yaw in [-pi, pi)
  Reading read(double time_s, double yaw, double yaw_rate);

 private:
  ImuErrorParams params_;
  Random random_;
  SampleClock clock_;
  CorrelatedError heading_error_;
  double last_s_ = 0, bias_;
};

/// A GPS: true position + white noise + an error that stays alike for minutes; nothing within outages.
struct GpsErrorParams {
  double rate_hz = 10;
  double sd_m = 1;  // (3.17)
  double correlated_sd_m = 0, correlation_s = 60;
  std::string output = "latlon";
  double datum_lat_deg = 21.0051, datum_lon_deg = 105.8456, datum_height_m = 10;
  Table outages;  // from, to [s]

  void visit(ParamVisitor& v);
};

class GpsErrorModel {
 public:
  GpsErrorModel(const GpsErrorParams& params, Random random);
  bool due(double time_s) { return clock_.due(time_s); }
  bool inOutage(double time_s) const;

  struct Reading {
    double x = 0, y = 0;
  };
  Reading read(double time_s, double x, double y);

 private:
  const GpsErrorParams* params_;
  Random random_;
  SampleClock clock_;
  CorrelatedError x_error_, y_error_;
  double last_s_ = 0;
};

}  // namespace sidestep
