#include <gtest/gtest.h>

#include "lstm_planner/base/common/communicator.hpp"
#include "unit/base/learning/thread_ranks.hpp"

namespace lstm_planner::test_communicator {
namespace {

TEST(Communicator, SharesAreNeighboursOfEqualSizeGiveOrTakeOne) {
  for (int size = 1; size <= 7; ++size) {
    for (int count = 0; count <= 20; ++count) {
      int next = 0;
      for (int rank = 0; rank < size; ++rank) {
        const Share share = shareOf(count, rank, size);
        EXPECT_EQ(share.first, next);
        EXPECT_GE(share.count(), count / size);
        EXPECT_LE(share.count(), (count + size - 1) / size);
        next = share.last;
      }
      EXPECT_EQ(next, count);
    }
  }
}

TEST(Communicator, OneProcessDoesEverythingAndKeepsWhatItHas) {
  EXPECT_EQ(oneProcess()->rank(), 0);
  EXPECT_EQ(oneProcess()->size(), 1);
  std::vector<int> values = {1, 2, 3};
  exchangeShares(oneProcess(), 3, 1, values.data());
  EXPECT_EQ(values, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(largestOfRanks(oneProcess(), -3), -3);
}

TEST(Communicator, EveryRankGetsTheSharesOfAll) {
  const auto work = [](Communicator* ranks) {
    const Share own = shareOf(5, ranks->rank(), ranks->size());
    std::vector<int> values(10, -1);
    for (int i = 2 * own.first; i < 2 * own.last; ++i) values[static_cast<std::size_t>(i)] = i;
    exchangeShares(ranks, 5, 2, values.data());
    return values;
  };
  for (const int ranks : {2, 3, 7}) {  // 7: more ranks than there is work
    for (const std::vector<int>& values : onRanks(ranks, work)) {
      EXPECT_EQ(values, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
    }
  }
}

TEST(Communicator, AllRanksAgreeOnTheLargestNumber) {
  const auto largest = [](Communicator* ranks) { return largestOfRanks(ranks, ranks->rank() == 1 ? 15 : -1); };
  EXPECT_EQ(onRanks(3, largest), (std::vector<int>{15, 15, 15}));
}

}  // namespace
}  // namespace lstm_planner::test_communicator
