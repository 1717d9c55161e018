#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "support/heap_count.hpp"
#include "support/refusal.hpp"
#include "support/scratch_folder.hpp"
#include "unit/network/network_fixtures.hpp"

namespace lstm_planner::test_drive_policy_views {
namespace {

PolicyDescription eightViews() {
  PolicyDescription description;
  description.encoder.views = kDriveViews;
  return description;
}

LayerStack randomLayers() { return initialised(makeLstmStack(Encoder(eightViews().encoder).size(), {6}, 1), 5); }

DrivePolicy randomPolicy() { return DrivePolicy(eightViews(), randomLayers()); }

/// Remembers in each direction how far the robot went that way: h' = tanh(h + motion).
DrivePolicy policyThatRemembersMotion() {
  PolicyDescription description = eightViews();
  description.encoder.input_layout = {"motion_forward"};
  RecurrentLayer memory;
  memory.input = memory.recurrent = Eigen::MatrixXf::Ones(1, 1);
  memory.bias = Eigen::VectorXf::Zero(1);
  return DrivePolicy(description, {memory, DenseLayer{Eigen::MatrixXf::Ones(1, 1), Eigen::VectorXf::Zero(1)}});
}

Observation someObservation(Random& random) {
  Observation observation;
  for (double& range : observation.sector_ranges) range = uniform(random, 0.1, 6.0);
  observation.goal_distance = uniform(random, 0.5, 10.0);
  observation.goal_bearing = uniform(random, -3.0, 3.0);
  observation.heading = uniform(random, -0.3, 0.3) + std::floor(uniform(random, -4.0, 4.0)) * M_PI_4;
  observation.previous_action = M_PI_4;
  observation.turn = uniform(random, -1.0, 1.0);
  return observation;
}

TEST(DrivePolicyViews, EqualEightNetworksInPlainLoops) {
  DrivePolicy policy = randomPolicy();
  const Encoder encoder(eightViews().encoder);
  std::vector<test::ReferenceNetwork> references(kDriveViews, test::ReferenceNetwork(randomLayers()));
  const std::vector<int> action_views = viewsOf(policy.description().actions);
  Random random(13);
  for (int step = 0; step < 200; ++step) {
    const Observation observation = someObservation(random);
    const Eigen::VectorXf& preferences = policy.advance(observation);
    const ViewBearings bearings = bearingsOf(observation);
    Eigen::VectorXf ahead(encoder.size());
    encoder.encode(observation, ahead);
    Eigen::Matrix<float, Eigen::Dynamic, kDriveViews, Eigen::RowMajor> inputs(encoder.size(), kDriveViews);
    encoder.turn(ahead.data(), bearings, inputs.data(), kDriveViews);
    std::vector<double> outputs;
    for (int view = 0; view < kDriveViews; ++view) {
      outputs.push_back(references[static_cast<std::size_t>(view)].forward(inputs.col(view).cast<double>())[0]);
    }
    for (std::size_t action = 0; action < action_views.size(); ++action) {
      const auto direction = static_cast<std::size_t>((bearings.ahead + action_views[action]) % kDriveViews);
      ASSERT_NEAR(preferences[static_cast<Eigen::Index>(action)], outputs[direction], 1e-5) << "step " << step;
    }
  }
}

TEST(DrivePolicyViews, StatesStayWithTheirDirectionWhenTheRobotTurns) {
  DrivePolicy policy = policyThatRemembersMotion();
  Observation observation;
  observation.motion = {0.4, 0.0};
  const Eigen::VectorXf before = policy.advance(observation);
  EXPECT_GT(before[2], before[1]) << "it went straight ahead";
  observation.motion = {};
  observation.heading = observation.turn = M_PI_4;
  const Eigen::VectorXf after = policy.advance(observation);
  for (int action = 0; action < 4; ++action) {
    EXPECT_NEAR(after[action], std::tanh(before[action + 1]), 1e-6) << "action " << action;
  }
}

TEST(DrivePolicyViews, AWorldTurnedByAnEighthIsTheSameWorld) {
  DrivePolicy policy = randomPolicy();
  DrivePolicy in_turned_world = policy;
  Random random(7);
  for (int step = 0; step < 20; ++step) {
    Observation observation = someObservation(random);
    const Eigen::VectorXf preferences = policy.advance(observation);
    observation.heading = normalizeAngle(observation.heading + M_PI_4);
    EXPECT_EQ(in_turned_world.advance(observation), preferences) << "step " << step;
  }
}

TEST(DrivePolicyViews, ComeBackFromTheirFile) {
  const test::ScratchFolder folder;
  const std::string path = folder / "model.onnx";
  DrivePolicy policy = randomPolicy();
  Model model{randomLayers(), {}};
  writeMetadata(policy.description(), &model.metadata);
  writeModelFile(path, model);
  DrivePolicy read = DrivePolicy::fromFile(path);
  Random random(3);
  for (int step = 0; step < 3; ++step) {
    const Observation observation = someObservation(random);
    EXPECT_EQ(read.advance(observation), policy.advance(observation));
  }
}

TEST(DrivePolicyViews, CopiesGoOnFromTheSameMemoryAndLeaveItAlone) {
  DrivePolicy policy = randomPolicy();
  Random random(9);
  const Observation first = someObservation(random);
  const Observation second = someObservation(random);
  policy.advance(first);
  DrivePolicy preview = policy;
  const Eigen::VectorXf foreseen = preview.advance(second);
  preview.advance(first);
  EXPECT_EQ(policy.advance(second), foreseen);
}

TEST(DrivePolicyViews, ForgetWhenReset) {
  DrivePolicy policy = randomPolicy();
  Random random(11);
  const Observation observation = someObservation(random);
  const Eigen::VectorXf fresh = policy.advance(observation);
  EXPECT_NE(policy.advance(observation), fresh);
  policy.reset();
  EXPECT_EQ(policy.advance(observation), fresh);
}

TEST(DrivePolicyViews, AllocateNothingOnceWarm) {
  if (!heapIsCounted()) GTEST_SKIP() << kHeapIsNotCounted;
  DrivePolicy policy = randomPolicy();
  Random random(2);
  policy.advance(someObservation(random));
  const long before = heapCount().allocations;
  for (int step = 0; step < 10; ++step) policy.advance(someObservation(random));
  EXPECT_EQ(heapCount().allocations, before);
}

TEST(DrivePolicyViews, RefuseWhatDoesNotFit) {
  const LayerStack one_output = makeLstmStack(14, {4}, 1);
  EXPECT_NO_THROW(DrivePolicy(eightViews(), one_output));
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([] { DrivePolicy(eightViews(), makeLstmStack(14, {4}, 5)); }),
            "the network has 5 outputs, eight views have 1");
  PolicyDescription between = eightViews();
  between.actions = ActionSet({-M_PI_4, 0.0, 0.5});
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { DrivePolicy(between, one_output); }),
            "eight views need steering angles that are multiples of 45 degrees, one is 0.5 rad");
}

}  // namespace
}  // namespace lstm_planner::test_drive_policy_views
