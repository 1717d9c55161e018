#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/learning/grid_dataset.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "support/refusal.hpp"
#include "unit/grid_world/learning/grid_learning_fixtures.hpp"

namespace lstm_planner::test_grid_dataset {
namespace {

GridDatasetParameters smallDataset() {
  GridDatasetParameters parameters;
  parameters.steps = 500;
  parameters.sequence_steps = 12;
  parameters.burn_in_steps = 4;
  parameters.max_steps = 40;
  return parameters;
}

GridCourse caveCourse() { return GridCourse(smallCourse(), {{smallCave(1), smallCave(2)}}, 3, 1); }

/// Always prefers to go west.
Model westward() {
  Model model;
  model.layers = makeDenseStack(kGridInputs, {}, kGridMoveCount);
  std::get<DenseLayer>(model.layers[0]).bias[4] = 1.0f;
  writeGridMetadata(&model.metadata);
  return model;
}

TEST(SupervisorMove, LeadsAlongAShortestPathFromEverywhere) {
  const PassableGrid grid = smallCave(1);
  Random random(1);
  const GridCourse course(smallCourse(), {{grid}}, 1, 1);
  for (int i = 0; i < 50; ++i) {
    const GridCourse::Episode episode = course.draw(random);
    double walked = 0.0;
    int previous = -1;
    for (CellIndex cell = episode.start; cell != episode.goal->goal; cell = cellBeside(cell, previous)) {
      previous = supervisorMove(*episode.goal, cell, previous);
      ASSERT_TRUE(movePossible(episode.goal->map->grid, cell, previous, CornerCutting::kForbidden));
      walked += moveLength(previous);
      ASSERT_LE(walked, 1000.0);
    }
    // The distances add up floats: 30 cells of about 1e-6 each.
    EXPECT_NEAR(walked, static_cast<double>(episode.goal->distances.at(episode.start)), 1e-4);
  }
}

TEST(SupervisorMove, GoesOnAsBeforeAmongEquals) {
  // From (0, 0) to (6, 2) any order of two diagonal and four straight moves is as short.
  const CourseGoal goal = goalOn(PassableGrid(8, 8, true), {6, 2});
  EXPECT_EQ(supervisorMove(goal, {0, 0}, 0), 0);
  EXPECT_EQ(supervisorMove(goal, {0, 0}, 1), 1);
  EXPECT_EQ(supervisorMove(goal, {0, 0}, 2), 0);   // north is not among them
  EXPECT_EQ(supervisorMove(goal, {0, 0}, -1), 0);  // 18 degrees: nearer to east than to north-east
  EXPECT_EQ(supervisorMove(goalOn(PassableGrid(8, 8, true), {6, 4}), {0, 0}, -1), 1);  // 34 degrees
}

TEST(SupervisorMove, CutsACornerOnlyWhereTheCourseAllowsIt) {
  PassableGrid grid(3, 3, true);
  grid.set({1, 0}, false);
  CourseGoal goal = goalOn(grid, {2, 1});
  EXPECT_EQ(supervisorMove(goal, {0, 0}, -1), 2) << "around the corner";
  goal.distances = GridDistances(grid, {2, 1}, CornerCutting::kAllowed);
  goal.corner_cutting = CornerCutting::kAllowed;
  EXPECT_EQ(supervisorMove(goal, {0, 0}, -1), 1);
}

TEST(CollectGridSequences, LearnsThePathsOfTheThesisAStarWhichAreLonger) {
  const auto stepsOfTenPaths = [](GridSupervisor supervisor) {
    GridDatasetParameters parameters = smallDataset();
    parameters.steps = 3000;
    parameters.sequence_steps = 1000;
    parameters.supervisor = supervisor;
    int steps = 0;
    const auto sequences = collectGridSequences(parameters, caveCourse(), nullptr, 0.0, 5, 1);
    for (std::size_t i = 0; i < 10; ++i) steps += static_cast<int>(sequences[i].labels.size());
    return steps;
  };
  EXPECT_GT(stepsOfTenPaths(GridSupervisor::kThesisAStar), stepsOfTenPaths(GridSupervisor::kShortestPath))
      << "the same ten starts and goals";
}

TEST(SupervisorMove, HasNoAnswerWhereThereIsNoPath) {
  PassableGrid grid(5, 1, true);
  grid.set({2, 0}, false);
  EXPECT_EQ(supervisorMove(goalOn(grid, {4, 0}), {0, 0}, -1), -1);
}

TEST(GridDataset, HasTheStepsThatWereAskedForInSequencesOfTheLengthThatWasAskedFor) {
  const GridDatasetParameters parameters = smallDataset();
  const GridCourse course = caveCourse();
  const auto sequences = collectGridSequences(parameters, course, nullptr, 0.0, 1, 1);
  EXPECT_EQ(countWeighted(sequences), 500u);
  bool some_burn_in = false;
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    const Sequence& sequence = sequences[i];
    ASSERT_LE(sequence.steps(), 12);
    if (sequence.weights[0] > 0.0f) continue;
    some_burn_in = true;
    // It starts with the last four steps of the piece before.
    EXPECT_EQ(sequence.weights.head(4).sum(), 0.0f);
    EXPECT_EQ(sequence.weights.tail(sequence.steps() - 4).minCoeff(), 1.0f);
    EXPECT_EQ(sequence.inputs.leftCols(4), sequences[i - 1].inputs.rightCols(4));
  }
  EXPECT_TRUE(some_burn_in);
  EXPECT_NO_THROW(validateSequences(sequences, kGridInputs, kGridMoveCount, "test"));
}

TEST(GridDataset, LabelsOfTheSupervisorsPathsAreTheMovesThatWereMade) {
  GridDatasetParameters parameters = smallDataset();
  parameters.sequence_steps = 200;
  const auto sequences = collectGridSequences(parameters, caveCourse(), nullptr, 0.0, 1, 1);
  // Input 10 is the previous action, direction / 4 - 1, and 0 before the first move.
  for (const Sequence& sequence : sequences) {
    EXPECT_EQ(sequence.inputs(10, 0), 0.0f);
    for (Eigen::Index step = 1; step < sequence.steps(); ++step) {
      EXPECT_FLOAT_EQ(sequence.inputs(10, step), static_cast<float>(sequence.labels[step - 1]) / 4.0f - 1.0f);
    }
  }
}

TEST(GridDataset, DependsOnTheSeedAndNotOnTheThreads) {
  const auto collect = [](std::uint64_t seed, int threads, const Model* learner) {
    const auto sequences = collectGridSequences(smallDataset(), caveCourse(), learner, 0.5, seed, threads);
    Eigen::VectorXd sums(static_cast<Eigen::Index>(sequences.size()));
    for (std::size_t i = 0; i < sequences.size(); ++i) {
      sums[static_cast<Eigen::Index>(i)] = sequences[i].inputs.cast<double>().sum() + sequences[i].labels.sum();
    }
    return sums;
  };
  const Model learner = westward();
  EXPECT_EQ(collect(1, 1, nullptr), collect(1, 3, nullptr));
  EXPECT_EQ(collect(1, 1, &learner), collect(1, 3, &learner));
  const Eigen::VectorXd other = collect(2, 1, nullptr);
  EXPECT_FALSE(other.size() == collect(1, 1, nullptr).size() && other == collect(1, 1, nullptr));
}

TEST(GridDataset, ALearnerThatLeadsIsToldThePathWhereItGoes) {
  GridDatasetParameters parameters = smallDataset();
  parameters.sequence_steps = 100;
  parameters.stuck_steps = 1000;
  const Model learner = westward();
  const auto sequences = collectGridSequences(parameters, caveCourse(), &learner, 1.0, 1, 1);
  EXPECT_EQ(countWeighted(sequences), 500u);
  int to_the_west = 0;
  int otherwise_labelled = 0;
  for (const Sequence& sequence : sequences) {
    ASSERT_LE(sequence.steps(), parameters.max_steps);
    for (Eigen::Index step = 1; step < sequence.steps(); ++step) {
      const bool free = sequence.inputs(4, step - 1) * kGridRayCap > 1.5f;  // the ray to the west
      if (!free) continue;
      EXPECT_EQ(sequence.inputs(10, step), 0.0f);  // moved west: 4 / 4 - 1
      ++to_the_west;
      if (sequence.labels[step - 1] != 4) ++otherwise_labelled;
    }
  }
  EXPECT_GT(to_the_west, 0);
  EXPECT_GT(otherwise_labelled, 0);
}

TEST(GridDataset, TheSupervisorRescuesALearnerThatIsStuck) {
  GridDatasetParameters parameters = smallDataset();
  parameters.steps = 2000;
  parameters.max_steps = 400;
  parameters.sequence_steps = 400;
  const Model learner = westward();
  const auto longest = [&](int stuck_steps) {
    parameters.stuck_steps = stuck_steps;
    parameters.rescue_steps = 30;  // as long as any path here: it leads to the goal
    Eigen::Index steps = 0;
    for (const Sequence& sequence : collectGridSequences(parameters, caveCourse(), &learner, 1.0, 1, 1)) {
      steps = std::max(steps, sequence.steps());
    }
    return steps;
  };
  EXPECT_EQ(longest(1000), 400);  // never rescued: one that goes west only does not come to a goal in the east
  // Every 5 steps without gain are followed by 30 that bring it nearer, by at least 1 each.
  EXPECT_LT(longest(5), 100);
}

TEST(GridDataset, RefusesSizesThatMakeNoSense) {
  GridDatasetParameters parameters = smallDataset();
  parameters.burn_in_steps = 12;
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { validate(parameters); }),
            "parameter sequence_steps is 12, expected more than burn_in_steps");
  parameters = smallDataset();
  parameters.steps = 0;
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { validate(parameters); }),
            "parameter steps is 0, expected a positive number");
}

}  // namespace
}  // namespace lstm_planner::test_grid_dataset
