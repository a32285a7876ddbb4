// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/reorder_buffer.h"

#include <algorithm>
#include <limits>

namespace sidestep {
namespace {
constexpr double kJump_s = 60;
constexpr size_t kBelieved = 3;
constexpr size_t kMostEntries = 20000;
constexpr size_t kMostBytes = 256u << 20;
constexpr double kAlways = std::numeric_limits<double>::infinity();
}  // namespace

void ReorderBuffer::push(Reading entry, size_t bytes) {
  Held held{std::move(entry), arrivals_++, bytes};
  if (any_ && held.entry.time_s > newest_s_ + kJump_s) {
    ahead_.push_back(std::move(held));
    if (ahead_.size() >= kBelieved) acceptAhead();
    return;
  }
  if (!ahead_.empty()) dropAhead();
  hold(std::move(held));
}

void ReorderBuffer::hold(Held held) {
  if (any_ && held.entry.time_s < left_s_) return refuse_(held.entry, "backward stamp");
  newest_s_ = any_ ? std::max(newest_s_, held.entry.time_s) : held.entry.time_s;
  if (!any_) left_s_ = -kAlways;
  any_ = true;
  held_bytes_ += held.bytes;
  held_.push(std::move(held));
  release(newest_s_ - window_s_);
}

void ReorderBuffer::release(double up_to_s) {
  while (!held_.empty() &&
         (held_.top().entry.time_s <= up_to_s || held_.size() > kMostEntries || held_bytes_ > kMostBytes)) {
    left_s_ = held_.top().entry.time_s;
    held_bytes_ -= held_.top().bytes;
    ready_.push_back(held_.top().entry);
    held_.pop();
  }
}

void ReorderBuffer::dropAhead() {
  for (const Held& held : ahead_) refuse_(held.entry, "stray stamp");
  ahead_.clear();
}

void ReorderBuffer::acceptAhead() {
  release(kAlways);
  std::vector<Held> ahead = std::move(ahead_);
  ahead_.clear();
  std::stable_sort(ahead.begin(), ahead.end(), [](const Held& a, const Held& b) { return Later()(b, a); });
  for (Held& held : ahead) hold(std::move(held));
}

void ReorderBuffer::finish() {
  if (!ahead_.empty()) acceptAhead();
  release(kAlways);
}

std::optional<Reading> ReorderBuffer::pop() {
  if (ready_.empty()) return {};
  Reading entry = std::move(ready_.front());
  ready_.pop_front();
  return entry;
}

}  // namespace sidestep
