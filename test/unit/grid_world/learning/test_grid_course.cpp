#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "lstm_planner/grid_world/learning/grid_course.hpp"

namespace lstm_planner {
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
std::vector<GridCourse::Set> twoSets() {
  return {{{PassableGrid(60, 60, true)}, 3.0}, {{PassableGrid(200, 2, true)}, 1.0}};
}

TEST(GridCourse, DrawsPathsOfTheWantedLengthsFromTheSetsByTheirWeights) {
  const GridCourse course(parametersFor(10, 50, 0.0), twoSets(), 3, 1);
  Random random(1);
  std::map<std::size_t, int> episodes;
  for (int i = 0; i < 4000; ++i) {
    const GridCourse::Episode episode = course.draw(random);
    ++episodes[episode.set];
    const float length = episode.goal->distances.at(episode.start);
    ASSERT_GE(length, 10.0f);
    ASSERT_LE(length, 50.0f);
    ASSERT_TRUE(episode.goal->map->grid.passable(episode.start));
  }
  // Three quarters of 4,000; a binomial number has here the deviation 27.
  EXPECT_NEAR(episodes[0], 3000, 4 * 27);
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

TEST(GridCourse, RefusesMapsWithoutAPathOfTheWantedLength) {
  EXPECT_THROW(GridCourse(parametersFor(10, 50, 0.0), {{{PassableGrid(5, 5, true)}, 1.0}}, 1, 1),
               std::invalid_argument);
  EXPECT_THROW(GridCourse(parametersFor(10, 50, 0.0), {}, 1, 1), std::invalid_argument);
  EXPECT_THROW(GridCourse(parametersFor(10, 5, 0.0), twoSets(), 1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner
