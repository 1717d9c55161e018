#include <gtest/gtest.h>

#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/practice/recorded_choices.hpp"
#include "unit/simulation/recorded_drives_fixtures.hpp"

namespace lstm_planner::test_recorded_choices {
namespace {

/// Prefers the same angle whatever it is told.
DrivePolicy always(int action) {
  const PolicyDescription description;
  DenseLayer layer;
  layer.weights.setZero(description.actions.size(), Encoder(description.encoder).size());
  layer.bias = Eigen::VectorXf::Unit(description.actions.size(), action);
  return DrivePolicy(description, {layer});
}

TEST(RecordedChoices, AreThoseOfAllEpisodesThatAreNotDiscarded) {
  Dataset dataset = drivesAllAround(3, 6, 1);
  dataset.recordings[0].episodes[1].episode.discarded = true;
  int episodes = 0;
  forEachRecordedEpisode(dataset, PolicyDescription(), 0.0, [&](const std::vector<RecordedChoice>& choices) {
    const std::vector<DriveStep>& steps = dataset.recordings[0].episodes[episodes == 0 ? 0 : 2].steps;
    ASSERT_EQ(choices.size(), steps.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_EQ(choices[i].label, steps[i].label);
      EXPECT_EQ(choices[i].observation.goal_bearing, steps[i].observation.goal_bearing);
      EXPECT_EQ(choices[i].observation.previous_action, steps[i].observation.previous_action);
    }
    ++episodes;
  });
  EXPECT_EQ(episodes, 2);
}

TEST(RecordedChoices, WhatANetworkPrefersIsCountedByWhatTheDriverDid) {
  const Dataset dataset = drivesAllAround(5, 10, 1);
  ConfusionMatrix expected = ConfusionMatrix::Zero(5, 5);
  for (const RecordedEpisode& episode : dataset.recordings[0].episodes) {
    for (const DriveStep& step : episode.steps) ++expected(step.label, 3);
  }
  EXPECT_EQ(preferencesIn(dataset, always(3)), expected);
  EXPECT_GT((expected.col(3).array() > 0).count(), 1) << "the driver always did the same";
}

}  // namespace
}  // namespace lstm_planner::test_recorded_choices
