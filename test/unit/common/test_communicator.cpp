#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "lstm_planner/common/communicator.hpp"
#include "lstm_planner/common/parallel_for.hpp"
#include "unit/training/thread_ranks.hpp"

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

TEST(Communicator, EachTicketGoesToOneOfTheRanksAndTheirThreads) {
  constexpr std::size_t kTickets = 1000;
  const auto draw = [](Communicator* ranks) {
    const std::unique_ptr<Tickets> tickets = ranks->tickets(kTickets);
    std::vector<std::vector<std::size_t>> drawn(3);
    parallelFor(3, 3, [&](int part, int) {
      for (std::size_t i = tickets->draw(); i < kTickets; i = tickets->draw()) {
        drawn[static_cast<std::size_t>(part)].push_back(i);
      }
    });
    std::vector<std::size_t> own;
    for (const auto& part : drawn) own.insert(own.end(), part.begin(), part.end());
    return gatherFromRanks(ranks, own);
  };
  std::vector<std::size_t> all(kTickets);
  std::iota(all.begin(), all.end(), std::size_t{0});
  for (const int ranks : {1, 3}) {
    for (std::vector<std::size_t> drawn : onRanks(ranks, draw)) {
      std::sort(drawn.begin(), drawn.end());
      EXPECT_EQ(drawn, all);
    }
  }
  std::vector<std::size_t> drawn = draw(oneProcess());
  std::sort(drawn.begin(), drawn.end());
  EXPECT_EQ(drawn, all);
}

TEST(Communicator, WhatRanksGatherMayBeOfDifferentSizes) {
  const auto gather = [](Communicator* ranks) {
    return gatherFromRanks(ranks, std::vector<int>(static_cast<std::size_t>(ranks->rank()), 10 + ranks->rank()));
  };
  for (const std::vector<int>& values : onRanks(3, gather)) EXPECT_EQ(values, (std::vector<int>{11, 12, 12}));
}

}  // namespace
}  // namespace lstm_planner::test_communicator
