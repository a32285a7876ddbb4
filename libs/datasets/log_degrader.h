// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "core/reading.h"
#include "datasets/degrade_script.h"

namespace sidestep {

/// Does to a log, observation by observation, what a script says. What it changes it copies first, so that the entries
/// pushed in may be shared. The same script and entries give the same result; an event draws from a random stream of
/// its own, so that adding one leaves the others as they were.
class LogDegrader {
 public:
  using Sink = std::function<void(const Reading&)>;
  /// @throws ConfigError as DegradeScript::check.
  LogDegrader(const DegradeScript& script, Sink sink);
  ~LogDegrader();

  /// Entries in time order; the sink gets them in time order too, delayed ones later.
  /// @throws ConfigError if an event wants of a class of observations what that does not hold.
  void push(const Reading& entry);
  /// Gives out what is still delayed.
  void finish();

  struct EventCount {
    std::string name;
    uint64_t met = 0;  ///< observations within its window and zone
    uint64_t hit = 0;  ///< of these, changed or dropped
  };
  std::vector<EventCount> counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sidestep
