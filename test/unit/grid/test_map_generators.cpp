#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include "lstm_planner/grid/map_generators.hpp"
#include "lstm_planner/grid_world/search/grid_distances.hpp"
#include "support/case_name.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_map_generators {
namespace {

constexpr int kSeeds = 10;

std::string lettersOf(const PassableGrid& grid) {
  std::string letters;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) letters += grid.passable({column, row}) ? '.' : '@';
    letters += '\n';
  }
  return letters;
}

std::size_t passableCount(const PassableGrid& grid) {
  const std::string letters = lettersOf(grid);
  return static_cast<std::size_t>(std::count(letters.begin(), letters.end(), '.'));
}

/// Cells reached without corner cutting from the first passable one.
std::size_t reachedCount(const PassableGrid& grid) {
  const auto offset = lettersOf(grid).find('.');
  if (offset == std::string::npos) return 0;
  const auto line = static_cast<std::size_t>(grid.columns()) + 1;
  const CellIndex goal{static_cast<int>(offset % line), static_cast<int>(offset / line)};
  const GridDistances distances(grid, goal, CornerCutting::kForbidden);
  std::size_t count = 0;
  for (const CellIndex cell : grid.cells()) count += std::isfinite(distances.at(cell));
  return count;
}

/// Open cells of a wall between two corridors, which is `width` cells long and starts at `first`.
int openCells(const PassableGrid& grid, CellIndex first, CellIndex step, int width) {
  int open = 0;
  for (int i = 0; i < width; ++i) {
    open += grid.passable({first.column + i * step.column, first.row + i * step.row}) ? 1 : 0;
  }
  return open;
}

class Mazes : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(OfCorridorWidth, Mazes, ::testing::Values(1, 2, 3, 8), test::caseName("Cells"));

TEST_P(Mazes, AreTreesOfCorridorsOfTheWidth) {
  const int width = GetParam();
  const int across = 13;
  const int down = 7;
  const MazeParameters parameters{1 + across * (width + 1), 1 + down * (width + 1), width, 0.1};
  for (int seed = 0; seed < kSeeds; ++seed) {
    const PassableGrid grid = generateMaze(parameters, static_cast<std::uint64_t>(seed));
    int opened = 0;
    for (int i = 0; i < down; ++i) {
      for (int j = 0; j < across; ++j) {
        const CellIndex corner{1 + j * (width + 1), 1 + i * (width + 1)};
        for (int row = 0; row < width; ++row) {
          ASSERT_EQ(openCells(grid, {corner.column, corner.row + row}, {1, 0}, width), width);
        }
        const int east = openCells(grid, {corner.column + width, corner.row}, {0, 1}, width);
        const int south = openCells(grid, {corner.column, corner.row + width}, {1, 0}, width);
        ASSERT_TRUE(east == 0 || east == width) << "a wall is open or closed as a whole";
        ASSERT_TRUE(south == 0 || south == width);
        ASSERT_FALSE(grid.passable({corner.column + width, corner.row + width})) << "posts stay";
        ASSERT_TRUE((j + 1 < across || east == 0) && (i + 1 < down || south == 0)) << "nothing leads out";
        opened += (east > 0 ? 1 : 0) + (south > 0 ? 1 : 0);
      }
    }
    EXPECT_EQ(opened, across * down - 1) << "a connected graph of n places with n - 1 paths is a tree";
    EXPECT_EQ(reachedCount(grid), passableCount(grid));
  }
}

TEST(Mazes, MayBeCutWhereTheMapEnds) {
  // 512 columns and corridors of 8: 56 whole corridors and 7 cells of another.
  const PassableGrid grid = generateMaze({512, 512, 8, 0.1}, 1);
  EXPECT_EQ(reachedCount(grid), passableCount(grid));
  EXPECT_TRUE(grid.passable({511, 1}));
  for (int column = 0; column < 512; ++column) EXPECT_FALSE(grid.passable({column, 0}));
}

