#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lstm_planner/practice/drive_actor_critic.hpp"
#include "lstm_planner/practice/recorded_choices.hpp"
#include "lstm_planner/practice/step_simulator.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "support/case_name.hpp"
#include "support/refusal.hpp"
#include "unit/simulation/recorded_drives_fixtures.hpp"

namespace lstm_planner::test_drive_actor_critic {
namespace {

constexpr std::uint64_t kNetworkSeed = 7;

/// A training that takes a moment.
DriveActorCriticParameters tiny(int views = 1) {
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

std::unique_ptr<DriveActorCritic> newLearner(const DriveActorCriticParameters& parameters) {
  const LayerStack layers = initialised(makeLstmStack(static_cast<int>(parameters.policy.encoder.input_layout.size()),
                                                      {4}, networkOutputs(parameters.policy)),
                                        kNetworkSeed);
  return makeDriveActorCritic(parameters, layers);
}

ReinforcementReport iterate(DriveActorCritic* learner) {
  learner->step();
  return learner->report();
}

void finish(DriveActorCritic* learner) {
  while (!learner->done()) learner->step();
}

/// Half of the drives are practised, and half are examples.
DriveActorCriticParameters withExamples(int views) {
  DriveActorCriticParameters parameters = tiny(views);
  parameters.path_share = 0.5;
  return parameters;
}

/// Share of the decisions under the bound, in mazes, in which the network prefers the remembered path.
double shareAlongPath(DriveActorCriticParameters parameters, const LayerStack& layers) {
  double along = 0.0;
  double decisions = 0.0;
  Random random(1);
  for (const DriveExercise& exercise : makeDriveExercises(parameters.course, WorldUse::kValidation, 1, 0, 2, 10)) {
    for (const DriveTask& task : exercise.tasks) {
      NavigationAgent agent = drawRobot(AgentParameters(), parameters.policy, layers, random);
      agent.setStepListener([&](const Situation&, const Observation&) {
        const Decision& last = agent.decision();
        if (last.along_path >= 0) {
          decisions += 1.0;
          along += last.preferred == last.along_path ? 1.0 : 0.0;
        }
        return std::nullopt;
      });
      StepSimulator(*exercise.world, task, usualConditions(), 1).run(200, &agent);
    }
  }
  return along / decisions;
}

/// By the number of views.
class DriveActorCriticWithViews : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(OneAndEight, DriveActorCriticWithViews, ::testing::Values(1, 8), test::caseName("Views"));

TEST_P(DriveActorCriticWithViews, LearnsToGoToTheGoalInTheOpen) {
  DriveActorCriticParameters parameters = tiny(GetParam());
  parameters.iterations = 15;
  parameters.starts = 12;
  parameters.learning_rate = 0.01;
  const auto learner = newLearner(parameters);
  const double before = iterate(learner.get()).reward;
  finish(learner.get());
  EXPECT_GT(learner->report().reward, before + 2.0) << "m nearer to the goal a drive";
}

TEST_P(DriveActorCriticWithViews, LearnsInWindowsOfAnyLength) {
  DriveActorCriticParameters parameters = withExamples(GetParam());
  for (const int window : {1, 7}) {
    parameters.window = window;
    const auto learner = newLearner(parameters);
    const Eigen::VectorXf before = parameterVector(learner->layers());
    for (int i = 0; i < 2; ++i) learner->step();
    EXPECT_NE(parameterVector(learner->layers()), before) << window;
  }
}

TEST_P(DriveActorCriticWithViews, GivesTheSameWeightsForAnyNumberOfThreads) {
  DriveActorCriticParameters parameters = withExamples(GetParam());
  const auto one = newLearner(parameters);
  parameters.threads = 3;
  const auto three = newLearner(parameters);
  for (int i = 0; i < 2; ++i) {
    one->step();
    three->step();
  }
  EXPECT_EQ(parameterVector(one->layers()), parameterVector(three->layers()));
}

TEST_P(DriveActorCriticWithViews, GoesOnFromACheckpointAsIfThereHadBeenNoBreak) {
  const DriveActorCriticParameters parameters = withExamples(GetParam());
  const auto through = newLearner(parameters);
  const auto first = newLearner(parameters);
  for (int i = 0; i < 4; ++i) through->step();
  for (int i = 0; i < 2; ++i) first->step();
  const auto second = newLearner(parameters);
  second->restore(first->checkpoint());
  EXPECT_EQ(second->iterations(), 2);
  for (int i = 0; i < 2; ++i) second->step();
  EXPECT_EQ(parameterVector(through->layers()), parameterVector(second->layers()));
}

TEST_P(DriveActorCriticWithViews, TakesOverADriversMannerWhileItPractises) {
  // One that practice does not teach: this driver bears to the left.
  const auto bearingLeft = [](Dataset dataset) {
    for (RecordedEpisode& episode : dataset.recordings[0].episodes) {
      for (DriveStep& step : episode.steps) step.label = std::min(4, step.label + 1);
    }
    return dataset;
  };
  const Dataset recordings = bearingLeft(drivesAllAround(20, 20, 1));
  const Dataset others = bearingLeft(drivesAllAround(10, 20, 2));
  const auto agreementAfter = [&](bool follows) {
    DriveActorCriticParameters parameters = tiny(GetParam());
    parameters.learning_rate = 0.01;
    parameters.iterations = 8;
    const auto learner = newLearner(parameters);
    if (follows) learner->follow(recordings, 3.0);
    finish(learner.get());
    const ConfusionMatrix taken = preferencesIn(others, DrivePolicy(parameters.policy, learner->layers()));
    return static_cast<double>(taken.trace()) / static_cast<double>(taken.sum());
  };
  const double without = agreementAfter(false);
  EXPECT_GT(agreementAfter(true), without + 0.2) << "as often as " << without << " without them";
}

TEST_P(DriveActorCriticWithViews, LearnsToChooseTheRememberedPath) {
  DriveActorCriticParameters parameters = tiny(GetParam());
  parameters.course.worlds = {WorldKind::kMaze};
  parameters.path_share = 1.0;
  parameters.learning_rate = 0.01;
  parameters.iterations = 12;
  const auto learner = newLearner(parameters);
  const double before = shareAlongPath(parameters, learner->layers());
  finish(learner.get());
  EXPECT_GT(shareAlongPath(parameters, learner->layers()), before + 0.2) << "before: " << before;
}

std::vector<int> judgedAfter(int iterations, int judgements) {
  DriveActorCriticParameters parameters = tiny();
  parameters.starts = 1;
  parameters.iterations = iterations;
  parameters.judgements = judgements;
  const auto learner = newLearner(parameters);
  std::vector<int> judged_after;
  if (learner->judgementDue()) judged_after.push_back(0);
  while (!learner->done()) {
    const int update = iterate(learner.get()).update;
    EXPECT_EQ(update, learner->iterations());
    if (learner->judgementDue()) judged_after.push_back(learner->iterations());
  }
  return judged_after;
}

TEST(DriveActorCritic, IsJudgedFirstAndLastAndInBetween) {
  EXPECT_EQ(judgedAfter(10, 2), (std::vector<int>{0, 5, 10}));
  EXPECT_EQ(judgedAfter(11, 2), (std::vector<int>{0, 5, 10, 11}));
  EXPECT_EQ(judgedAfter(2, 10), (std::vector<int>{0, 1, 2})) << "no more often than there are iterations";
}

TEST(DriveActorCritic, RefusesRecordingsThatItCannotFollow) {
  const DriveActorCriticParameters parameters = tiny();
  const auto learner = newLearner(parameters);
  EXPECT_THROW(learner->follow(drivesAllAround(2, 5, 1), 0.0), std::invalid_argument);
  EXPECT_THROW(learner->follow(Dataset(), 1.0), std::invalid_argument);
}

TEST(DriveActorCritic, RefusesWhatDoesNotFit) {
  DriveActorCriticParameters parameters = tiny();
  const auto learner = newLearner(parameters);
  EXPECT_THROW(learner->restore({1, 2, 3}), std::invalid_argument);
  EXPECT_THROW(newLearner(tiny(8))->restore(learner->checkpoint()), std::invalid_argument);
  EXPECT_THROW(makeDriveActorCritic(parameters, makeLstmStack(3, {4}, 5)), std::invalid_argument);
  const auto refused = [&](void (*change)(DriveActorCriticParameters*)) { return test::isRefused(parameters, change); };
  EXPECT_FALSE(refused([](DriveActorCriticParameters*) {}));
  EXPECT_TRUE(refused([](DriveActorCriticParameters* p) { p->iterations = 0; }));
  EXPECT_TRUE(refused([](DriveActorCriticParameters* p) { p->judgements = 0; }));
  EXPECT_TRUE(refused([](DriveActorCriticParameters* p) { p->window = 0; }));
  EXPECT_TRUE(refused([](DriveActorCriticParameters* p) { p->discount = 1.0; }));
  EXPECT_TRUE(refused([](DriveActorCriticParameters* p) { p->path_share = 1.1; }));
  EXPECT_TRUE(refused([](DriveActorCriticParameters* p) { p->sharpness = -1.0; }));
  EXPECT_TRUE(refused([](DriveActorCriticParameters* p) { p->learning_rate = 0.0; }));
}

}  // namespace
}  // namespace lstm_planner::test_drive_actor_critic
