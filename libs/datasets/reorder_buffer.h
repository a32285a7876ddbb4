// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <queue>
#include <vector>

#include "core/reading.h"

namespace sidestep {

/// Puts entries into time order, holding each back until one that is `window_s` newer has come.
///
/// A stamp more than a minute ahead is believed only when two more follow it there: one stray stamp would otherwise
/// make the rest of the log look late. Bounded in entries and bytes: when full, the oldest leaves early.
class ReorderBuffer {
 public:
  using Refuse = std::function<void(const Reading&, const char* reason)>;
  /// @param refuse is told of "backward stamp" (earlier than what has left) and "stray stamp".
  ReorderBuffer(double window_s, Refuse refuse) : window_s_(window_s), refuse_(std::move(refuse)) {}

  void push(Reading entry, size_t bytes);
  /// No more will come.
  void finish();
  std::optional<Reading> pop();

 private:
  struct Held {
    Reading entry;
    uint64_t index;
    size_t bytes;
  };
  struct Later {
    bool operator()(const Held& a, const Held& b) const {
      return a.entry.time_s != b.entry.time_s ? a.entry.time_s > b.entry.time_s : a.index > b.index;
    }
  };

  void hold(Held held);
  void release(double up_to_s);
  void dropAhead();
  void acceptAhead();

  double window_s_;
  Refuse refuse_;
  std::priority_queue<Held, std::vector<Held>, Later> held_;
  std::vector<Held> ahead_;  ///< more than a minute ahead, not yet believed
  std::deque<Reading> ready_;
  size_t held_bytes_ = 0;
  uint64_t arrivals_ = 0;
  bool any_ = false;
  double newest_s_ = 0;
  double left_s_ = 0;  ///< stamp of the last one that left
};

}  // namespace sidestep