TEST(Mazes, HaveMoreDeadEndsTheMoreTheyBranch) {
  const auto deadEnds = [](double branching) {
    const PassableGrid grid = generateMaze({201, 201, 1, branching}, 3);
    int count = 0;
    for (CellIndex cell{1, 1}; cell.row < 201; cell.row += 2) {
      for (cell.column = 1; cell.column < 201; cell.column += 2) {
        int paths = 0;
        for (int direction = 0; direction < kGridMoveCount; direction += 2) {
          paths += grid.passable(cellBeside(cell, direction)) ? 1 : 0;
        }
        count += paths == 1 ? 1 : 0;
      }
    }
    return count / 10000.0;
  };
  EXPECT_LT(deadEnds(0.0), 0.13);           // the backtracker's share is known to be about 10 %
  EXPECT_NEAR(deadEnds(0.1), 0.175, 0.02);  // the benchmark's mazes: 0.158 to 0.193
  EXPECT_GT(deadEnds(1.0), 0.25);
}

TEST(RandomFill, BlocksExactlyItsShare) {
  for (const double share : {0.0, 0.25, 0.4, 0.99}) {
    const PassableGrid grid = generateRandomFill({101, 57, share, false}, 5);
    EXPECT_EQ(grid.size() - passableCount(grid), static_cast<std::size_t>(share * 101 * 57));
  }
}

TEST(RandomFill, SpreadsItsCellsEvenly) {
  // Blocked cells of one half: 2500 expected; drawn without replacement, their deviation is sqrt(5000 / 4 * 3 / 4)
  // = 31.
  const PassableGrid grid = generateRandomFill({200, 100, 0.25, false}, 5);
  int left = 0;
  for (int row = 0; row < 100; ++row) left += 100 - openCells(grid, {0, row}, {1, 0}, 100);
  EXPECT_NEAR(left, 2500, 5 * 31);
}

TEST(RandomFill, LeavesOneRegionWhenPocketsAreFilled) {
  for (const double share : {0.25, 0.4, 0.7}) {
    const PassableGrid grid = generateRandomFill({128, 128, share, true}, 7);
    EXPECT_GT(passableCount(grid), 0u);
    EXPECT_EQ(reachedCount(grid), passableCount(grid));
  }
}

TEST(Rooms, AreAllConnected) {
  for (const double extra_doors : {0.0, 0.5, 1.0}) {
    for (int seed = 0; seed < kSeeds; ++seed) {
      const PassableGrid grid = generateRooms({100, 70, 8, 2, extra_doors}, static_cast<std::uint64_t>(seed));
      EXPECT_EQ(reachedCount(grid), passableCount(grid));
      EXPECT_TRUE(grid.passable({1, 1})) << "rooms are empty";
    }
  }
}

TEST(Rooms, HaveOneDoorOfTheWidthInEveryWallWhenAllAreAsked) {
  const int rooms = 9;
  const PassableGrid grid = generateRooms({1 + rooms * 9, 1 + rooms * 9, 8, 3, 1.0}, 2);
  for (int i = 0; i < rooms; ++i) {
    for (int j = 0; j + 1 < rooms; ++j) {
      EXPECT_EQ(openCells(grid, {9 + j * 9, 1 + i * 9}, {0, 1}, 8), 3);
      EXPECT_EQ(openCells(grid, {1 + i * 9, 9 + j * 9}, {1, 0}, 8), 3);
    }
  }
}

TEST(Rooms, HaveNoMoreDoorsThanNeededWhenNoneAreAsked) {
  const int rooms = 9;
  const PassableGrid grid = generateRooms({1 + rooms * 9, 1 + rooms * 9, 8, 1, 0.0}, 2);
  EXPECT_EQ(passableCount(grid), static_cast<std::size_t>(rooms * rooms * 64 + rooms * rooms - 1));
}

TEST(Caves, AreOneRegion) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    const PassableGrid grid = generateCaves({96, 64, 0.4, 4}, static_cast<std::uint64_t>(seed));
    EXPECT_EQ(reachedCount(grid), passableCount(grid));
    EXPECT_GT(passableCount(grid), grid.size() / 4) << "one cave takes most of what 40 % of rock leaves";
  }
}

