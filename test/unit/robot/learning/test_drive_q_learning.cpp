#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/base/learning/parameter_vector.hpp"
#include "lstm_planner/robot/learning/drive_judge.hpp"
#include "lstm_planner/robot/learning/drive_q_learning.hpp"
#include "robot/learning/drive_practice.hpp"
#include "robot/learning/drive_q_tile.hpp"
#include "support/case_name.hpp"
#include "support/refusal.hpp"
#include "unit/robot/evaluation/drive_learning_fixtures.hpp"

namespace lstm_planner::test_drive_q_learning {
namespace {

constexpr std::uint64_t kNetworkSeed = 3;

/// Share of drives in open worlds that arrive, always with the action of the highest value.
double arrivalOf(const DriveQLearningParameters& parameters, const LayerStack& layers) {
  return judgeDrives(DrivePolicy(parameters.policy, layers), parameters.course, 10, 150, 1, 1).arrival;
}

double arrivalAfterLearning(DriveQLearningParameters parameters) {
  parameters.iterations = 15;
  parameters.worlds = 4;
  parameters.starts = 12;
  parameters.max_steps = 120;
  parameters.window = 16;
  parameters.learning_rate = 0.01;
  const auto learner = makeDriveQLearning(parameters, tinyNetwork(parameters, kNetworkSeed));
  EXPECT_LT(arrivalOf(parameters, learner->layers()), 0.2) << "nothing to learn";
  while (learner->updates() < parameters.iterations) learner->iterate();
  return arrivalOf(parameters, learner->layers());
}

TEST(DriveQLearning, LearnsToGoToTheGoalInTheOpenByTheThesissReward) {
  DriveQLearningParameters parameters = tinyTraining<DriveQLearningParameters>();
  // Where nothing is in the way, the goal's bearing is nearly all that matters, and there is no need to look far ahead.
  parameters.thesis_reward = {0.01, 0.02, 0.3};
  parameters.discount = 0.9;
  EXPECT_GT(arrivalAfterLearning(parameters), 0.6);
}

TEST(DriveQLearning, LearnsToGoToTheGoalInTheOpenByProgress) {
  DriveQLearningParameters parameters = tinyTraining<DriveQLearningParameters>();
  parameters.reward = DriveQLearningParameters::Reward::kProgress;
  EXPECT_GT(arrivalAfterLearning(parameters), 0.6);
}

/// By the number of views.
class DriveQLearningWithViews : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(OneAndEight, DriveQLearningWithViews, ::testing::Values(1, 8), test::caseName("Views"));

TEST_P(DriveQLearningWithViews, AnyNumberOfRanksLearnsTheSameWeightsAndReportsTheSame) {
  expectTheSameOnAnyNumberOfRanks(
      tinyTraining<DriveQLearningParameters>(GetParam()), makeDriveQLearning, kNetworkSeed,
      [](const ReinforcementReport& report) {
        return std::vector<double>{report.steps, report.reward, report.arrival, report.value, report.error};
      });
}

TEST_P(DriveQLearningWithViews, GivesTheSameWeightsForAnyNumberOfThreads) {
  DriveQLearningParameters parameters = tinyTraining<DriveQLearningParameters>(GetParam());
  const auto one = makeDriveQLearning(parameters, tinyNetwork(parameters, kNetworkSeed));
  parameters.threads = 3;
  const auto three = makeDriveQLearning(parameters, tinyNetwork(parameters, kNetworkSeed));
  for (int i = 0; i < 2; ++i) {
    one->iterate();
    three->iterate();
  }
  EXPECT_EQ(parameterVector(one->layers()), parameterVector(three->layers()));
  EXPECT_NE(parameterVector(one->layers()), parameterVector(tinyNetwork(parameters, kNetworkSeed)));
}

TEST_P(DriveQLearningWithViews, GoesOnFromACheckpointAsIfThereHadBeenNoBreak) {
  DriveQLearningParameters parameters = tinyTraining<DriveQLearningParameters>(GetParam());
  parameters.target_interval = 2;  // so that the target network is neither the first nor that of the break
  const auto through = makeDriveQLearning(parameters, tinyNetwork(parameters, kNetworkSeed));
  const auto first = makeDriveQLearning(parameters, tinyNetwork(parameters, kNetworkSeed));
  for (int i = 0; i < 4; ++i) through->iterate();
  for (int i = 0; i < 3; ++i) first->iterate();
  const auto second = makeDriveQLearning(parameters, tinyNetwork(parameters, kNetworkSeed));
  second->restore(first->checkpoint());
  EXPECT_EQ(second->updates(), 3);
  second->iterate();
  EXPECT_EQ(parameterVector(through->layers()), parameterVector(second->layers()));
}

/// What an exception says when the parameters are changed so; empty when there is none.
std::string refusalOf(void (*change)(DriveQLearningParameters*)) {
  DriveQLearningParameters parameters = tinyTraining<DriveQLearningParameters>();
  change(&parameters);
  return test::refusalOf<std::invalid_argument>([&] { validate(parameters); });
}

TEST(DriveQLearning, RefusesBadParametersWithTheReason) {
  EXPECT_EQ(refusalOf([](DriveQLearningParameters*) {}), "");
  EXPECT_EQ(refusalOf([](DriveQLearningParameters* p) { p->iterations = 0; }),
            "parameter iterations is 0, expected a number in [1, 1e+06]");
  EXPECT_EQ(refusalOf([](DriveQLearningParameters* p) { p->passes = 0; }),
            "parameter passes is 0, expected a number in [1, 10000]");
  EXPECT_EQ(refusalOf([](DriveQLearningParameters* p) { p->target_interval = 0; }),
            "parameter target-interval is 0, expected a number in [1, 1e+09]");
  EXPECT_EQ(refusalOf([](DriveQLearningParameters* p) { p->discount = 1.0; }),
            "parameter discount is 1, expected a number in [0, 1)");
  EXPECT_EQ(refusalOf([](DriveQLearningParameters* p) { p->exploration_end = 1.5; }),
            "parameter exploration-end is 1.5, expected a number in [0, 1]");
  EXPECT_EQ(refusalOf([](DriveQLearningParameters* p) { p->thesis_reward.angle = -1.0; }),
            "parameter tau-angle is -1, expected a number in [0, 1e+06]");
  EXPECT_EQ(refusalOf([](DriveQLearningParameters* p) { p->contact_cost = -2.0; }),
            "parameter contact-cost is -2, expected a number in [0, 1e+06]");
  EXPECT_EQ(refusalOf([](DriveQLearningParameters* p) { p->value_scale = 0.0; }),
            "parameter value-scale is 0, expected a number in [1e-09, 1e+09]");
  EXPECT_EQ(refusalOf([](DriveQLearningParameters* p) { p->learning_rate = 0.0; }),
            "parameter rate is 0, expected a number in [1e-09, 100]");
}

TEST(DriveQLearning, RefusesWhatDoesNotFit) {
  const DriveQLearningParameters parameters = tinyTraining<DriveQLearningParameters>();
  const auto learner = makeDriveQLearning(parameters, tinyNetwork(parameters, kNetworkSeed));
  EXPECT_THROW(learner->restore({1, 2, 3}), std::invalid_argument);
  EXPECT_THROW(makeDriveQLearning(parameters, makeLstmStack(3, {4}, 5)), std::invalid_argument);
  const int inputs = static_cast<int>(parameters.policy.encoder.input_layout.size());
  const auto larger = makeDriveQLearning(parameters, makeLstmStack(inputs, {5}, parameters.policy.actions.size()));
  EXPECT_THROW(larger->restore(learner->checkpoint()), std::invalid_argument);
}

TEST(DriveThesisReward, CountsNearWallsDistanceAndBearingAsCosts) {
  Observation observation;
  observation.sector_ranges = {0.01, 0.5, 1.0, 1.0, 2.0, 2.0, 4.0, 4.0};
  observation.goal_distance = 3.0;
  observation.goal_bearing = -0.5;
  const double proximity = 10.0 + 2.0 + 2 * 1.0 + 2 * 0.5 + 2 * 0.25;
  EXPECT_NEAR(driveThesisReward(observation, {1.0, 10.0, 100.0}), -(proximity + 10.0 * 3.0 + 100.0 * 0.5), 1e-12);
}

TEST(EpsilonGreedyChances, PreferTheBestOfTheAllowedActions) {
  float chances[4] = {};
  epsilonGreedyChances(0.4)({0.0f, 1.0f, 3.0f, 2.0f}, {1, 1, 0, 1}, chances);
  EXPECT_NEAR(chances[0], 0.4 / 3.0, 1e-6);
  EXPECT_NEAR(chances[1], 0.4 / 3.0, 1e-6);
  EXPECT_EQ(chances[2], 0.0f);
  EXPECT_NEAR(chances[3], 0.4 / 3.0 + 0.6, 1e-6);
}

/// Two drives, long enough for some windows: one that arrives and one that is cut off.
std::vector<PracticeEpisode> someDrives(int inputs, int actions) {
  std::vector<PracticeEpisode> episodes(2);
  Random random(1);
  for (PracticeEpisode& episode : episodes) {
    episode.arrived = &episode == &episodes.front();
    for (std::size_t step = 0; step < 7; ++step) {
      // Of the third step there was nothing to choose.
      episode.steps.push_back({static_cast<int>(step) % actions, step != 2, static_cast<float>(uniform(random))});
      for (int i = 0; i < inputs + kDrivePrivilegedInputs; ++i) {
        episode.inputs.push_back(static_cast<float>(uniform(random, -1.0, 1.0)));
      }
      for (int action = 0; action < actions; ++action) episode.allowed.push_back(1);
      // Looked at with eight views only; the robot turns once about.
      Observation seen;
      seen.heading = static_cast<double>(step + 1) * kViewAngle;
      seen.goal_bearing = uniform(random);
      seen.previous_action = uniform(random);
      episode.bearings.push_back(bearingsOf(seen));
    }
  }
  return episodes;
}

class DriveQTileTest : public ::testing::Test {
 protected:
  explicit DriveQTileTest(int views = 1) : parameters_(tinyTraining<DriveQLearningParameters>(views)) {
    parameters_.window = 8;
    parameters_.trace_decay = 0.0;  // so that the targets do not depend on the weights that are moved
    parameters_.double_q = false;
    parameters_.huber = 1e6;
    layers_ = tinyNetwork(parameters_, kNetworkSeed);
    weights_ = parameterVector(layers_);
    episodes_ = someDrives(inputSize(layers_), parameters_.policy.actions.size());
  }
  DriveQTile tile() const {
    DriveQTile tile(parameters_, layers_);
    for (std::size_t i = 0; i < episodes_.size(); ++i) tile.queues().append(i, episodes_[i]);
    tile.queues().close((7 + parameters_.window - 1) / parameters_.window);
    return tile;
  }

