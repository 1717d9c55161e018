#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
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

/// `zero` plus what work(index, thread) returns for every index in [0, count), from parallelFor(). Added up in the
/// order of the indices, so that rounding does not depend on the threads.
template <typename Sum, typename Work>
Sum parallelSum(int count, int threads, const Sum& zero, const Work& work) {
  std::vector<Sum> parts(static_cast<std::size_t>(count), zero);
  parallelFor(count, threads,
              [&](int index, int thread) { parts[static_cast<std::size_t>(index)] = work(index, thread); });
  Sum sum = zero;
  for (const Sum& part : parts) sum += part;
  return sum;
}

}  // namespace lstm_planner
