#include <gtest/gtest.h>

#include "lstm_planner/base/common/random.hpp"
#include "lstm_planner/grid_world/world/range_table.hpp"

namespace lstm_planner {
namespace {

TEST(RangeTable, HoldsWhatTheRaysSense) {
  PassableGrid grid(130, 90, true);
  Random random(5);
  for (int i = 0; i < 600; ++i) {
    grid.set({static_cast<int>(uniformIndex(random, 130)), static_cast<int>(uniformIndex(random, 90))}, false);
  }
  const RangeTable table(grid);
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const GridRanges expected = grid.passable({column, row}) ? senseRanges(grid, {column, row}) : GridRanges{};
      ASSERT_EQ(table.at({column, row}), expected) << column << ", " << row;
    }
  }
}

}  // namespace
}  // namespace lstm_planner
