#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "lstm_planner/grid_world/agent/grid_escape.hpp"
#include "lstm_planner/grid_world/search/grid_distances.hpp"
#include "unit/grid_world/agent/small_grids.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_grid_escape {
namespace {

/// Some possible move, or kNoPath when shut in.
using Policy = std::function<int(const GridObservation&, CornerCutting)>;

int randomMove(const GridObservation& observation, CornerCutting corner_cutting, std::mt19937* random) {
  int possible[kGridMoveCount];
  std::uint32_t count = 0;
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    if (movePossible(observation.ranges, direction, corner_cutting)) possible[count++] = direction;
  }
  return count == 0 ? kNoPath : possible[(*random)() % count];
}

int farthestMove(const GridObservation& observation, CornerCutting corner_cutting) {
  int farthest = kNoPath;
  OctileDistance distance;
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    if (!movePossible(observation.ranges, direction, corner_cutting)) continue;
    const OctileDistance there = octileDistance(cellBeside(observation.cell, direction), observation.goal);
    if (farthest == kNoPath || distance < there) {
      farthest = direction;
      distance = there;
    }
  }
  return farthest;
}

/// A policy with the escape behind it.
class EscapingAgent : public GridAgent {
 public:
  EscapingAgent(const GridEscapeParameters& parameters, Policy policy)
      : corner_cutting_(parameters.boundary.corner_cutting), escape_(parameters), policy_(std::move(policy)) {}

  void start(CellIndex, CellIndex) override { escape_.start(); }
  void observe(const GridObservation& observation) override {
    escape_.observe(observation);
    if (escape_.active()) {
      direction_ = escape_.decide();
      return;
    }
    direction_ = policy_(observation, corner_cutting_);
  }
  int decide() override { return direction_; }
  GridLeader leader() const override { return escape_.active() ? GridLeader::kBoundary : GridLeader::kGreedy; }
  std::size_t peakBytes() const override { return escape_.peakBytes(); }
  const GridEscape& escape() const { return escape_; }

 private:
  CornerCutting corner_cutting_;
  GridEscape escape_;
  Policy policy_;
  int direction_ = kNoPath;
};

class GridEscapeWith : public testing::TestWithParam<std::tuple<CornerCutting, int, double>> {
 protected:
  void expectCertain(const std::function<Policy(std::uint32_t seed)>& policy) {
    GridEscapeParameters parameters;
    parameters.boundary.corner_cutting = std::get<0>(GetParam());
    parameters.boundary.first_leg = 8.0;
    parameters.patience = std::get<1>(GetParam());
    parameters.margin = std::get<2>(GetParam());
    for (std::uint32_t seed = 0; seed < 2000; ++seed) {
      const SmallGrid world = smallGrid(seed);
      const GridDistances distances(world.grid, world.goal, parameters.boundary.corner_cutting);
      const bool reachable = std::isfinite(distances.at(world.start));
      EscapingAgent agent(parameters, policy(seed));
      // Each of fewer than 400 distances costs the patience and a path along boundaries at most.
      const std::size_t most_steps = 400 * (static_cast<std::size_t>(parameters.patience) + 20 * world.grid.size());
      ASSERT_EQ(walk(world, &agent, parameters.boundary.corner_cutting, most_steps).end,
                reachable ? WalkEnd::kArrived : WalkEnd::kNoPath)
          << "seed " << seed;
    }
  }
};

TEST_P(GridEscapeWith, APolicyAtRandomArrivesOrProvesThatThereIsNoPath) {
  expectCertain([](std::uint32_t seed) -> Policy {
    auto random = std::make_shared<std::mt19937>(seed);
    return [random](const GridObservation& observation, CornerCutting corner_cutting) {
      return randomMove(observation, corner_cutting, random.get());
    };
  });
}

TEST_P(GridEscapeWith, APolicyThatFleesTheGoalArrivesOrProvesThatThereIsNoPath) {
  expectCertain([](std::uint32_t) -> Policy { return farthestMove; });
}

INSTANTIATE_TEST_SUITE_P(Patience, GridEscapeWith,
                         testing::Combine(testing::Values(CornerCutting::kForbidden, CornerCutting::kAllowed),
                                          testing::Values(1, 30), testing::Values(0.0, 3.0)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param) == CornerCutting::kAllowed ? "Cutting"
                                                                                                 : "Keeping") +
                                  "CornersPatience" + std::to_string(std::get<1>(info.param)) +
                                  (std::get<2>(info.param) > 0.0 ? "GoalWeighted" : "");
                         });

TEST(GridEscape, LetsAnAgentGoThatKeepsGettingNearer) {
  GridEscapeParameters parameters;
  parameters.patience = 1;
  GridEscape escape(parameters);
  escape.start();
  for (int column = 0; column < 10; ++column) {
    escape.observe({{column, 0}, {9, 0}, {}});
    EXPECT_FALSE(escape.active()) << "column " << column;
  }
}

TEST(GridEscape, TakesOverWhenItsPatienceEndsAndHandsBackNearerThanEver) {
  const SmallGrid world = drawnGrid({"......", "S.##.G", "......"});
  GridEscapeParameters parameters;
  parameters.patience = 4;
  GridEscape escape(parameters);
  escape.start();
  const auto observe = [&](CellIndex cell) { escape.observe({cell, world.goal, senseRanges(world.grid, cell)}); };
  observe({1, 1});
  for (const CellIndex cell : {CellIndex{0, 1}, CellIndex{0, 0}, CellIndex{0, 1}}) {
    observe(cell);
    EXPECT_FALSE(escape.active());
  }
  CellIndex cell = {0, 0};
  observe(cell);
  ASSERT_TRUE(escape.active());
  while (escape.active()) {
    cell = cellBeside(cell, escape.decide());
    observe(cell);
  }
  EXPECT_TRUE(octileDistance(cell, world.goal) < octileDistance({1, 1}, world.goal));
}

TEST(GridEscape, WaitsLongerWhileAnAgentFindsNewPlacesButNotForEver) {
  GridEscapeParameters parameters;
  parameters.patience = 2;
  parameters.long_patience = 10;
  GridEscape escape(parameters);
  escape.start();
  for (int column = 20; column < 30; ++column) {
    escape.observe({{column, 0}, {0, 0}, {}}, true);
    EXPECT_FALSE(escape.active()) << "column " << column;
  }
  escape.observe({{30, 0}, {0, 0}, {}}, true);
  EXPECT_TRUE(escape.active());
}

TEST(GridEscape, ForgetsTheEpisodeBefore) {
  GridEscapeParameters parameters;
  parameters.patience = 1;
  GridEscape escape(parameters);
  escape.start();
  escape.observe({{5, 0}, {9, 0}, {}});
  escape.observe({{4, 0}, {9, 0}, {}});
  ASSERT_TRUE(escape.active());
  escape.start();
  escape.observe({{0, 0}, {9, 0}, {}});
  EXPECT_FALSE(escape.active());
}

TEST(GridEscape, RefusesParametersThatMakeNoSense) {
  GridEscapeParameters parameters;
  parameters.patience = 0;
  EXPECT_THROW(GridEscape{parameters}, std::invalid_argument);
  parameters = {};
  parameters.long_patience = 0;
  EXPECT_THROW(GridEscape{parameters}, std::invalid_argument);
  parameters = {};
  parameters.margin = -1.0;
  EXPECT_THROW(GridEscape{parameters}, std::invalid_argument);
  parameters = {};
  parameters.boundary.leg_growth = std::nan("");
  EXPECT_THROW(GridEscape{parameters}, std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_grid_escape
