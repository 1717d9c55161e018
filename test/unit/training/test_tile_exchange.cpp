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

/// Numbers whose sum, as float or double, depends on the order in which they are added up: 4 in that of the tiles.
double numberOf(int tile) {
  const std::vector<double> values = {1e20, 1.0, -1e20, 1.0, 3.0};
  return values[static_cast<std::size_t>(tile)];
}

Eigen::VectorXf gradientOf(int tile) { return Eigen::VectorXf::Constant(2, static_cast<float>(numberOf(tile))); }

TEST(TileExchange, AllRanksGetWhatOneProcessGets) {
  const auto outcome = [](int threads) {
    return [threads](Communicator* communicator) {
      const TileExchange exchange(communicator, threads);
      const auto work = [](int tile, int) { return Sum{numberOf(tile), {1.0 * tile, 2.0 * tile}}; };
      const Sum sum = exchange.run(kTiles, Sum{0.0, {0.0, 0.0}}, work);
      const std::vector<double> numbers = {sum.steps, sum.by_kind[0], sum.by_kind[1]};
      return std::make_pair(numbers, exchange.sumOf(kTiles, 2, gradientOf));
    };
  };
  const auto alone = outcome(1)(oneProcess());
  EXPECT_EQ(alone.first, (std::vector<double>{4.0, 10.0, 20.0}));
  EXPECT_EQ(alone.second, Eigen::VectorXf::Constant(2, 4.0f));
  for (const int ranks : {1, 2, 3, 6}) {
    for (const auto& result : onRanks(ranks, outcome(2))) {
      EXPECT_EQ(result.first, alone.first) << ranks << " ranks";
      EXPECT_EQ(result.second, alone.second) << ranks << " ranks";
    }
  }
}

}  // namespace
}  // namespace lstm_planner::test_tile_exchange
