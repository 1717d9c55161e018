#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/generated_world.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_generated_world {
namespace {

constexpr double kFootprint = 0.17425;
constexpr double kClearance = 0.07;

bool isSame(const OccupancyGrid& a, const OccupancyGrid& b) {
  if (a.columns() != b.columns() || a.rows() != b.rows()) return false;
  for (int row = 0; row < a.rows(); ++row) {
    for (int column = 0; column < a.columns(); ++column) {
      if (a.at({column, row}) != b.at({column, row})) return false;
    }
  }
  return true;
}

bool isClosed(const OccupancyGrid& grid) {
  bool closed = true;
  for (int column = 0; column < grid.columns(); ++column) {
    closed = closed && grid.at({column, 0}) == Cell::kOccupied;
    closed = closed && grid.at({column, grid.rows() - 1}) == Cell::kOccupied;
  }
  for (int row = 0; row < grid.rows(); ++row) {
    closed = closed && grid.at({0, row}) == Cell::kOccupied;
    closed = closed && grid.at({grid.columns() - 1, row}) == Cell::kOccupied;
  }
  return closed;
}

/// Cells in which a disc of that radius fits and which are not connected with the first of them.
int separateCells(const OccupancyGrid& grid, double radius) {
  const DistanceField distances(grid, true);
  const double needed = radius + grid.resolution() * M_SQRT1_2;
  std::vector<CellIndex> fitting;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      if (distances.at({column, row}) >= needed) fitting.push_back({column, row});
    }
  }
  if (fitting.empty()) return -1;
  const GeodesicField paths(grid, distances, fitting.front(), {needed, 0.0, 0.0});
  return static_cast<int>(
      std::count_if(fitting.begin(), fitting.end(), [&](const CellIndex& cell) { return std::isinf(paths.at(cell)); }));
}

class GeneratedWorld : public ::testing::TestWithParam<WorldKind> {};

TEST_P(GeneratedWorld, HasPlacesFiveMetresApart) {
  for (std::uint64_t number = 0; number < 12; ++number) {
    const std::uint64_t seed = worldSeed(WorldUse::kTraining, 1, number);
    const GridWorld world(generateWorld(GetParam(), seed));
    EXPECT_GE(drawTasks(world, 1, kFootprint, kClearance, 5.0, seed).at(0).shortest, 5.0) << number;
    EXPECT_NE(isClosed(world.grid()), GetParam() == WorldKind::kOpen) << number;
  }
}

TEST_P(GeneratedWorld, IsTheSameForTheSameSeed) {
  EXPECT_TRUE(isSame(generateWorld(GetParam(), 5), generateWorld(GetParam(), 5)));
  EXPECT_FALSE(isSame(generateWorld(GetParam(), 5), generateWorld(GetParam(), 6)));
}

TEST_P(GeneratedWorld, IsFoundByItsName) { EXPECT_EQ(worldKindOf(toString(GetParam())), GetParam()); }

INSTANTIATE_TEST_SUITE_P(Kinds, GeneratedWorld, ::testing::ValuesIn(worldKinds()),
                         [](const auto& kind) { return std::string(toString(kind.param)); });

TEST(WorldKinds, AreListedWhenOneIsNotKnown) {
  EXPECT_NE(test::refusalOf<std::invalid_argument>([] { worldKindOf("jungle"); }).find("forest"), std::string::npos);
}

TEST(WorldSeed, KeepsTheUsesApart) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (std::uint64_t number = 0; number < 20; ++number) {
      const std::uint64_t training = worldSeed(WorldUse::kTraining, seed, number);
      const std::uint64_t validation = worldSeed(WorldUse::kValidation, seed, number);
      const std::uint64_t judging = worldSeed(WorldUse::kJudging, seed, number);
      EXPECT_EQ(training >> 62, 0u);
      EXPECT_EQ(validation >> 62, 1u);
      EXPECT_GE(judging >> 62, 2u);
      seeds.insert({training, validation, judging});
    }
  }
  EXPECT_EQ(seeds.size(), 3u * 20u * 20u);
}

TEST(MazeWorld, HasCorridorsOfTheGivenWidthThatAllAreConnected) {
  MazeWorldParameters parameters;
  parameters.columns = 4;
  parameters.rows = 3;
  parameters.corridor_width = 0.8;
  parameters.wall_thickness = 0.2;
  const OccupancyGrid grid = generateMazeWorld(parameters, 1);
  EXPECT_EQ(grid.columns(), 4 * 20 + 4);
  EXPECT_EQ(grid.rows(), 3 * 20 + 4);
  EXPECT_EQ(separateCells(grid, 0.35), 0);
}

TEST(MazeWorld, OpensWallsForLoopsButLeavesPosts) {
  MazeWorldParameters parameters;
  parameters.loops = 1.0;
  parameters.columns = parameters.rows = 3;
  parameters.corridor_width = 1.0;
  parameters.wall_thickness = 0.2;
  parameters.resolution = 0.2;
  const OccupancyGrid grid = generateMazeWorld(parameters, 1);
  int posts = 0;
  for (int row = 1; row + 1 < grid.rows(); ++row) {
    for (int column = 1; column + 1 < grid.columns(); ++column) {
      posts += grid.at({column, row}) == Cell::kOccupied ? 1 : 0;
    }
  }
  EXPECT_EQ(posts, 4) << "one cell where four of the nine corridors meet";
}

TEST(CorridorWorld, IsOneAreaWhateverTheSeed) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(separateCells(generateCorridorWorld({}, seed), 0.3), 0) << seed;
  }
}

/// Of these seeds' first draws hardly a corridor finds room beside the first.
TEST(CorridorWorld, HasPlacesFiveMetresApartHoweverFewCorridorsFindRoom) {
  for (const std::uint64_t seed : {10306937756567203133ULL, 9642425941035453867ULL}) {
    const GridWorld world(generateWorld(WorldKind::kCorridors, seed));
    EXPECT_NO_THROW(drawTasks(world, 1, kFootprint, kClearance, 5.0, seed)) << seed;
  }
}

TEST(Forest, CanBeCrossedHoweverDenseItIs) {
  ForestParameters parameters;
  parameters.density = 0.3;
  const double needed = parameters.passage + parameters.resolution * M_SQRT1_2;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const OccupancyGrid grid = generateForest(parameters, seed);
    const DistanceField distances(grid, true);
    const GeodesicField paths(grid, distances, grid.cellAt({0.6, 5.0}), {needed, 0.0, 0.0});
    EXPECT_TRUE(std::isfinite(paths.at(grid.cellAt({parameters.width - 0.65, 5.0})))) << seed;
  }
}

TEST(Forest, KeepsItsGaps) {
  ForestParameters parameters;
  parameters.density = 0.1;
  // A pole grows by up to half a cell's diagonal where it is drawn, and the test is as much too cautious: a disc of
  // 0.25 m wants 2 * (0.25 + 2 * 0.035) m.
  parameters.gap = 0.65;
  for (std::uint64_t seed = 0; seed < 5; ++seed) EXPECT_EQ(separateCells(generateForest(parameters, seed), 0.25), 0);
}

TEST(OpenField, ShowsNothing) {
  const GridWorld field(generateWorld(WorldKind::kOpen, 1));
  std::vector<double> ranges(360);
  field.castRays({5.0, 5.0}, 0.0, 0.0174, 60.0, &ranges);
  EXPECT_TRUE(std::all_of(ranges.begin(), ranges.end(), [](double range) { return std::isinf(range); }));
}

}  // namespace
}  // namespace lstm_planner::test_generated_world
