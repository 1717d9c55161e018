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

}  // namespace
}  // namespace lstm_planner::test_parallel_for
