#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "lstm_planner/drive/decision/drive_trace.hpp"
#include "lstm_planner/practice/dataset_sequences.hpp"
#include "support/refusal.hpp"
#include "unit/simulation/recorded_drives_fixtures.hpp"

namespace lstm_planner::test_dataset_sequences {
namespace {

DatasetSequenceParameters parametersFor(const Dataset& dataset) {
  DatasetSequenceParameters parameters;
  parameters.policy = policyOf(dataset);
  return parameters;
}

Dataset oneEpisode(int steps) {
  Dataset dataset;
  dataset.recordings.emplace_back();
  dataset.recordings[0].description.source = "one.bag";
  dataset.recordings[0].episodes.push_back(driveTowards({3.0, 4.0}, steps));
  return dataset;
}

TEST(DatasetSequences, InputsAreThoseOfTheEncoderAndLabelsThoseOfTheRecording) {
  const Dataset dataset = oneEpisode(7);
  const DatasetSequenceParameters parameters = parametersFor(dataset);
  const std::vector<Sequence> sequences = datasetSequences(dataset, parameters);
  ASSERT_EQ(sequences.size(), 1u);
  ASSERT_EQ(sequences[0].steps(), 7);
  const Encoder encoder(parameters.policy.encoder);
  Eigen::VectorXf expected(encoder.size());
  for (Eigen::Index i = 0; i < 7; ++i) {
    const DriveStep& step = dataset.recordings[0].episodes[0].steps[static_cast<std::size_t>(i)];
    encoder.encode(step.observation, expected);
    EXPECT_EQ(sequences[0].inputs.col(i), expected) << "step " << i;
    EXPECT_EQ(sequences[0].labels[i], step.label);
    EXPECT_EQ(sequences[0].weights[i], 1.0f);
  }
}

TEST(DatasetSequences, PositionIsRoundedAsForThePlannerOfSuchAModel) {
  const Dataset dataset = oneEpisode(5);
  DatasetSequenceParameters parameters = parametersFor(dataset);
  parameters.policy.encoder.position_cell = 0.35;
  const std::vector<Sequence> sequences = datasetSequences(dataset, parameters);
  const DriveStep& step = dataset.recordings[0].episodes[0].steps[3];
  Sectors sectors;
  sectors.range = step.observation.sector_ranges;
  const Encoder encoder(parameters.policy.encoder);
  Eigen::VectorXf expected(encoder.size());
  encoder.encode(observe(sectors, step.pose, step.goal, step.observation.previous_action, 0.35), expected);
  EXPECT_EQ(sequences[0].inputs.col(3), expected);
  encoder.encode(step.observation, expected);
  EXPECT_NE(sequences[0].inputs.col(3), expected);
}

TEST(DatasetSequences, VisitsAreThoseOfTheRecording) {
  Dataset dataset = oneEpisode(1);
  Observation& observation = dataset.recordings[0].episodes[0].steps[0].observation;
  observation.visits[2] = 3.0;
  DatasetSequenceParameters parameters = parametersFor(dataset);
  parameters.policy.encoder.input_layout = {"visits_2"};
  EXPECT_FLOAT_EQ(datasetSequences(dataset, parameters)[0].inputs(0, 0), 0.75f);
}

TEST(DatasetSequences, TheDriveSoFarIsToldAsItWouldBeToTheDriver) {
  const Dataset dataset = oneEpisode(20);
  DatasetSequenceParameters parameters = parametersFor(dataset);
  std::vector<std::string>& layout = parameters.policy.encoder.input_layout;
  layout = {"steps_since_best", "motion_forward", "room_freshness_4", "room_visits"};
  const Encoder encoder(parameters.policy.encoder);
  const Sequence sequence = datasetSequences(dataset, parameters)[0];
  DriveTrace trace;
  for (Eigen::Index step = 0; step < sequence.steps(); ++step) {
    const DriveStep& driven = dataset.recordings[0].episodes[0].steps[static_cast<std::size_t>(step)];
    Observation observation;
    observation.sector_ranges = driven.observation.sector_ranges;
    observation.goal_distance = driven.observation.goal_distance;
    trace.update(driven.pose, &observation);
    Eigen::VectorXf expected(encoder.size());
    encoder.encode(observation, expected);
    EXPECT_TRUE(sequence.inputs.col(step).isApprox(expected, 1e-6f)) << step;
  }
  EXPECT_GT(sequence.inputs(1, 5), 0.0f) << "it drove forward";
}

TEST(DatasetSequences, PiecesNeverCrossEpisodesAndTheLastShortOneIsKept) {
  Dataset dataset = oneEpisode(70);
  dataset.recordings[0].episodes.push_back(driveTowards({-2.0, 1.0}, 20));
  DatasetSequenceParameters parameters = parametersFor(dataset);
  parameters.sequence_steps = 30;
  std::vector<Eigen::Index> lengths;
  for (const Sequence& sequence : datasetSequences(dataset, parameters)) lengths.push_back(sequence.steps());
  EXPECT_EQ(lengths, (std::vector<Eigen::Index>{30, 30, 10, 20}));
}

TEST(DatasetSequences, BurnInRepeatsTheStepsBeforeAPieceWithoutWeight) {
  const Dataset dataset = oneEpisode(50);
  DatasetSequenceParameters parameters = parametersFor(dataset);
  const Sequence whole = datasetSequences(dataset, parameters)[0];
  parameters.sequence_steps = 20;
  parameters.burn_in_steps = 8;
  const std::vector<Sequence> pieces = datasetSequences(dataset, parameters);
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_EQ(pieces[0].inputs, whole.inputs.leftCols(20));  // there is nothing before the first
  EXPECT_EQ(pieces[1].inputs, whole.inputs.middleCols(12, 28));
  EXPECT_EQ(pieces[1].weights.head(8).sum(), 0.0f);
  EXPECT_EQ(pieces[1].weights.tail(20).sum(), 20.0f);
  EXPECT_EQ(pieces[2].inputs, whole.inputs.rightCols(18));
  float counted = 0.0f;
  for (const Sequence& piece : pieces) counted += piece.weights.sum();
  EXPECT_EQ(counted, 50.0f);  // each step once
}

TEST(DatasetSequences, DiscardedEpisodesAndThoseWithoutStepsAreLeftOut) {
  Dataset dataset = oneEpisode(4);
  dataset.recordings[0].episodes.push_back(driveTowards({1.0, 0.0}, 5));
  dataset.recordings[0].episodes.back().episode.discarded = true;
  dataset.recordings[0].episodes.emplace_back();
  const std::vector<Sequence> sequences = datasetSequences(dataset, parametersFor(dataset));
  ASSERT_EQ(sequences.size(), 1u);
  EXPECT_EQ(sequences[0].steps(), 4);
}

/// Ahead, to the left, ahead, ...: zigzags of 0.15 m a step that lead 26.6 degrees to the left.
RecordedEpisode zigzag(int steps) {
  RecordedEpisode recorded;
  for (int number = 0; number < steps; ++number) {
    DriveStep step;
    step.number = number;
    step.pose = {0.15 * ((number + 1) / 2), 0.15 * (number / 2), number % 2 == 0 ? M_PI_2 : 0.0};
    step.next_pose = {0.15 * ((number + 2) / 2), 0.15 * ((number + 1) / 2), number % 2 == 0 ? 0.0 : M_PI_2};
    step.goal = {5.0, 5.0};
    step.driven_angle = number % 2 == 0 ? -M_PI_2 : M_PI_2;
    step.label = number % 2 == 0 ? 0 : 4;
    step.observation = observe({}, step.pose, step.goal, 0.0);
    recorded.steps.push_back(step);
  }
  return recorded;
}

TEST(DatasetSequences, LabelDistanceLooksBeyondTheNextStep) {
  Dataset dataset;
  dataset.recordings.emplace_back();
  dataset.recordings[0].episodes.push_back(zigzag(20));
  DatasetSequenceParameters parameters = parametersFor(dataset);
  parameters.policy.encoder.input_layout = {"previous_action"};
  const Sequence next = datasetSequences(dataset, parameters)[0];
  EXPECT_EQ(next.labels[4], 0);
  EXPECT_EQ(next.labels[5], 4);
  // 0.4 m away lies the diagonal: 45 degrees to the right of a heading to the left, and the other way round.
  parameters.label_distance = 0.4;
  const Sequence far = datasetSequences(dataset, parameters)[0];
  EXPECT_EQ(far.labels[4], 1);
  EXPECT_EQ(far.labels[5], 3);
  // The previous action is that of the new label, in units of 90 degrees.
  EXPECT_EQ(far.inputs(0, 0), 0.0f);
  EXPECT_FLOAT_EQ(far.inputs(0, 5), -0.5f);
  EXPECT_FLOAT_EQ(far.inputs(0, 6), 0.5f);
}

TEST(DatasetSequences, LabelDistanceBeyondTheEndOfAnEpisodeTakesItsLastPose) {
  Dataset dataset;
  dataset.recordings.emplace_back();
  dataset.recordings[0].episodes.push_back(zigzag(3));
  DatasetSequenceParameters parameters = parametersFor(dataset);
  parameters.label_distance = 100.0;
  const Sequence sequence = datasetSequences(dataset, parameters)[0];
  EXPECT_EQ(sequence.labels[0], 1);  // from (0, 0) facing left to (0.30, 0.15): 63 degrees to the right, nearest 45
  EXPECT_EQ(sequence.labels[2], 0);  // the next step is the last
}

TEST(DatasetSequences, LabelsFollowTheAllowedAnglesOfTheNetwork) {
  const Dataset dataset = oneEpisode(6);
  DatasetSequenceParameters parameters = parametersFor(dataset);
  parameters.policy.actions = ActionSet({-1.0, 0.0, 1.0});
  const Sequence sequence = datasetSequences(dataset, parameters)[0];
  const RecordedEpisode& episode = dataset.recordings[0].episodes[0];
  for (Eigen::Index i = 0; i < 6; ++i) {
    EXPECT_EQ(sequence.labels[i],
              parameters.policy.actions.nearest(episode.steps[static_cast<std::size_t>(i)].driven_angle));
  }
}

TEST(DatasetSequences, AnotherRangeCapIsRefusedWithoutScansAndAveragedAnewWithThem) {
  Dataset dataset = oneEpisode(2);
  DatasetSequenceParameters parameters = parametersFor(dataset);
  EXPECT_FALSE(needsScans(dataset, parameters.policy));
  parameters.policy.encoder.range_cap = 4.0;
  EXPECT_TRUE(needsScans(dataset, parameters.policy));
  EXPECT_EQ(test::refusalOf([&] { datasetSequences(dataset, parameters); }),
            "the recording from 'one.bag' has a range cap of 6 m, the network one of 4 m, and without "
            "kept scans the ranges cannot be averaged anew");
  for (DriveStep& step : dataset.recordings[0].episodes[0].steps) {
    step.geometry = {"laser", -M_PI_2, M_PI / 720.0, 721, 0.1, 30.0, {}};
    step.ranges.assign(721, 5.0f);
    std::fill(step.ranges.begin(), step.ranges.begin() + 360, 1.0f);  // the right half
  }
  const Sequence sequence = datasetSequences(dataset, parameters)[0];
  EXPECT_FLOAT_EQ(sequence.inputs(0, 0), 0.25f);
  EXPECT_FLOAT_EQ(sequence.inputs(7, 0), 1.0f);
}

TEST(DatasetSequences, PolicyIsThatOfTheRecordingsAndTheyMayNotDiffer) {
  Dataset dataset = oneEpisode(2);
  dataset.recordings.push_back(dataset.recordings[0]);
  for (Recording& recording : dataset.recordings) {
    recording.description.parameters.range_cap = 5.0;
    recording.description.parameters.agent.step.length = 0.3;
  }
  const PolicyDescription policy = policyOf(dataset);
  EXPECT_EQ(policy.encoder.range_cap, 5.0);
  EXPECT_EQ(policy.step_length, 0.3);
  EXPECT_EQ(policy.actions, ActionSet());  // not the rounded angles of the recording
  dataset.recordings[1].description.parameters.action_angles = {-0.5, 0.0, 0.5};
  EXPECT_NE(test::refusalOf([&] { policyOf(dataset); }).find("differ in action_angles"), std::string::npos);
  EXPECT_NE(test::refusalOf([] { policyOf({}); }).find("no recording"), std::string::npos);
}

}  // namespace
}  // namespace lstm_planner::test_dataset_sequences
