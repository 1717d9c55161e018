#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "lstm_planner/grid_world/learning/grid_course.hpp"

namespace lstm_planner::test_grid_course {
namespace {

GridCourseParameters parametersFor(double min_length, double max_length, double short_share) {
  GridCourseParameters parameters;
  parameters.goals = 40;
  parameters.min_length = min_length;
  parameters.max_length = max_length;
  parameters.short_share = short_share;
  parameters.long_share = 0.0;
  return parameters;
}

/// An open square and a long corridor.
std::vector<GridCourse::Set> twoSets() { return {{PassableGrid(60, 60, true)}, {PassableGrid(200, 2, true)}}; }

TEST(GridCourse, DrawsPathsOfTheWantedLengthsFromAllSetsAlike) {
  const GridCourse course(parametersFor(10, 50, 0.0), twoSets(), 3, 1);
  Random random(1);
  int in_square = 0;
  for (int i = 0; i < 4000; ++i) {
    const GridCourse::Episode episode = course.draw(random);
    in_square += episode.goal->map->grid.size() == 60u * 60u ? 1 : 0;
    const float length = episode.goal->distances.at(episode.start);
    ASSERT_GE(length, 10.0f);
    ASSERT_LE(length, 50.0f);
    ASSERT_TRUE(episode.goal->map->grid.passable(episode.start));
  }
  // Half of 4,000; a binomial number has here the deviation 32.
  EXPECT_NEAR(in_square, 2000, 4 * 32);
}

TEST(GridCourse, AShareOfThePathsIsShortMoreOften) {
  const auto shareBelow20 = [](double short_share) {
    const GridCourse course(parametersFor(10, 50, short_share), twoSets(), 3, 1);
    Random random(1);
    int below = 0;
    for (int i = 0; i < 4000; ++i) {
      const GridCourse::Episode episode = course.draw(random);
      if (episode.goal->distances.at(episode.start) < 20.0f) ++below;
    }
    return below / 4000.0;
  };
  // Buckets are 10 cells wide: 1 of 4 when lengths are uniform, ln 2 / ln 5 when their logarithm is; deviation 0.008.
  EXPECT_NEAR(shareBelow20(0.0), 0.25, 0.032);
  EXPECT_NEAR(shareBelow20(1.0), std::log(2.0) / std::log(5.0), 0.032);
}

TEST(GridCourse, ALimitFarBeyondAllPathsTakesNoMemory) {
  const GridCourse course(parametersFor(10, 1e6, 1.0), twoSets(), 3, 1);
  Random random(1);
  EXPECT_LE(course.draw(random).goal->starts.capacity(), 20u);
}

/// A square with a pocket that is open to the left, and the goal to the right of it.
TEST(GridCourse, AgentsThatOnlyComeNearerEndInDeadEnds) {
  PassableGrid grid(20, 11, true);
  for (int row = 3; row <= 7; ++row) grid.set({12, row}, false);
  for (int column = 8; column <= 12; ++column) {
    grid.set({column, 3}, false);
    grid.set({column, 7}, false);
  }
  const CellIndex goal{18, 5};
  EXPECT_EQ(deadEndBelow(grid, {1, 5}, goal, CornerCutting::kForbidden), (CellIndex{11, 5}));
  EXPECT_EQ(deadEndBelow(grid, {14, 10}, goal, CornerCutting::kForbidden), goal);
  EXPECT_EQ(deadEndBelow(grid, goal, goal, CornerCutting::kForbidden), goal);
}

TEST(GridCourse, AShareOfTheEpisodesStartsInDeadEnds) {
  PassableGrid comb(60, 60, true);  // walls with a gap in turn above and below
  for (int column = 10; column < 60; column += 10) {
    for (int row = 0; row < 60; ++row) comb.set({column, row}, (column / 10) % 2 == 0 ? row < 2 : row > 57);
  }
  const auto shareInDeadEnds = [&](double share) {
    GridCourseParameters parameters = parametersFor(10, 150, 0.0);
    parameters.dead_end_share = share;
    const GridCourse course(parameters, {{comb}}, 3, 1);
    Random random(1);
    int ends = 0;
    for (int i = 0; i < 1000; ++i) {
      const GridCourse::Episode episode = course.draw(random);
      const PassableGrid& grid = episode.goal->map->grid;
      EXPECT_TRUE(std::isfinite(episode.goal->distances.at(episode.start)));
      ends += deadEndBelow(grid, episode.start, episode.goal->goal, CornerCutting::kForbidden) == episode.start ? 1 : 0;
    }
    return ends / 1000.0;
  };
  EXPECT_LT(shareInDeadEnds(0.0), 0.1);  // a cell of a wall's side that is as near as none beside it
  EXPECT_GT(shareInDeadEnds(1.0), 0.6);  // the others can go straight to the goal
}

TEST(GridCourse, AFewPathsAreLonger) {
  GridCourseParameters parameters = parametersFor(10, 50, 0.5);
  parameters.long_share = 0.1;
  parameters.longest = 150;
  const GridCourse course(parameters, twoSets(), 3, 1);
  Random random(1);
  int longer = 0;
  for (int i = 0; i < 4000; ++i) {
    const GridCourse::Episode episode = course.draw(random);
    const float length = episode.goal->distances.at(episode.start);
    ASSERT_LE(length, 150.0f);
    if (length > 50.0f) ++longer;
  }
  // The open square has few paths beyond its diagonal of 83 cells, so that some draws are made again. At most a tenth.
  EXPECT_GT(longer, 40);
  EXPECT_LT(longer, 400 + 4 * 19);
}

TEST(GridCourse, RenewsItsGoalsWithoutPullingThemAwayFromRunningEpisodes) {
  GridCourse course(parametersFor(10, 50, 0.0), twoSets(), 3, 1);
  Random random(1);
  const GridCourse::Episode episode = course.draw(random);
  const CellIndex goal = episode.goal->goal;
  course.renew(200);
  EXPECT_TRUE(episode.goal->goal == goal);
  EXPECT_EQ(episode.goal->distances.at(goal), 0.0f);
}

TEST(GridCourse, RefusesSetsWithoutMapsAndMapsWithoutAPathOfTheWantedLength) {
  EXPECT_THROW(GridCourse(parametersFor(10, 50, 0.0), {{PassableGrid(5, 5, true)}}, 1, 1), std::invalid_argument);
  EXPECT_THROW(GridCourse(parametersFor(10, 50, 0.0), {}, 1, 1), std::invalid_argument);
  EXPECT_THROW(GridCourse(parametersFor(10, 50, 0.0), std::vector<GridCourse::Set>(1), 1, 1), std::invalid_argument);
  EXPECT_THROW(GridCourse(parametersFor(10, 5, 0.0), twoSets(), 1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_grid_course
