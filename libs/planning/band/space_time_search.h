// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "planning/band/band.h"
#include "planning/band/obstacle_view.h"

namespace sidestep {

/// A drive among what moves, found in space and time: the last resort of exploration, where no way that is laid out
/// beforehand ever becomes clear.
///
/// Breadth first, half a second a layer. A state is a pose, a speed and a turn rate; each of the two stays or changes
/// by one level, which is what the accelerations allow, so that whatever is found can be driven. Of all states of a
/// layer that share a small cell of position, heading and speeds, the one nearest to the goal stays, and of these the
/// `states_max` that are nearest to it. From each the goal is tried straight on.
class SpaceTimeSearch {
 public:
  struct Query {
    mrpt::math::TPose2D start;
    mrpt::math::TPoint2D goal;
    BandEnds ends;
    RobotLimits limits;
    double keep_out_m = 0.4;  ///< least distance of the robot's centre to the edge of anything
    double horizon_s = 30;    ///< later arrivals are none
    int states_max = 1000;    ///< of a layer
    int work_max = 60000;     ///< of all layers
    double cell_m = 0.1;      ///< states nearer to each other than that compete,
    int headings = 24;        ///< in each of so many directions; at most 256
    GridBounds bounds;        ///< not left
    const ObstacleView* obstacles = nullptr;
    const std::function<bool()>* stop = nullptr;  ///< asked once a layer
  };

  /// Offers each drive that it comes upon, one a layer, as a band with poses every half second, until `accept` takes
  /// one.
  /// @return whether it did; `out` is then that band
  template <class Accept>
  bool search(const Query& query, Band& out, Accept&& accept) {
    start(query);
    for (int layer = 0; grow(query, layer); ++layer) {
      const int arrived = arrival(query, layer);
      if (arrived < 0) continue;
      trace(query, arrived, out);
      if (accept(out)) return true;
    }
    return false;
  }

  /// States that were laid, for the caller to count.
  size_t work() const { return states_.size(); }

 private:
  static constexpr double kStep_s = 0.5;
  struct State {
    double x = 0, y = 0, theta = 0;
    double left = 0;       ///< estimate of the time to the goal [s]
    int16_t v = 0, w = 0;  ///< levels
    int from = -1;
  };
  /// Where a step leads from the origin, half of it and all.
  struct Step {
    double x_half, y_half, x, y, theta, c, s;
  };

  void start(const Query& query);
  /// Lays the states of a layer; @return whether there are any
  bool grow(const Query& query, int layer);
  int arrival(const Query& query, int layer) const;
  void setLevels(const Query& query);
  void tabulateSteps();
  const Step& stepOf(int v, int w, int dv, int dw) const {
    return steps_[static_cast<size_t>((((v - v_low_) * (2 * w_most_ + 1) + w + w_most_) * 3 + dv + 1) * 3 + dw + 1)];
  }
  void layMap(const Query& query);
  void stamp(const Query& query, double t, std::vector<uint8_t>& map) const;
  bool clear(const Query& query, double x, double y, const std::vector<uint8_t>& map) const;
  void growFrom(const Query& query, size_t first, size_t last);
  void keep(const Query& query, const State& s);
  void thin(int most, size_t first);
  bool straightOn(const Query& query, const State& s, double t) const;
  void trace(const Query& query, int state, Band& out) const;

  int v_low_ = 0, v_most_ = 1, w_most_ = 1;
  double v_step_ = 0.25, w_step_ = 0.25;
  std::vector<Step> steps_;
  int columns_ = 0, rows_ = 0;
  std::vector<uint8_t> still_, half_, full_;
  std::vector<State> states_;     ///< layer by layer
  std::vector<uint64_t> keys_;    ///< hash table of cells,
  std::vector<uint32_t> stamps_;  ///< hash table: cell, and the layer that it is of
  std::vector<int> held_;
  std::vector<size_t> first_;  ///< state of each layer, and behind the last
};

}  // namespace sidestep
