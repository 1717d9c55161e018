#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "lstm_planner/training/tile_exchange.hpp"
#include "unit/training/thread_ranks.hpp"

namespace lstm_planner::test_tile_exchange {
namespace {

/// A number, and some more.
struct Sum {
  double steps = 0.0;
  std::vector<double> by_kind;
};
std::vector<double*> numbersOf(Sum* sum) {
  std::vector<double*> numbers = {&sum->steps};
  for (double& number : sum->by_kind) numbers.push_back(&number);
  return numbers;
}

constexpr int kTiles = 5;

/// A gradient whose sum depends on the order in which it is added up.
Eigen::VectorXf gradientOf(int tile) {
  const std::vector<float> values = {1e8f, 1.0f, -1e8f, 1.0f, 3.0f};
  return Eigen::VectorXf::Constant(2, values[static_cast<std::size_t>(tile)]);
}

TEST(TileExchange, AllRanksGetWhatOneProcessGets) {
  const auto outcome = [](int threads) {
    return [threads](Communicator* communicator) {
      const TileExchange exchange(communicator, threads);
      std::vector<double> numbers;
      const auto work = [](int tile, int) { return Sum{tile + 0.5, {1.0 * tile, 2.0 * tile}}; };
      for (Sum& sum : exchange.each(kTiles, Sum{0.0, {0.0, 0.0}}, work)) {
        for (const double* number : numbersOf(&sum)) numbers.push_back(*number);
      }
      return std::make_pair(numbers, exchange.sumOf(kTiles, 2, gradientOf));
    };
  };
  const auto alone = outcome(1)(oneProcess());
  EXPECT_EQ(alone.first.size(), 3u * kTiles);
  EXPECT_EQ(alone.second, Eigen::VectorXf::Constant(2, 4.0f)) << "in the order of the tiles";
  for (const int ranks : {1, 2, 3, 6}) {
    for (const auto& result : onRanks(ranks, outcome(2))) {
      EXPECT_EQ(result.first, alone.first) << ranks << " ranks";
      EXPECT_EQ(result.second, alone.second) << ranks << " ranks";
    }
  }
}

}  // namespace
}  // namespace lstm_planner::test_tile_exchange
