// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace sidestep {

/// A queue for whole keys that never fall below the last one taken, nor lie `kRange` above it: a ring of buckets, each
/// a stack. Of equal keys the last one pushed comes first, so a search goes on where it just was. (Dial 1969.)
class BucketQueue {
 public:
  static constexpr uint32_t kRange = 1u << 16;
  struct Entry {
    uint32_t key, value;
  };

  BucketQueue() { heads_.fill(kNone); }
  void clear(uint32_t first_key) {
    for (uint32_t word = 0; word < kWords; ++word)
      for (; words_[word] != 0; words_[word] &= words_[word] - 1)
        heads_[word * 64 + static_cast<uint32_t>(std::countr_zero(words_[word]))] = kNone;
    summary_.fill(0);
    pool_.clear();
    unused_ = kNone;
    now_ = first_key;
    count_ = 0;
  }
  bool empty() const { return count_ == 0; }
  void push(uint32_t key, uint32_t value) {
    const uint32_t bucket = key % kRange;
    uint32_t slot = unused_;
    if (slot == kNone) {
      slot = static_cast<uint32_t>(pool_.size());
      pool_.push_back({value, heads_[bucket]});
    } else {
      unused_ = pool_[slot].next;
      pool_[slot] = {value, heads_[bucket]};
    }
    heads_[bucket] = slot;
    words_[bucket / 64] |= uint64_t{1} << (bucket % 64);
    summary_[bucket / 4096] |= uint64_t{1} << (bucket / 64 % 64);
    ++count_;
  }
  /// The queue must not be empty.
  Entry pop() {
    const uint32_t bucket = nextBucket(now_ % kRange);
    now_ += (bucket - now_) % kRange;
    const uint32_t slot = heads_[bucket], value = pool_[slot].value;
    heads_[bucket] = pool_[slot].next;
    pool_[slot].next = unused_;
    unused_ = slot;
    if (heads_[bucket] == kNone) {
      words_[bucket / 64] &= ~(uint64_t{1} << (bucket % 64));
      if (words_[bucket / 64] == 0) summary_[bucket / 4096] &= ~(uint64_t{1} << (bucket / 64 % 64));
    }
    --count_;
    return {now_, value};
  }

 private:
  struct Node {
    uint32_t value, next;
  };
  static constexpr uint32_t kNone = UINT32_MAX, kWords = kRange / 64, kSummaries = kWords / 64;

  /// The first bucket with something in it, from `from` on around the ring.
  uint32_t nextBucket(uint32_t from) const {
    const uint64_t here = words_[from / 64] >> (from % 64);
    if (here != 0) return from + static_cast<uint32_t>(std::countr_zero(here));
    for (uint32_t word = from / 64 + 1;; word = (word / 64 + 1) * 64) {
      const uint64_t summary = summary_[word / 64 % kSummaries] >> (word % 64);
      if (summary == 0) continue;
      const uint32_t found = (word + static_cast<uint32_t>(std::countr_zero(summary))) % kWords;
      return found * 64 + static_cast<uint32_t>(std::countr_zero(words_[found]));
    }
  }

  std::array<uint32_t, kRange> heads_;
  std::array<uint64_t, kWords> words_{};
  std::array<uint64_t, kSummaries> summary_{};
  std::vector<Node> pool_;
  uint32_t unused_ = kNone, now_ = 0;
  size_t count_ = 0;
};

}  // namespace sidestep
