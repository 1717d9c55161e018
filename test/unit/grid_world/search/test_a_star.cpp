#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "grid_world/search/a_star.hpp"
#include "lstm_planner/grid_world/search/grid_distances.hpp"
#include "unit/common/random_grid.hpp"

namespace lstm_planner::test_a_star {
namespace {

/// Every move of the path is possible, and it leads from start to goal.
void expectPossible(const PassableGrid& grid, const GridPath& path, CellIndex start, CellIndex goal,
                    CornerCutting corner_cutting) {
  ASSERT_TRUE(path.found());
  EXPECT_TRUE(path.cells.front() == start);
  EXPECT_TRUE(path.cells.back() == goal);
  for (std::size_t i = 1; i < path.cells.size(); ++i) {
    EXPECT_TRUE(movePossible(grid, path.cells[i - 1], rayBetween(path.cells[i - 1], path.cells[i]), corner_cutting));
  }
}

TEST(AStar, CountsStraightAndDiagonalMovesOfThePath) {
  const PassableGrid grid(30, 20, true);
  const GridPath path = AStar(grid).find({2, 3}, {12, 7}).path;
  EXPECT_EQ(path.straight_moves, 6);
  EXPECT_EQ(path.diagonal_moves, 4);
  EXPECT_DOUBLE_EQ(path.length(), 6.0 + 4.0 * std::sqrt(2.0));
  expectPossible(grid, path, {2, 3}, {12, 7}, CornerCutting::kForbidden);
}

TEST(AStar, ExpandsOnlyThePathWhereNothingIsInThePathAndTheHeuristicIsExact) {
  const PassableGrid grid(200, 100, true);
  EXPECT_EQ(AStar(grid).find({10, 10}, {150, 60}).expanded, 141u);  // 140 moves
}

TEST(AStar, GoesAroundACornerUnlessItMayBeCut) {
  PassableGrid grid(3, 3, true);
  grid.set({1, 0}, false);
  EXPECT_DOUBLE_EQ(AStar(grid).find({0, 0}, {1, 1}).path.length(), 2.0);
  EXPECT_DOUBLE_EQ(AStar(grid, {Heuristic::kOctile, CornerCutting::kAllowed}).find({0, 0}, {1, 1}).path.length(),
                   std::sqrt(2.0));
}

TEST(AStar, ReturnsTheStartAloneWhenItIsTheGoal) {
  const GridPath path = AStar(PassableGrid(3, 3, true)).find({1, 2}, {1, 2}).path;
  ASSERT_EQ(path.cells.size(), 1u);
  EXPECT_EQ(path.length(), 0.0);
}

TEST(AStar, ReturnsAnEmptyPathWhenThereIsNoPath) {
  PassableGrid grid(5, 3, true);
  for (int row = 0; row < 3; ++row) grid.set({2, row}, false);
  const AStarResult result = AStar(grid).find({0, 0}, {4, 2});
  EXPECT_FALSE(result.path.found());
  EXPECT_EQ(result.expanded, 6u);  // the whole left side
}

TEST(AStar, RefusesAStartInAWallAndAGoalOutsideInOneSentence) {
  PassableGrid grid(5, 3, true);
  grid.set({2, 1}, false);
  AStar search(grid);
  const auto message = [&search](CellIndex start, CellIndex goal) {
    try {
      search.find(start, goal);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message({2, 1}, {0, 0}), "the start (column 2, row 1) is in a wall, expected a passable cell");
  EXPECT_EQ(message({0, 0}, {5, 0}), "the goal (column 5, row 0) is outside the grid of 5 x 3 cells");
}

TEST(AStar, FindsAShortestPathWithEveryAdmissibleHeuristic) {
  std::mt19937 random(1);
  for (int round = 0; round < 40; ++round) {
    const CellIndex start{1, 1};
    const CellIndex goal{28, 17};
    const PassableGrid grid = randomGrid(30, 20, 30, random, {start, goal});
    for (const CornerCutting corner_cutting : {CornerCutting::kForbidden, CornerCutting::kAllowed}) {
      const float shortest = GridDistances(grid, goal, corner_cutting).at(start);
      for (const Heuristic heuristic : {Heuristic::kChebyshev, Heuristic::kOctile, Heuristic::kEuclidean}) {
        const GridPath path = AStar(grid, {heuristic, corner_cutting}).find(start, goal).path;
        ASSERT_EQ(path.found(), std::isfinite(shortest));
        if (!path.found()) continue;
        EXPECT_FLOAT_EQ(static_cast<float>(path.length()), shortest);
        expectPossible(grid, path, start, goal, corner_cutting);
      }
    }
  }
}

/// The cost of the cheapest path, cells; infinite without one. Bellman and Ford's, which needs no heuristic.
double cheapest(const PassableGrid& grid, CellIndex start, CellIndex goal, double straight, double diagonal, int step) {
  std::vector<double> cost(grid.size(), std::numeric_limits<double>::infinity());
  cost[grid.offset(start)] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const CellIndex cell : grid.cells()) {
      for (int direction = 0; direction < kGridMoveCount; direction += step) {
        if (!movePossible(grid, cell, direction, CornerCutting::kForbidden)) continue;
        const double through = cost[grid.offset(cell)] + (direction % 2 == 0 ? straight : diagonal);
        double& beside = cost[grid.offset(cellBeside(cell, direction))];
        if (through < beside - 1e-9) {
          beside = through;
          changed = true;
        }
      }
    }
  }
  return cost[grid.offset(goal)];
}

TEST(AStar, FindsACheapestPathWhateverMovesThereAreAndWhatTheyCost) {
  struct Variant {
    double straight, diagonal;
    bool diagonal_moves;
    Heuristic heuristic;
  };
  std::mt19937 random(4);
  const CellIndex start{1, 1};
  const CellIndex goal{28, 17};
  for (int round = 0; round < 20; ++round) {
    const PassableGrid grid = randomGrid(30, 20, 30, random, {start, goal});
    for (const Variant& v : {Variant{1.0, 1.5, false, Heuristic::kManhattan},
                             {3.0, 3.0, true, Heuristic::kOctile},
                             {3.0, 3.0, true, Heuristic::kChebyshev},
                             {1.0, 1.9, true, Heuristic::kOctile}}) {
      AStarParameters parameters{v.heuristic};
      parameters.costs = moveCosts(v.straight, v.diagonal);
      parameters.diagonal_moves = v.diagonal_moves;
      const GridPath path = AStar(grid, parameters).find(start, goal).path;
      const double expected = cheapest(grid, start, goal, v.straight, v.diagonal, v.diagonal_moves ? 1 : 2);
      ASSERT_EQ(path.found(), std::isfinite(expected));
      if (!path.found()) continue;
      expectPossible(grid, path, start, goal, CornerCutting::kForbidden);
      EXPECT_NEAR(
          v.straight * static_cast<double>(path.straight_moves) + v.diagonal * static_cast<double>(path.diagonal_moves),
          expected, 1e-6);
      EXPECT_TRUE(v.diagonal_moves || path.diagonal_moves == 0);
    }
  }
}

TEST(AStar, ExpandsOnlyAPathWhereNothingIsInTheWayAndCostsMatchTheHeuristic) {
  const PassableGrid grid(60, 60, true);
  AStarParameters four{Heuristic::kManhattan};
  four.diagonal_moves = false;
  EXPECT_EQ(AStar(grid, four).find({5, 5}, {25, 15}).expanded, 31u);  // 30 moves, thesis Figure 1.7
  AStarParameters chebyshev{Heuristic::kOctile};
  chebyshev.costs = moveCosts(1.0, 1.0);
  EXPECT_EQ(AStar(grid, chebyshev).find({5, 5}, {25, 15}).expanded, 21u);
}

TEST(MoveCosts, AreRefusedWhereDiagonalsAreNeverOrAlwaysWorthIt) {
  EXPECT_EQ(moveCosts(1.0, std::sqrt(2.0)).straight, kStraightCost);
  EXPECT_EQ(moveCosts(1.0, std::sqrt(2.0)).diagonal, kDiagonalCost);
  EXPECT_THROW(moveCosts(1.0, 2.1), std::invalid_argument);
  EXPECT_THROW(moveCosts(1.0, 0.9), std::invalid_argument);
  EXPECT_THROW(moveCosts(0.0, 0.0), std::invalid_argument);
  EXPECT_THROW(moveCosts(std::nan(""), 1.0), std::invalid_argument);
}

/// Sums over random grids from corner to corner.
struct Total {
  double length = 0.0;
  std::size_t expanded = 0;
};

Total searchRandomGrids(const AStarParameters& parameters) {
  std::mt19937 random(3);
  const CellIndex start{0, 0};
  const CellIndex goal{59, 39};
  Total total;
  for (int round = 0; round < 20; ++round) {
    const PassableGrid grid = randomGrid(60, 40, 25, random, {start, goal});
    const AStarResult result = AStar(grid, parameters).find(start, goal);
    if (!result.path.found()) continue;
    expectPossible(grid, result.path, start, goal, parameters.corner_cutting);
    EXPECT_GE(result.path.length(), AStar(grid).find(start, goal).path.length());
    total.length += result.path.length();
    total.expanded += result.expanded;
  }
  return total;
}

TEST(AStar, PaysInLengthForFewerExpansionsWithTheThesisHeuristic) {
  const Total shortest = searchRandomGrids({});
  const Total scaled = searchRandomGrids({Heuristic::kScaledEuclidean});
  EXPECT_GT(scaled.length, shortest.length);
  EXPECT_LT(scaled.expanded, shortest.expanded);
}

TEST(AStar, PaysEvenMoreInLengthWhenClosedCellsStayClosed) {
  const AStarParameters stay_closed{Heuristic::kScaledEuclidean, CornerCutting::kForbidden, ClosedCells::kStayClosed};
  const Total reopening = searchRandomGrids({Heuristic::kScaledEuclidean});
  const Total staying = searchRandomGrids(stay_closed);
  EXPECT_GT(staying.length, reopening.length);
  EXPECT_LT(staying.expanded, reopening.expanded);
}

TEST(AStar, ExpandsACellAtMostOnceWhenClosedCellsStayClosed) {
  PassableGrid grid(60, 40, true);
  for (int row = 0; row < 40; ++row) grid.set({50, row}, false);  // no path: everything on this side is expanded
  const AStarParameters stay_closed{Heuristic::kScaledEuclidean, CornerCutting::kForbidden, ClosedCells::kStayClosed};
  EXPECT_EQ(AStar(grid, stay_closed).find({5, 5}, {55, 5}).expanded, 50u * 40u);
  EXPECT_GT(AStar(grid, {Heuristic::kScaledEuclidean}).find({5, 5}, {55, 5}).expanded, 50u * 40u);
}

TEST(AStar, GivesTheSameInALaterSearchAsInAFirst) {
  std::mt19937 random(2);
  const PassableGrid grid = randomGrid(40, 40, 20, random, {{0, 0}, {39, 39}, {0, 39}, {39, 0}});
  AStar reused(grid);
  reused.find({39, 0}, {0, 39});
  const AStarResult later = reused.find({0, 0}, {39, 39});
  const AStarResult first = AStar(grid).find({0, 0}, {39, 39});
  EXPECT_EQ(later.path.cells.size(), first.path.cells.size());
  EXPECT_EQ(later.path.length(), first.path.length());
  EXPECT_EQ(later.expanded, first.expanded);
  EXPECT_EQ(later.peak_bytes, first.peak_bytes);
}

TEST(MoveCost, OrdersNearlyEqualPathsLikeTheirTrueLengths) {
  // The hardest cases are convergents of sqrt(2): a straight moves against b diagonal ones that differ least. Whether
  // a < b sqrt(2) is decided by a^2 < 2 b^2.
  for (std::int64_t before = 1, a = 1, b = 1; b <= (std::int64_t{1} << 26);) {
    EXPECT_EQ(a * kStraightCost < b * kDiagonalCost, a * a < 2 * b * b) << a << " against " << b << " diagonal moves";
    EXPECT_NE(a * kStraightCost, b * kDiagonalCost);
    before = b;
    b += a;
    a = b + before;
  }
}

}  // namespace
}  // namespace lstm_planner::test_a_star
