#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "practice/path_example.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_path_example {
namespace {

constexpr int kLeft = 4;          // index of 90 degrees
constexpr int kHalfLeft = 3;      // of 45
constexpr float kWeight = 0.25f;  // of a step

/// By a network that prefers to go straight on; the goal is 4 m to the left of the start.
PracticeEpisode exampleIn(OccupancyGrid hall) {
  const std::vector<float> straight_on = {0.0f, 1.0f, 2.0f, 1.0f, 0.0f};
  DriveActorCriticParameters parameters;
  parameters.path_weight = kWeight;
  DriveExercise exercise;
  exercise.kind = 3;
  exercise.world = std::make_shared<const GridWorld>(std::move(hall));
  return drivePathExample(parameters, test::layersPreferring(straight_on), exercise, {{4.0, 2.0, 0.0}, {4.0, 6.0}, 4.0},
                          1);
}

TEST(PathExample, TellsTheActionAlongThePathWhateverTheNetworkPrefers) {
  const PracticeEpisode example = exampleIn(test::emptyHall(8.0, 8.0));
  EXPECT_TRUE(example.is_example);
  EXPECT_EQ(example.kind, 3u);
  ASSERT_FALSE(example.steps.empty());
  EXPECT_TRUE(example.steps.front().chosen);
  EXPECT_EQ(example.steps.front().action, kLeft);
  EXPECT_EQ(example.steps.front().weight, kWeight);
}

TEST(PathExample, LeadsAroundWhatWasSeen) {
  OccupancyGrid hall = test::emptyHall(8.0, 8.0);
  test::fillBox(0.0, 4.0, 5.0, 4.1, &hall);  // its end is seen 63 degrees to the left
  const PracticeEpisode example = exampleIn(std::move(hall));
  ASSERT_FALSE(example.steps.empty());
  EXPECT_EQ(example.steps.front().action, kHalfLeft);
}

TEST(PathExample, HasNothingToLearnWhereTheGoalIsInSight) {
  const PracticeEpisode example = exampleIn(test::emptyHall(8.0, 8.0));
  ASSERT_FALSE(example.steps.empty());
  EXPECT_FALSE(example.steps.back().chosen);
}

TEST(PathExample, HoldsEachStepOnce) {
  const PracticeEpisode example = exampleIn(test::emptyHall(8.0, 8.0));
  const DriveActorCriticParameters usual;
  const auto inputs = usual.policy.encoder.input_layout.size() + kDrivePrivilegedInputs;
  EXPECT_EQ(example.inputs.size(), example.steps.size() * inputs);
  EXPECT_EQ(example.probabilities.size(), example.steps.size() * static_cast<std::size_t>(usual.policy.actions.size()));
}

}  // namespace
}  // namespace lstm_planner::test_path_example
