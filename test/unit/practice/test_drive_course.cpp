#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/practice/drive_course.hpp"

namespace lstm_planner::test_drive_course {
namespace {

DriveCourseParameters roomsOnly() {
  DriveCourseParameters parameters;
  parameters.worlds = {WorldKind::kRooms};
  return parameters;
}

TEST(DriveCourse, DrawsDrivesThatCanBeDone) {
  const auto exercises = makeDriveExercises(roomsOnly(), WorldUse::kTraining, 1, 0, 2, 3);
  ASSERT_EQ(exercises.size(), 2u);
  for (const DriveExercise& exercise : exercises) {
    ASSERT_EQ(exercise.tasks.size(), 3u);
    for (const DriveTask& task : exercise.tasks) {
      EXPECT_TRUE(std::isfinite(task.shortest));
      EXPECT_GE(task.shortest, 2.0);
      EXPECT_FALSE(exercise.world->touches({task.start.x, task.start.y}, 0.17425 + 0.12));
      EXPECT_FALSE(exercise.world->touches(task.goal, 0.17425 + 0.12));
    }
  }
}

TEST(DriveCourse, NeverSharesAWorldBetweenTrainingAndValidation) {
  const auto training = makeDriveExercises(roomsOnly(), WorldUse::kTraining, 1, 0, 1, 1);
  const auto validation = makeDriveExercises(roomsOnly(), WorldUse::kValidation, 1, 0, 1, 1);
  const auto again = makeDriveExercises(roomsOnly(), WorldUse::kTraining, 1, 0, 1, 1);
  EXPECT_EQ(training[0].tasks[0].start.x, again[0].tasks[0].start.x);
  EXPECT_NE(training[0].tasks[0].start.x, validation[0].tasks[0].start.x);
}

TEST(DriveCourse, TakesTheKindsInTurn) {
  DriveCourseParameters parameters;
  parameters.worlds = {WorldKind::kOpen, WorldKind::kRooms};
  for (int number = 0; number < 4; ++number) {
    const auto exercises = makeDriveExercises(parameters, WorldUse::kTraining, 1, number, 1, 1);
    ASSERT_FALSE(exercises.empty());
    EXPECT_EQ(exercises[0].kind, static_cast<std::size_t>(number % 2));
  }
}

TEST(DriveCourse, FindsTheDeadEndInFrontOfAWall) {
  // A wall from y = 0 to 8 m at x = 5 m; the goal lies behind it.
  OccupancyGrid grid(100, 100, 0.1, {0.0, 0.0}, Cell::kFree);
  for (int row = 0; row < 80; ++row) grid.set({50, row}, Cell::kOccupied);
  const GridWorld world(grid);
  const Point2 goal{8.0, 3.0};
  const Point2 end = grid.centerOf(deadEndBelow(world, grid.cellAt({2.0, 1.0}), goal, 0.3));
  EXPECT_NEAR(end.x, 4.7, 0.11) << "as near to the wall as the clearance lets it";
  EXPECT_NEAR(end.y, 3.0, 0.11) << "beside the goal";
}

TEST(DriveCourse, StartsInDeadEndsWhenAsked) {
  DriveCourseParameters parameters;
  parameters.worlds = {WorldKind::kMaze};
  parameters.dead_end_share = 1.0;
  int dead_ends = 0;
  for (const DriveExercise& exercise : makeDriveExercises(parameters, WorldUse::kTraining, 1, 0, 2, 10)) {
    for (const DriveTask& task : exercise.tasks) {
      const OccupancyGrid& grid = exercise.world->grid();
      const CellIndex start = grid.cellAt({task.start.x, task.start.y});
      const CellIndex end = deadEndBelow(*exercise.world, start, task.goal, 0.17425 + 0.12 + 0.025);
      dead_ends += start == end ? 1 : 0;
    }
  }
  // The rest started so near to the goal, or so far below it, that there was no dead end on the way.
  EXPECT_GE(dead_ends, 15);
}

TEST(DriveCourse, RefusesParametersByName) {
  DriveCourseParameters parameters;
  parameters.worlds.clear();
  EXPECT_THROW(validate(parameters), std::invalid_argument);
  parameters = {};
  parameters.dead_end_share = 1.5;
  EXPECT_THROW(validate(parameters), std::invalid_argument);
  parameters = {};
  parameters.shortest = 0.0;
  EXPECT_THROW(validate(parameters), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_drive_course
