#include <gtest/gtest.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "support/refusal.hpp"
#include "support/scratch_folder.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_drive_policy {
namespace {

using Metadata = std::map<std::string, std::string>;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(DrivePolicy, DescriptionSurvivesItsMetadata) {
  PolicyDescription description;
  description.encoder.input_layout = {"sector_3", "goal_distance", "previous_action"};
  description.encoder.range_cap = 4.1;
  description.actions = ActionSet({-1.0 / 3.0, 0.1, 1.7});
  description.step_length = 0.1 + 0.2;  // has no short decimal form
  description.footprint_radius = 0.23;
  description.smallest_radius = 0.1;
  description.largest_radius = 0.3;
  Metadata metadata;
  writeMetadata(description, &metadata);
  const PolicyDescription read = readPolicyDescription(metadata);
  EXPECT_EQ(read.encoder.input_layout, description.encoder.input_layout);
  EXPECT_EQ(read.encoder.range_cap, description.encoder.range_cap);
  EXPECT_TRUE(read.actions == description.actions);
  EXPECT_EQ(read.step_length, description.step_length);
  EXPECT_EQ(read.footprint_radius, description.footprint_radius);
  EXPECT_EQ(read.smallest_radius, description.smallest_radius);
  EXPECT_EQ(read.largest_radius, description.largest_radius);
}

TEST(DrivePolicy, EveryKeyOfTheMetadataIsMissedByName) {
  Metadata complete;
  writeMetadata(PolicyDescription{}, &complete);
  ASSERT_GE(complete.size(), 4u);
  for (const auto& entry : complete) {
    Metadata metadata = complete;
    metadata.erase(entry.first);
    const std::string complaint = test::refusalOf<std::invalid_argument>([&] { readPolicyDescription(metadata); });
    EXPECT_TRUE(contains(complaint, entry.first)) << entry.first << ": " << complaint;
  }
}

TEST(DrivePolicy, MalformedMetadataIsRefused) {
  Metadata complete;
  writeMetadata(PolicyDescription{}, &complete);
  const std::pair<std::string, std::string> bad[] = {
      {"step_length", ""},        {"step_length", "0.4 m"},    {"step_length", "-0.4"},       {"step_length", "nan"},
      {"robot_radius", "0"},      {"robot_radius", "1e999"},   {"action_angles", ""},         {"action_angles", "0.1"},
      {"action_angles", "0.1,x"}, {"action_angles", "0.5,-1"}, {"action_angles", "0.1,,0.5"},
  };
  for (const auto& [key, value] : bad) {
    Metadata metadata = complete;
    metadata[key] = value;
    const std::string complaint = test::refusalOf<std::invalid_argument>([&] { readPolicyDescription(metadata); });
    EXPECT_EQ(complaint.rfind("in the metadata " + key, 0), 0u) << key << " = '" << value << "': " << complaint;
  }
}

TEST(DrivePolicy, RefusesANetworkThatDoesNotFitItsEncoderOrActions) {
  const auto dense = [](int inputs, int outputs) {
    return LayerStack{DenseLayer{Eigen::MatrixXf::Zero(outputs, inputs), Eigen::VectorXf::Zero(outputs)}};
  };
  EXPECT_NO_THROW(DrivePolicy({}, dense(14, 5)));
  const std::string inputs = test::refusalOf<std::invalid_argument>([&] { DrivePolicy({}, dense(11, 5)); });
  EXPECT_EQ(inputs, "the network takes 11 inputs, its input layout has 14");
  const std::string outputs = test::refusalOf<std::invalid_argument>([&] { DrivePolicy({}, dense(14, 8)); });
  EXPECT_EQ(outputs, "the network has 8 outputs, its action set has 5");
}

TEST(DrivePolicy, FitsItsOwnRobotStepAndScanner) {
  const PolicyDescription description;
  EXPECT_NO_THROW(checkFits(description, 0.4));
  EXPECT_TRUE(reachesFarEnough(description, 3.0)) << "half the range cap of 6 m";
  EXPECT_EQ(sizeWarning(description, 0.17425), "");
  EXPECT_EQ(sizeWarning(description, 0.1), "");  // a smaller robot passes wherever the larger one did
}

TEST(DrivePolicy, WarnsOfRobotsThatTheModelWasNeverTriedWith) {
  PolicyDescription description;
  description.smallest_radius = 0.1;
  description.largest_radius = 0.5;
  EXPECT_EQ(sizeWarning(description, 0.1), "");
  EXPECT_EQ(sizeWarning(description, 0.5), "");
  for (const double radius : {0.09, 0.51}) {
    const std::string warning = sizeWarning(description, radius);
    EXPECT_TRUE(contains(warning, "0.1 to 0.5 m") && contains(warning, numberText(radius))) << warning;
  }
}

TEST(DrivePolicy, SaysWhatDoesNotFit) {
  const PolicyDescription description;
  const std::string step = test::refusalOf<std::invalid_argument>([&] { checkFits(description, 0.5); });
  EXPECT_TRUE(contains(step, "step/length") && contains(step, "0.5") && contains(step, "0.4")) << step;
  const std::string radius = sizeWarning(description, 0.3);
  EXPECT_TRUE(contains(radius, "this robot's is 0.3")) << radius;
  EXPECT_FALSE(reachesFarEnough(description, 2.9));
  const std::string range = reachProblem(description, 2.9);
  EXPECT_TRUE(contains(range, "2.9") && contains(range, "range cap")) << range;
}

TEST(DrivePolicy, ComesBackFromItsFile) {
  const test::ScratchFolder folder;
  const std::string path = folder / "model.onnx";
  Model model{test::layersPreferring({0.1f, 0.2f, 0.3f, 0.4f, 0.5f}), {}};
  writeMetadata(PolicyDescription(), &model.metadata);
  writeModelFile(path, model);
  DrivePolicy read = DrivePolicy::fromFile(path);
  const Eigen::VectorXf preferences = read.advance(Observation{});
  EXPECT_EQ(preferences, Eigen::VectorXf((Eigen::VectorXf(5) << 0.1f, 0.2f, 0.3f, 0.4f, 0.5f).finished()));
}

TEST(DrivePolicy, RefusesAFileWhoseMetadataDoNotFitByItsName) {
  const test::ScratchFolder folder;
  const std::string path = folder / "model.onnx";
  const LayerStack layers = test::layersPreferring({0.0f, 0.0f, 0.0f, 0.0f, 0.0f});
  PolicyDescription description;
  description.actions = ActionSet({-1.0, 0.0, 1.0});
  Model model{layers, {}};
  writeMetadata(description, &model.metadata);
  writeModelFile(path, model);
  const std::string sizes = test::refusalOf<ModelFileError>([&] { DrivePolicy::fromFile(path); });
  EXPECT_EQ(sizes, path + ": the network has 5 outputs, its action set has 3");

  writeModelFile(path, {layers, {}});
  const std::string missing = test::refusalOf<ModelFileError>([&] { DrivePolicy::fromFile(path); });
  EXPECT_TRUE(contains(missing, path)) << missing;
}

TEST(DrivePolicy, ForgetsWhenReset) {
  DrivePolicy policy = test::straightAheadPolicy();
  policy.advance(Observation{});
  EXPECT_FALSE(policy.hiddenState().isZero(0.0f));
  policy.reset();
  EXPECT_TRUE(policy.hiddenState().isZero(0.0f));
}

}  // namespace
}  // namespace lstm_planner::test_drive_policy
