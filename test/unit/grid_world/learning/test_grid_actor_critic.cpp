#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "grid_world/learning/boundary_teacher.hpp"
#include "grid_world/learning/grid_actor.hpp"
#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"
#include "lstm_planner/grid_world/learning/grid_actor_critic.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "unit/grid_world/learning/grid_learning_fixtures.hpp"
#include "unit/training/thread_ranks.hpp"

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

/// Share of the moves on another map in which the network would choose what following the boundary would.
double agreementWithTeacher(const LayerStack& layers, const GridEncoderParameters& encoder) {
  Model model;
  model.layers = layers;
  writeMetadata(encoder, &model.metadata);
  NetworkGridAgent::Options options;
  options.guided = false;
  NetworkGridAgent agent(model, options);
  const CourseGoal goal = goalOn(smallCave(3), {16, 16});
  int moves = 0;
  int agreed = 0;
  for (int column = 0; column < 32; ++column) {
    CellIndex cell{column, 4};
    if (!std::isfinite(goal.distances.at(cell))) continue;
    BoundaryMemory memory;
    agent.start(cell, goal.goal);
    for (int step = 0; step < 100 && cell != goal.goal; ++step) {
      const GridObservation observation{cell, goal.goal, goal.map->ranges.at(cell)};
      memory.observe(observation);
      agent.observe(observation);
      const int taught = taughtMove(memory, observation);
      ++moves;
      agreed += agent.decide() == taught ? 1 : 0;
      cell = cellBeside(cell, taught);
      agent.step(taught, true);
    }
  }
  return static_cast<double>(agreed) / moves;
}

TEST(GridActorCritic, ANetworkThatIsTaughtComesToChooseWhatFollowingTheBoundaryWould) {
  GridActorCriticParameters parameters = smallTraining(2);
  parameters.encoder.inputs = GridEncoderParameters::Inputs::kBoundary;
  parameters.agents = 64;
  parameters.updates = 200;
  parameters.learning_rate = 0.01;
  const auto agreementAfterLessons = [&](int lessons) {
    parameters.taught_updates = lessons;
    const auto training = makeGridActorCritic(parameters, smallPolicy(parameters));
    const GridCourse caves(smallCourse(), {{{smallCave(1), smallCave(2)}, 1.0}}, 1, 2);
    training->startEpoch(0, caves);
    for (int update = 0; update < parameters.updates; ++update) training->update();
    return agreementWithTeacher(training->layers(), parameters.encoder);
  };
  const double taught = agreementAfterLessons(parameters.updates);
  const double untaught = agreementAfterLessons(0);
  EXPECT_LT(1.0 - taught, 0.5 * (1.0 - untaught)) << "rewards alone: " << untaught;
  EXPECT_GT(taught, 0.8);
}

TEST(GridActorCritic, RefusesLessonsForANetworkThatDoesNotRememberTheBoundary) {
  GridActorCriticParameters parameters = smallTraining(1);
  parameters.taught_updates = 10;
  try {
    makeGridActorCritic(parameters, smallPolicy(parameters));
    FAIL() << "was not refused";
  } catch (const std::invalid_argument& refusal) {
    EXPECT_STREQ(refusal.what(), "taught-updates is 10 with the inputs trace, expected 0 or the inputs boundary");
  }
}

TEST(GridActor, WithTheDiscountAsWeightWhatProgressBringsDependsOnTheEndsOfAPathAlone) {
  const GridCourse maps = course(1);
  GridActor actor(maps, {}, 7);
  Random random(5);
  const GridRewards rewards{0.99, 0.0, 0.0};
  const double first = static_cast<double>(actor.distance());
  double sum = 0.0;
  double weight = 1.0;
  for (int step = 0; step < 200; ++step) {
    actor.observe();
    int direction = 0;
    do {
      direction = static_cast<int>(uniformIndex(random, kGridMoveCount));
    } while (!actor.possible(direction));
    const GridActor::Outcome outcome = actor.step(direction, rewards, 1000000);
    sum += weight * outcome.reward;
    weight *= rewards.distance_weight;
    const double last = outcome.arrived ? 0.0 : static_cast<double>(actor.distance());
    ASSERT_NEAR(sum, first - weight * last, 1e-6 * first) << step;
    if (outcome.arrived) break;
  }
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
