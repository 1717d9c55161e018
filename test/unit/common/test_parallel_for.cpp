#include <gtest/gtest.h>
#include <pthread.h>

#include <cstddef>
#include <stdexcept>
#include <vector>

#include "lstm_planner/common/parallel_for.hpp"

namespace lstm_planner::test_parallel_for {
namespace {

constexpr int kCount = 100;
constexpr int kThreads = 4;

/// While it lives, a new thread wants more memory for its stack than there are addresses.
class NoMoreThreads {
 public:
  NoMoreThreads() {
    pthread_getattr_default_np(&before_);
    pthread_attr_t attributes;
    pthread_getattr_default_np(&attributes);
    pthread_attr_setstacksize(&attributes, std::size_t{1} << 56);
    pthread_setattr_default_np(&attributes);
    pthread_attr_destroy(&attributes);
  }
  ~NoMoreThreads() {
    pthread_setattr_default_np(&before_);
    pthread_attr_destroy(&before_);
  }
  NoMoreThreads(const NoMoreThreads&) = delete;
  NoMoreThreads& operator=(const NoMoreThreads&) = delete;

 private:
  pthread_attr_t before_;
};

std::vector<int> callsOfEach() {
  std::vector<int> calls(kCount);
  parallelFor(kCount, kThreads, [&](int index, int thread) {
    EXPECT_LT(thread, kThreads);
    ++calls[static_cast<std::size_t>(index)];
  });
  return calls;
}

TEST(ParallelFor, CallsForEveryIndexOnce) { EXPECT_EQ(callsOfEach(), std::vector<int>(kCount, 1)); }

TEST(ParallelFor, WorksInFewerThreadsWhereTheSystemGivesNoMore) {
  const NoMoreThreads none;
  EXPECT_EQ(callsOfEach(), std::vector<int>(kCount, 1));
}

TEST(ParallelFor, RethrowsWhatAThreadThrows) {
  const auto work = [](int index, int) {
    if (index == kCount / 2) throw std::invalid_argument("half");
  };
  EXPECT_THROW(parallelFor(kCount, kThreads, work), std::invalid_argument);
}

TEST(ParallelSum, AddsUpInTheOrderOfTheIndices) {
  // A 1 that is added to 1e20 is lost: the sum depends on the order.
  const std::vector<double> values = {1e20, 1.0, -1e20, 1.0, 3.0};
  const auto work = [&](int index, int) { return values[static_cast<std::size_t>(index)]; };
  for (const int threads : {1, 2, 9}) EXPECT_EQ(parallelSum(5, threads, 0.0, work), 4.0) << threads;
  EXPECT_EQ(parallelSum(0, 2, 7.0, work), 7.0);
}

}  // namespace
}  // namespace lstm_planner::test_parallel_for
