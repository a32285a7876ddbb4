// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace sidestep {

/// A few threads that share the calls of one loop.
class ThreadPool {
 public:
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// Runs f(0) .. f(n - 1); returns when all are done.
  void run(int n, const std::function<void(int)>& f);

 private:
  void work();
  void share();

  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable wake_, done_;
  const std::function<void(int)>* f_ = nullptr;
  std::atomic<int> next_ = 0;
  int count_ = 0, round_ = 0, busy_ = 0;
  bool ending_ = false;
};

}  // namespace sidestep