  DriveQLearningParameters parameters_;
  LayerStack layers_;
  Eigen::VectorXf weights_;
  std::vector<PracticeEpisode> episodes_;
};

/// By the number of views.
class DriveQTileWithViews : public DriveQTileTest, public ::testing::WithParamInterface<int> {
 protected:
  DriveQTileWithViews() : DriveQTileTest(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(OneAndEight, DriveQTileWithViews, ::testing::Values(1, 8), test::caseName("Views"));

TEST_F(DriveQTileTest, LearnsFromChosenStepsOfWhichItIsKnownWhatCame) {
  // Of each drive one step was not chosen, and one drive was cut off.
  EXPECT_EQ(tile().judge(weights_, weights_).steps, 6.0 + 5.0);
}

TEST_F(DriveQTileTest, TargetIsTheRewardAndTheValueOfTheBestAllowedActionAfterIt) {
  const auto inputs = static_cast<std::size_t>(inputSize(layers_));
  Network network(layers_);
  Eigen::VectorXf values;
  for (std::size_t step = 0; step < 2; ++step) {
    const float* input = episodes_[0].inputs.data() + step * (inputs + kDrivePrivilegedInputs);
    values = network.forward(Eigen::Map<const Eigen::VectorXf>(input, static_cast<Eigen::Index>(inputs)));
  }
  const auto targetOfFirstStep = [&] {
    DriveQTile judged = tile();
    judged.judge(weights_, weights_);
    return judged.queues().at(0, 0).target;
  };
  const auto expected = [&] {
    return static_cast<double>(episodes_[0].steps[0].reward) +
           parameters_.discount * parameters_.value_scale * static_cast<double>(values.maxCoeff());
  };
  EXPECT_NEAR(targetOfFirstStep(), expected(), 1e-5);
  Eigen::Index best = 0;
  values.maxCoeff(&best);
  episodes_[0].allowed[static_cast<std::size_t>(values.size() + best)] = 0;
  values[best] = -1e6f;
  EXPECT_NEAR(targetOfFirstStep(), expected(), 1e-5);
}

TEST_P(DriveQTileWithViews, GradientIsTheDerivativeOfTheSquaredErrors) {
  const Eigen::VectorXf target_weights = 0.5f * weights_;
  DriveQTile learning = tile();
  learning.judge(weights_, target_weights);
  EXPECT_EQ(learning.valueGradient(0, weights_), 6.0 + 5.0);
  const auto errorAt = [&](Eigen::Index index, float change) {
    Eigen::VectorXf moved = weights_;
    moved[index] += change;
    return tile().judge(moved, target_weights).squared_error;
  };
  const double unit = 2.0 * parameters_.value_scale * parameters_.value_scale;
  const float change = 1e-3f;
  for (Eigen::Index index = 0; index < weights_.size(); index += 7) {
    const double numeric = (errorAt(index, change) - errorAt(index, -change)) / (2.0 * static_cast<double>(change));
    EXPECT_NEAR(static_cast<double>(learning.gradient()[index]), numeric / unit,
                1e-3 * static_cast<double>(learning.gradient().norm()))
        << "weight " << index;
  }
}

TEST_P(DriveQTileWithViews, GoesOnInTheNextWindowAsIfItWereOne) {
  const double in_one = tile().judge(weights_, weights_).value;
  parameters_.window = 3;
  EXPECT_NEAR(tile().judge(weights_, weights_).value, in_one, 1e-9 * std::abs(in_one));
}

}  // namespace
}  // namespace lstm_planner::test_drive_q_learning
