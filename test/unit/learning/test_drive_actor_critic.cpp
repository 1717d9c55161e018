#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>
#include <vector>

#include "lstm_planner/learning/drive_actor_critic.hpp"
#include "lstm_planner/learning/initialisation.hpp"
#include "lstm_planner/learning/parameter_vector.hpp"
#include "thread_ranks.hpp"

namespace lstm_planner {
namespace {

DriveActorCriticParameters tinyTraining(int views = 1) {
  DriveActorCriticParameters parameters;
  parameters.policy.encoder.views = views;
  parameters.course.worlds = {WorldKind::kOpen};
  parameters.iterations = 4;
  parameters.worlds = 2;
  parameters.goals = 1;
  parameters.starts = 4;
  parameters.max_steps = 60;
  parameters.threads = 1;
  parameters.sharpness = 1.0;
  return parameters;
}

LayerStack tinyNetwork(const DriveActorCriticParameters& parameters) {
  LayerStack layers = makeLstmStack(static_cast<int>(parameters.policy.encoder.input_layout.size()), {4},
                                    networkOutputs(parameters.policy));
  initialise({}, 7, layers);
  return layers;
}

/// By the number of views.
class DriveActorCriticWithViews : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(OneAndEight, DriveActorCriticWithViews, ::testing::Values(1, 8));

TEST_P(DriveActorCriticWithViews, LearnsToGoToTheGoalInTheOpen) {
  DriveActorCriticParameters parameters = tinyTraining(GetParam());
  parameters.iterations = 15;
  parameters.starts = 12;
  parameters.learning_rate = 0.01;
  DriveActorCritic learner(parameters, tinyNetwork(parameters));
  const double before = learner.iterate().reward;
  double after = 0.0;
  while (learner.iterations() < parameters.iterations) after = learner.iterate().reward;
  EXPECT_GT(after, before + 2.0) << "m nearer to the goal a drive";
}

TEST_P(DriveActorCriticWithViews, AnyNumberOfRanksLearnsTheSameWeightsAndReportsTheSame) {
  struct Outcome {
    Eigen::VectorXf weights;
    std::vector<double> reported;
  };
  const auto learnOn = [](Communicator* communicator) {
    DriveActorCriticParameters parameters = tinyTraining(GetParam());
    parameters.communicator = communicator;
    DriveActorCritic learner(parameters, tinyNetwork(parameters));
    learner.iterate();
    const auto report = learner.iterate();
    return Outcome{parameterVector(learner.layers()),
                   {report.steps, report.reward, report.arrival, report.entropy, report.explained}};
  };
  const Outcome one = learnOn(oneProcess());
  for (const int ranks : {2, 3}) {  // 3: more ranks than there are worlds
    for (const Outcome& outcome : onRanks(ranks, learnOn)) {
      EXPECT_EQ(outcome.weights, one.weights) << ranks << " ranks";
      EXPECT_EQ(outcome.reported, one.reported) << ranks << " ranks";
    }
  }
}

TEST_P(DriveActorCriticWithViews, GivesTheSameWeightsForAnyNumberOfThreads) {
  DriveActorCriticParameters parameters = tinyTraining(GetParam());
  DriveActorCritic one(parameters, tinyNetwork(parameters));
  parameters.threads = 3;
  DriveActorCritic three(parameters, tinyNetwork(parameters));
  for (int i = 0; i < 2; ++i) {
    one.iterate();
    three.iterate();
  }
  EXPECT_EQ(parameterVector(one.layers()), parameterVector(three.layers()));
}

TEST_P(DriveActorCriticWithViews, GoesOnFromACheckpointAsIfThereHadBeenNoBreak) {
  const DriveActorCriticParameters parameters = tinyTraining(GetParam());
  DriveActorCritic through(parameters, tinyNetwork(parameters));
  DriveActorCritic first(parameters, tinyNetwork(parameters));
  for (int i = 0; i < 4; ++i) through.iterate();
  for (int i = 0; i < 2; ++i) first.iterate();
  DriveActorCritic second(parameters, tinyNetwork(parameters));
  second.restore(first.checkpoint());
  EXPECT_EQ(second.iterations(), 2);
  for (int i = 0; i < 2; ++i) second.iterate();
  EXPECT_EQ(parameterVector(through.layers()), parameterVector(second.layers()));
}

TEST(DriveActorCritic, RefusesWhatDoesNotFit) {
  DriveActorCriticParameters parameters = tinyTraining();
  DriveActorCritic learner(parameters, tinyNetwork(parameters));
  EXPECT_THROW(learner.restore({1, 2, 3}), std::invalid_argument);
  DriveActorCriticParameters other = parameters;
  other.critic_units = {5};
  EXPECT_THROW(DriveActorCritic(other, tinyNetwork(other)).restore(learner.checkpoint()), std::invalid_argument);
  EXPECT_THROW(DriveActorCritic(parameters, makeLstmStack(3, {4}, 5)), std::invalid_argument);
  const auto refused = [&](void (*change)(DriveActorCriticParameters*)) {
    DriveActorCriticParameters changed = parameters;
    change(&changed);
    try {
      validate(changed);
    } catch (const std::invalid_argument&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused([](DriveActorCriticParameters*) {}));
  EXPECT_TRUE(refused([](DriveActorCriticParameters* p) { p->iterations = 0; }));
  EXPECT_TRUE(refused([](DriveActorCriticParameters* p) { p->window = 0; }));
  EXPECT_TRUE(refused([](DriveActorCriticParameters* p) { p->clip = 0.0; }));
  EXPECT_TRUE(refused([](DriveActorCriticParameters* p) { p->discount = 1.0; }));
  EXPECT_TRUE(refused([](DriveActorCriticParameters* p) { p->sharpness = -1.0; }));
  EXPECT_TRUE(refused([](DriveActorCriticParameters* p) { p->learning_rate = 0.0; }));
}

}  // namespace
}  // namespace lstm_planner
