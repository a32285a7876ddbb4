// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/batch/thread_pool.h"

namespace sidestep {

ThreadPool::ThreadPool(int threads) {
  for (int k = 1; k < threads; ++k) threads_.emplace_back([this] { work(); });
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  for (auto& thread : threads_) thread.join();
}

void ThreadPool::share() {
  for (int k = next_++; k < count_; k = next_++) (*f_)(k);
}

void ThreadPool::run(int n, const std::function<void(int)>& f) {
  {
    const std::lock_guard lock(mutex_);
    f_ = &f;
    count_ = n;
    next_ = 0;
    busy_ = static_cast<int>(threads_.size());
    ++round_;
  }
  wake_.notify_all();
  share();
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
}

void ThreadPool::work() {
  int seen = 0;
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return ending_ || round_ != seen; });
    if (ending_) return;
    seen = round_;
    lock.unlock();
    share();
    lock.lock();
    if (--busy_ == 0) done_.notify_one();
  }
}

}  // namespace sidestep