TEST(Caves, HaveSmootherWallsTheMoreRoundsTheyHad) {
  const auto wallLength = [](int rounds) {
    const PassableGrid grid = generateCaves({200, 200, 0.4, rounds}, 1);
    int length = 0;
    for (CellIndex cell; cell.row < 199; ++cell.row) {
      for (cell.column = 0; cell.column < 199; ++cell.column) {
        length += grid.passable(cell) != grid.passable({cell.column + 1, cell.row}) ? 1 : 0;
      }
    }
    return length;
  };
  EXPECT_LT(wallLength(1), wallLength(0));
  EXPECT_LT(wallLength(2), wallLength(1));
  EXPECT_LT(wallLength(4), wallLength(2));
}

TEST(Caves, GiveUpWhereNothingStaysOpen) { EXPECT_THROW(generateCaves({8, 8, 0.6, 50}, 0), std::runtime_error); }

TEST(MapGenerators, GiveTheSameMapForTheSameSeedOnly) {
  const auto check = [](const std::function<PassableGrid(std::uint64_t)>& generate) {
    EXPECT_EQ(lettersOf(generate(4)), lettersOf(generate(4)));
    EXPECT_NE(lettersOf(generate(4)), lettersOf(generate(5)));
  };
  check([](std::uint64_t seed) { return generateMaze({60, 50, 3, 0.1}, seed); });
  check([](std::uint64_t seed) { return generateRandomFill({60, 50, 0.3, true}, seed); });
  check([](std::uint64_t seed) { return generateRooms({60, 50, 8, 1, 0.3}, seed); });
  check([](std::uint64_t seed) { return generateCaves({60, 50, 0.4, 4}, seed); });
}

TEST(MapGenerators, AreTheSameOnEveryMachine) {  // Drawn once and kept: another map for the same seed would make every
                                                 // published figure another.
  EXPECT_EQ(lettersOf(generateMaze({13, 9, 1, 0.1}, 1)),
            "@@@@@@@@@@@@@\n"
            "@.......@...@\n"
            "@.@@@@@.@.@.@\n"
            "@.@.......@.@\n"
            "@@@@@@@@@.@.@\n"
            "@.......@.@.@\n"
            "@@@.@@@.@@@.@\n"
            "@.....@.....@\n"
            "@@@@@@@@@@@@@\n");
}

TEST(MapGenerators, WorkOnTheSmallestMaps) {
  EXPECT_EQ(lettersOf(generateMaze({2, 2, 1, 0.0}, 1)), "@@\n@.\n");
  EXPECT_EQ(lettersOf(generateRandomFill({1, 1, 0.5, true}, 1)), ".\n");
  EXPECT_EQ(lettersOf(generateRooms({2, 3, 1, 1, 0.0}, 1)), "@@\n@.\n@@\n");
  EXPECT_EQ(passableCount(generateCaves({8, 8, 0.0, 1}, 1)), 60u) << "the corners have four open cells around them";
}

TEST(MapGenerators, RefuseBadParametersByName) {
  const auto refuses = [](const std::string& why, const auto& generate) { EXPECT_EQ(test::refusalOf(generate), why); };
  refuses("parameter rows is 1, expected at least 2", [] { generateMaze({512, 1, 1, 0.1}, 1); });
  refuses("parameter corridor_width is 9, expected less than the map's columns and rows", [] {
    generateMaze({9, 20, 9, 0.1}, 1);
  });
  refuses("parameter corridor_width is 0, expected at least 1", [] { generateMaze({512, 512, 0, 0.1}, 1); });
  refuses("parameter branching is 1.1, expected a probability in [0, 1]", [] { generateMaze({512, 512, 8, 1.1}, 1); });
  refuses("parameter rows is 8193, expected at most 2^26 cells with 8192 columns", [] {
    generateRandomFill({8192, 8193, 0.1, true}, 1);
  });
  refuses("parameter share is nan, expected a share of at least 0 and below 1", [] {
    generateRandomFill({8, 8, std::nan(""), true}, 1);
  });
  refuses("parameter door_cells is 9, expected at least 1 and at most room_size", [] {
    generateRooms({64, 64, 8, 9, 0.5}, 1);
  });
  refuses("parameter rounds is -1, expected a number from 0 to 100", [] { generateCaves({64, 64, 0.4, -1}, 1); });
  refuses("parameter columns is 7, expected at least 8", [] { generateCaves({7, 64, 0.4, 4}, 1); });
}

}  // namespace
}  // namespace lstm_planner::test_map_generators
