#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "grid_world/learning/grid_q_learning_tile.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"
#include "lstm_planner/grid_world/evaluation/grid_episode.hpp"
#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "support/refusal.hpp"
#include "unit/grid_world/evaluation/grid_fixtures.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_grid_q_learning {
namespace {

GridCourseParameters courseUpTo(double max_length) {
  GridCourseParameters parameters;
  parameters.min_length = 2.0;
  parameters.max_length = max_length;
  parameters.goals = 100;
  parameters.mirrored = false;
  return parameters;
}

std::vector<GridCourse::Set> only(const PassableGrid& grid) { return {{grid}}; }

GridCourse courseOn(const PassableGrid& grid, double max_length) {
  return GridCourse(courseUpTo(max_length), only(grid), 1, 1);
}

/// Between many of its cells the path starts by leading away from the goal.
const std::vector<std::string> kSmallMaze = {
    ".......",  //
    "######.",  //
    ".......",  //
    ".######",  //
    ".......",
};
constexpr double kLongestPath = 24.0;  ///< rounded up

GridQLearningParameters smallParameters() {
  GridQLearningParameters parameters;
  parameters.course = courseUpTo(kLongestPath);
  parameters.epochs = 1;
  parameters.agents = 64;
  parameters.window = 16;
  parameters.max_steps = 60;
  parameters.target_interval = 10;
  parameters.learning_rate = 0.01;
  parameters.threads = 1;
  return parameters;
}

LayerStack smallNetwork() { return initialised(makeLstmStack(kGridInputs, {6}, kGridMoveCount), 5); }

constexpr double kBestMoves = 0.0;
constexpr double kRandomMoves = 1.0;  ///< which small changes of weights do not change

/// `parameters` and `course` must outlive it.
QTile tileOn(const GridQLearningParameters& parameters, const GridCourse& course) {
  Random seeds(1);
  return QTile(parameters, smallNetwork(), course, &seeds);
}

TEST(QTile, CutsCornersWhereTheCourseDoes) {
  GridQLearningParameters parameters = smallParameters();
  parameters.course.corner_cutting = CornerCutting::kAllowed;
  PassableGrid staircase(6, 6, false);
  for (int i = 0; i < 6; ++i) staircase.set({i, i}, true);
  const GridCourse course(parameters.course, only(staircase), 1, 1);
  QTile tile = tileOn(parameters, course);
  const Eigen::VectorXf weights = parameterVector(smallNetwork());
  EXPECT_GT(tile.run(weights, weights, kRandomMoves).arrived, 0.0);
}

TEST(QTile, GradientIsTheDerivativeOfTheSquaredErrors) {
  const GridCourse course = courseOn(PassableGrid(12, 12, true), 12.0);
  GridQLearningParameters parameters = smallParameters();
  parameters.window = 5;
  parameters.trace_decay = 0.0;  // so that the targets do not depend on the weights that are moved
  parameters.double_q = false;
  parameters.huber = 1e6;
  const Eigen::VectorXf target_weights = parameterVector(smallNetwork());
  const Eigen::VectorXf weights = 1.5f * target_weights;
  QTile tile = tileOn(parameters, course);
  tile.run(weights, target_weights, kRandomMoves);
  const Eigen::VectorXf gradient = tile.gradient();
  const auto errorAt = [&](Eigen::Index index, float change) {
    Eigen::VectorXf moved = weights;
    moved[index] += change;
    return tileOn(parameters, course).run(moved, target_weights, kRandomMoves).squared_error;
  };
  // An error of half a squared value is the squared error of the output times the scale's square.
  const double unit = 2.0 * QTile::kValueScale * QTile::kValueScale;
  const float change = 1e-3f;
  for (Eigen::Index index = 0; index < weights.size(); index += 7) {
    const double numeric = (errorAt(index, change) - errorAt(index, -change)) / (2.0 * static_cast<double>(change));
    EXPECT_NEAR(static_cast<double>(gradient[index]), numeric / unit, 1e-3 * static_cast<double>(gradient.norm()))
        << "weight " << index;
  }
}

TEST(QTile, OfErrorsBeyondTheLimitOnlyTheSignCounts) {
  const GridCourse course = courseOn(PassableGrid(12, 12, true), 12.0);
  const Eigen::VectorXf weights = parameterVector(smallNetwork());
  const auto gradientWith = [&](double huber) {
    GridQLearningParameters parameters = smallParameters();
    parameters.window = 5;
    parameters.huber = huber;
    QTile tile = tileOn(parameters, course);
    tile.run(weights, weights, kRandomMoves);
    return Eigen::VectorXf(tile.gradient());
  };
  const Eigen::VectorXf gradient = gradientWith(1e-6);
  EXPECT_GT(gradient.norm(), 0.0f);
  EXPECT_TRUE(gradientWith(2e-6).isApprox(2.0f * gradient, 1e-4f));
}

TEST(QTile, GoesOnInTheNextWindowAsIfItWereOne) {
  const GridCourse course = courseOn(gridFrom(kSmallMaze), kLongestPath);
  GridQLearningParameters parameters = smallParameters();
  const Eigen::VectorXf weights = parameterVector(smallNetwork());
  parameters.trace_decay = 0.0;  // a window's targets do not look into the next one
  const double in_one = tileOn(parameters, course).run(weights, weights, kBestMoves).squared_error;
  parameters.window = 8;
  QTile halves = tileOn(parameters, course);
  const double first = halves.run(weights, weights, kBestMoves).squared_error;
  const double second = halves.run(weights, weights, kBestMoves).squared_error;
  // Only the order of summing differs.
  EXPECT_NEAR(first + second, in_one, 1e-9 * in_one);
}

std::unique_ptr<GridQLearning> learningInMaze(const GridQLearningParameters& parameters) {
  return makeGridQLearning(parameters, only(gridFrom(kSmallMaze)), smallNetwork());
}

Eigen::VectorXf weightsAfterSomeUpdates(int threads) {
  GridQLearningParameters parameters = smallParameters();
  parameters.agents = 3 * QTile::kActors;
  parameters.threads = threads;
  parameters.target_interval = 2;
  const auto learning = learningInMaze(parameters);
  for (int update = 0; update < 5; ++update) learning->step();
  return parameterVector(learning->layers());
}

TEST(GridQLearning, LearnsTheSameWithAnyNumberOfThreads) {
  const Eigen::VectorXf alone = weightsAfterSomeUpdates(1);
  EXPECT_NE(alone, parameterVector(smallNetwork()));
  EXPECT_EQ(alone, weightsAfterSomeUpdates(3));
}

TEST(GridQLearning, IsJudgedAndCanGoOnBetweenEpochs) {
  GridQLearningParameters parameters = smallParameters();
  parameters.updates = 11;
  parameters.epochs = 3;
  const auto learning = learningInMaze(parameters);
  EXPECT_FALSE(learning->judgementDue()) << "nothing was learned yet";
  std::vector<int> judged_after;
  int updates = 0;
  for (; !learning->done(); ++updates) {
    learning->step();
    EXPECT_EQ(learning->judgementDue(), learning->resumable());
    if (learning->judgementDue()) judged_after.push_back(updates + 1);
  }
  EXPECT_EQ(judged_after, (std::vector<int>{3, 7, 11})) << "as equal as can be";
  EXPECT_EQ(learning->progress(), 1.0);
}

TEST(GridQLearning, GoesOnFromACheckpointAsIfItHadNotStopped) {
  GridQLearningParameters parameters = smallParameters();
  parameters.updates = 8;
  parameters.epochs = 2;
  parameters.target_interval = 3;  // a copy falls into the second epoch, another lies before it
  const auto whole = learningInMaze(parameters);
  while (!whole->judgementDue()) whole->step();
  const std::vector<std::uint8_t> checkpoint = whole->checkpoint();
  const auto resumed = learningInMaze(parameters);
  resumed->restore(checkpoint);
  EXPECT_EQ(resumed->epoch(), 1);
  EXPECT_TRUE(resumed->judgementDue()) << "what was kept then may be gone";
  for (GridQLearning* learning : {whole.get(), resumed.get()}) {
    while (!learning->done()) learning->step();
  }
  EXPECT_EQ(parameterVector(whole->layers()), parameterVector(resumed->layers()));

  std::vector<std::uint8_t> truncated = checkpoint;
  truncated.resize(truncated.size() / 2);
  EXPECT_THROW(resumed->restore(truncated), std::invalid_argument);
}

/// Reward of the steps to within one cell of a goal that lies `distance` cells away in a corridor.
double corridorValue(double discount, int distance) {
  double value = GridActor::kArrivalBonus + 1.0 - GridActor::kStepCost;
  for (int left = distance - 2; left > 0; --left) value = 1.0 - GridActor::kStepCost + discount * value;
  return value;
}

TEST(GridQLearning, FindsTheValuesOfACorridor) {
  const PassableGrid corridor(12, 1, true);
  GridQLearningParameters parameters = smallParameters();
  parameters.course = courseUpTo(11.0);
  parameters.discount = 0.8;
  parameters.updates = 8000;
  const LayerStack layers = initialised(makeDenseStack(kGridInputs, {16}, kGridMoveCount), 1);
  const auto learning = makeGridQLearning(parameters, only(corridor), layers);
  while (!learning->done()) learning->step();

  Network network(learning->layers());
  Eigen::VectorXf input(kGridInputs);
  for (int cell = 0; cell <= 9; ++cell) {
    encodeGrid({{cell, 0}, {11, 0}, senseRanges(corridor, {cell, 0})}, kNoPath, input.data(), 1);
    const double value = QTile::kValueScale * static_cast<double>(network.forward(input)[0]);
    // Nearer than what one step earns.
    EXPECT_NEAR(value, corridorValue(parameters.discount, 11 - cell), 1.0 - GridActor::kStepCost) << cell;
  }
}

/// Share of all pairs of start and goal in which the network arrives, in time for one wrong turn up to a dead end.
double arrivalEverywhere(const PassableGrid& grid, const LayerStack& layers) {
  Model model;
  model.layers = layers;
  writeGridMetadata(&model.metadata);
  NetworkGridAgent::Options alone;
  alone.guided = false;
  NetworkGridAgent agent(model, alone);
  const RangeTable ranges(grid);
  int arrived = 0;
  int pairs = 0;
  for (std::size_t pair = 0; pair < grid.size() * grid.size(); ++pair) {
    const auto cell = [&](std::size_t offset) {
      const auto columns = static_cast<std::size_t>(grid.columns());
      return CellIndex{static_cast<int>(offset % columns), static_cast<int>(offset / columns)};
    };
    const CellIndex start = cell(pair / grid.size());
    const CellIndex goal = cell(pair % grid.size());
    if (!grid.passable(start) || !grid.passable(goal)) continue;
    GridEpisodeRules rules;
    rules.max_steps = 70;
    ++pairs;
    if (runGridEpisode(grid, ranges, start, goal, rules, &agent).end == GridEpisode::End::kArrived) ++arrived;
  }
  return static_cast<double>(arrived) / pairs;
}

TEST(GridQLearning, LeadsEverywhereInASmallMaze) {
  GridQLearningParameters parameters = smallParameters();
  parameters.updates = 5000;
  parameters.discount = 0.9;
  const PassableGrid maze = gridFrom(kSmallMaze);
  const auto learning = learningInMaze(parameters);
  EXPECT_LT(arrivalEverywhere(maze, learning->layers()), 0.7) << "nothing to learn";
  while (!learning->done()) learning->step();
  EXPECT_EQ(arrivalEverywhere(maze, learning->layers()), 1.0);
}

TEST(GridQLearning, RefusesWhatDoesNotFit) {
  const auto refusal = [](const GridQLearningParameters& parameters, const LayerStack& layers) {
    return test::refusalOf<std::invalid_argument>(
        [&] { makeGridQLearning(parameters, only(gridFrom(kSmallMaze)), layers); });
  };
  GridQLearningParameters parameters = smallParameters();
  parameters.discount = 1.0;
  EXPECT_EQ(refusal(parameters, smallNetwork()), "parameter discount is 1, expected a number in [0, 1)");
  parameters = smallParameters();
  parameters.threads = 0;
  EXPECT_EQ(refusal(parameters, smallNetwork()), "parameter threads is 0, expected at least 1");
  parameters = smallParameters();
  parameters.updates = 2;
  parameters.epochs = 3;
  EXPECT_EQ(refusal(parameters, smallNetwork()),
            "parameter updates is 2, expected at least one for each of the epochs");
  EXPECT_EQ(refusal(smallParameters(), makeLstmStack(kGridInputs, {6}, 1)),
            "the network has 11 inputs and 1 outputs, expected 11 and 8");
}

}  // namespace
}  // namespace lstm_planner::test_grid_q_learning
