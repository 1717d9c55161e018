#include <gtest/gtest.h>

#include <array>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid_world/agent/rolling_window.hpp"
#include "lstm_planner/grid_world/agent/seen_grid.hpp"

namespace lstm_planner::test_rolling_window {
namespace {

using Window = RollingWindow<32, 2>;

/// A window that has rolled to and fro, so that it lies over the plane's torus anyhow.
Window filledWindow(Random& random) {
  Window window;
  CellIndex middle{-37, 90};
  window.restart(middle);
  for (int step = 0; step < 40; ++step) {
    middle.column += static_cast<int>(uniformIndex(random, 15)) - 7;
    middle.row += static_cast<int>(uniformIndex(random, 15)) - 7;
    window.keepInside(middle, 8);
    for (int i = 0; i < 60; ++i) {
      window.set({window.origin().column + static_cast<int>(uniformIndex(random, 32)),
                  window.origin().row + static_cast<int>(uniformIndex(random, 32))},
                 static_cast<unsigned>(uniformIndex(random, 4)));
    }
  }
  return window;
}

TEST(RollingWindow, TellsOfAllPlacesAroundOneWhatItTellsOfEach) {
  Random random(5);
  const Window window = filledWindow(random);
  for (int row = -3; row < Window::kSide + 3; ++row) {
    for (int column = -3; column < Window::kSide + 3; ++column) {
      const CellIndex place{window.origin().column + column, window.origin().row + row};
      const std::array<unsigned, 9> around = window.around(place);
      for (int i = 0; i < 9; ++i) {
        ASSERT_EQ(around[static_cast<std::size_t>(i)], window.at({place.column + i % 3 - 1, place.row + i / 3 - 1}));
      }
    }
  }
}

TEST(RollingWindow, TellsOfFourRowsAtOnceWhatItTellsOfEachPlace) {
  Random random(6);
  const Window window = filledWindow(random);
  for (int row = -6; row < Window::kSide + 6; ++row) {
    for (int column = -8; column < Window::kSide + 8; ++column) {
      const CellIndex first{window.origin().column + column, window.origin().row + row};
      if (first.column % 4 != 0) continue;
      const std::uint32_t bytes = window.fourBytesFrom(first);
      for (int i = 0; i < 16; ++i) {
        ASSERT_EQ(bytes >> (2 * i) & 3u, window.at({first.column + i % 4, first.row + i / 4}));
      }
    }
  }
}

TEST(SeenGrid, TellsWhichOfTheCellsBesideAreWalls) {
  SeenGrid seen;
  seen.restart({50, 50});
  // Two walls to the east leave a gap that is doubtful until a ray goes through it.
  seen.observe({{50, 50}, {90, 90}, {50, 2, 50, 50, 50, 50, 50, 2}});
  seen.observe({{50, 51}, {90, 90}, {50, 2, 50, 50, 50, 50, 50, 50}});
  for (int row = 47; row < 56; ++row) {
    for (int column = 47; column < 56; ++column) {
      for (const bool through_doubtful : {false, true}) {
        unsigned walls = 0;
        for (int direction = 0; direction < kGridRayCount; ++direction) {
          const SeenGrid::Cell cell = seen.at(cellBeside({column, row}, direction));
          const bool closed = cell == SeenGrid::Cell::kWall || (cell == SeenGrid::Cell::kDoubtful && !through_doubtful);
          walls |= (closed ? 1u : 0u) << direction;
        }
        EXPECT_EQ(seen.wallsBeside({column, row}, through_doubtful), walls) << column << ", " << row;
      }
    }
  }
  EXPECT_NE(seen.wallsBeside({51, 51}, true), 0u);
}

}  // namespace
}  // namespace lstm_planner::test_rolling_window
