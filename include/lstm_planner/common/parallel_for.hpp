#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace lstm_planner {

/// Calls work(index, thread) once for every index in [0, count), in up to `threads` threads, which are numbered from 0:
/// in fewer where the system gives no more. Returns when all calls have returned; rethrows the first exception.
template <typename Work>
void parallelFor(int count, int threads, const Work& work) {
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto run = [&](int thread) {
    try {
      for (int index = next++; index < count; index = next++) work(index, thread);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(failure_mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  std::vector<std::thread> helpers;
  try {
    for (int thread = 1; thread < std::min(threads, count); ++thread) helpers.emplace_back(run, thread);
  } catch (const std::system_error&) {
    // Those that there are do the work.
  }
  run(0);
  for (std::thread& helper : helpers) helper.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace lstm_planner
