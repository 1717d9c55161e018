#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "lstm_planner/base/learning/initialisation.hpp"
#include "lstm_planner/base/learning/parameter_vector.hpp"
#include "lstm_planner/grid_world/learning/grid_actor_critic.hpp"
#include "unit/base/learning/thread_ranks.hpp"

namespace lstm_planner::test_grid_actor_critic {
namespace {

/// Rooms whose doors lie at opposite ends: the straight path to the goal never works.
PassableGrid zigzag() {
  PassableGrid grid(24, 24, true);
  for (int wall = 4; wall < 24; wall += 5) {
    for (int row = 0; row < 24; ++row) grid.set({wall, row}, wall % 2 == 0 ? row < 3 : row > 20);
  }
  return grid;
}

GridActorCriticParameters smallTraining(int threads) {
  GridActorCriticParameters parameters;
  parameters.critic_units = {16};
  parameters.updates = 60;
  parameters.agents = 16;
  parameters.window = 32;
  parameters.threads = threads;
  return parameters;
}

LayerStack smallPolicy(const GridActorCriticParameters& parameters) {
  const GridEncoder encoder(parameters.encoder);
  LayerStack layers = makeLstmStack(encoder.size(), {6}, encoder.outputs());
  initialise({}, 4, layers);
  return layers;
}

GridCourse course(std::uint64_t seed) {
  GridCourseParameters parameters;
  parameters.goals = 20;
  parameters.min_length = 5;
  parameters.max_length = 100;
  return GridCourse(parameters, {{{zigzag()}, 1.0}}, seed, 2);
}

Eigen::VectorXf weightsAfter(GridLearner* training, int epoch, int updates) {
  const GridCourse maps = course(static_cast<std::uint64_t>(epoch));
  training->startEpoch(epoch, maps);
  for (int update = 0; update < updates; ++update) training->update();
  return parameterVector(training->layers());
}

TEST(GridActorCritic, TheSameSeedGivesTheSameWeightsForAnyNumberOfThreads) {
  const auto one = makeGridActorCritic(smallTraining(1), smallPolicy(smallTraining(1)));
  const auto two = makeGridActorCritic(smallTraining(2), smallPolicy(smallTraining(2)));
  EXPECT_EQ(weightsAfter(one.get(), 0, 5), weightsAfter(two.get(), 0, 5));
}

TEST(GridActorCritic, AnyNumberOfRanksLearnsTheSameWeightsAndReportsTheSame) {
  const auto outcome = [](Communicator* communicator) {
    GridActorCriticParameters parameters = smallTraining(1);
    parameters.agents = 40;  // 5 tiles
    parameters.communicator = communicator;
    const auto training = makeGridActorCritic(parameters, smallPolicy(parameters));
    const Eigen::VectorXf weights = weightsAfter(training.get(), 0, 5);
    const ReinforcementReport report = training->report();
    return std::make_pair(weights, std::vector<double>{report.steps, report.reward, report.arrival, report.ratio,
                                                       report.entropy, report.explained});
  };
  const auto one = outcome(oneProcess());
  for (const int ranks : {2, 3, 6}) {
    for (const auto& result : onRanks(ranks, outcome)) {
      EXPECT_EQ(result.first, one.first) << ranks << " ranks";
      EXPECT_EQ(result.second, one.second) << ranks << " ranks";
    }
  }
}

TEST(GridActorCritic, ResumesFromACheckpointAsIfItHadNotBeenInterrupted) {
  const GridActorCriticParameters parameters = smallTraining(2);
  const auto uninterrupted = makeGridActorCritic(parameters, smallPolicy(parameters));
  weightsAfter(uninterrupted.get(), 0, 5);
  const std::vector<std::uint8_t> checkpoint = uninterrupted->checkpoint();
  const Eigen::VectorXf expected = weightsAfter(uninterrupted.get(), 1, 5);

  const auto resumed = makeGridActorCritic(parameters, smallPolicy(parameters));
  resumed->restore(checkpoint);
  EXPECT_EQ(weightsAfter(resumed.get(), 1, 5), expected);
}

TEST(GridActorCritic, RefusesWhatIsNotItsCheckpoint) {
  const GridActorCriticParameters parameters = smallTraining(1);
  const auto training = makeGridActorCritic(parameters, smallPolicy(parameters));
  std::vector<std::uint8_t> checkpoint = training->checkpoint();
  checkpoint.resize(checkpoint.size() / 2);
  EXPECT_THROW(training->restore(checkpoint), std::invalid_argument);
  EXPECT_THROW(training->restore({}), std::invalid_argument);

  GridActorCriticParameters other = parameters;
  other.critic_units = {8};
  EXPECT_THROW(training->restore(makeGridActorCritic(other, smallPolicy(other))->checkpoint()), std::invalid_argument);
}

TEST(GridActorCritic, RefusesParametersOutOfRange) {
  GridActorCriticParameters parameters = smallTraining(1);
  parameters.window = 0;
  EXPECT_THROW(validate(parameters), std::invalid_argument);
  parameters = smallTraining(1);
  parameters.discount = 1.5;
  EXPECT_THROW(validate(parameters), std::invalid_argument);
}

TEST(GridActorCritic, LearnsToGoRoundWalls) {
  GridActorCriticParameters parameters = smallTraining(2);
  parameters.agents = 64;
  parameters.updates = 300;
  parameters.learning_rate = 0.01;
  const auto training = makeGridActorCritic(parameters, smallPolicy(parameters));
  const GridCourse maps = course(1);
  training->startEpoch(0, maps);
  const auto meanReward = [&] {
    for (int update = 0; update < 20; ++update) training->update();
    return training->report().reward;
  };
  const double before = meanReward();
  for (int round = 0; round < 13; ++round) meanReward();
  // A random walk gains nothing and pays the cost of every step, 0.2. A path twice as long as the shortest gains half a
  // cell a step.
  EXPECT_LT(before, 0.0);
  EXPECT_GT(meanReward(), 0.3);
}

}  // namespace
}  // namespace lstm_planner::test_grid_actor_critic
