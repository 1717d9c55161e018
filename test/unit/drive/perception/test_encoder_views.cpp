#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/drive/perception/encoder.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_encoder_views {
namespace {

EncoderParameters eightViews(const std::vector<std::string>& layout) {
  EncoderParameters parameters;
  parameters.input_layout = layout;
  parameters.views = kDriveViews;
  return parameters;
}

void addGroup(const std::string& stem, std::vector<std::string>* layout) {
  for (int i = 0; i < kDriveViews; ++i) layout->push_back(stem + std::to_string(i));
}

std::vector<float> lookInto(int view, const EncoderParameters& parameters, const Observation& observation) {
  const Encoder encoder(parameters);
  Eigen::VectorXf ahead(encoder.size());
  encoder.encode(observation, ahead);
  std::vector<float> inputs(static_cast<std::size_t>(encoder.size()) * kDriveViews);
  const ViewBearings bearings = bearingsOf(observation);
  encoder.turn(ahead.data(), bearings, inputs.data(), kDriveViews);
  std::vector<float> input;
  for (auto i = static_cast<std::size_t>((bearings.ahead + view) % kDriveViews); i < inputs.size(); i += kDriveViews) {
    input.push_back(inputs[i]);
  }
  return input;
}

TEST(EncoderViews, LeaveOutWhereTheScannerDoesNotLook) {
  std::vector<std::string> layout;
  addGroup("sector_", &layout);
  addGroup("seen_", &layout);
  addGroup("event_", &layout);
  Observation observation;
  observation.sector_ranges = {0.6, 1.2, 1.8, 2.4, 3.0, 3.6, 4.2, 4.8};  // 0.1 .. 0.8 of the cap
  using Values = std::vector<float>;
  const auto first = [&](int view, int group) {
    const Values all = lookInto(view, eightViews(layout), observation);
    return Values(all.begin() + 8 * group, all.begin() + 8 * (group + 1));
  };
  EXPECT_EQ(first(2, 0), (Values{0.5f, 0.6f, 0.7f, 0.8f, 0, 0, 0, 0})) << "to the left";
  EXPECT_EQ(first(2, 1), (Values{1, 1, 1, 1, 0, 0, 0, 0}));
  EXPECT_EQ(first(7, 0), (Values{0, 0, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f})) << "45 degrees to the right";
  EXPECT_EQ(first(7, 2), (Values{0, 0, 1, 0, 0, 0, 0, 0})) << "what is not seen is no event";
  EXPECT_EQ(first(4, 1), Values(8, 0.0f)) << "behind";
}

TEST(EncoderViews, TakeDirectionsRelativeToTheView) {
  std::vector<std::string> layout = {"goal_bearing",   "heading",     "previous_action", "previous_action_cos",
                                     "motion_forward", "motion_left", "goal_distance",   "steps_since_best"};
  addGroup("room_visits_", &layout);
  Observation observation;
  observation.goal_distance = 5.0;
  observation.goal_bearing = M_PI_2;
  observation.heading = 2.0;
  observation.previous_action = M_PI_4;  // and the robot turned on by as much again
  observation.turn = M_PI_2;
  observation.motion = {0.0, 0.4};  // to the left of where it looked, so straight ahead of where it looks now
  observation.places[1].visits = {0, 0, 2, 0, 0, 0, 0, 0};
  const std::vector<float> left = lookInto(2, eightViews(layout), observation);
  EXPECT_NEAR(left[0], 0.0f, 1e-6) << "the goal is ahead of the view";
  EXPECT_NEAR(left[1], -0.5f, 1e-6) << "the robot's heading is to its right";
  EXPECT_NEAR(left[2], -1.5f, 1e-6) << "-135 degrees, relative to the scale of 90";
  EXPECT_NEAR(left[3], -std::sqrt(0.5f), 1e-6);
  EXPECT_NEAR(left[4], 0.0f, 1e-6);
  EXPECT_NEAR(left[5], -0.4f, 1e-6);
  EXPECT_EQ(left[6], 0.5f);
  EXPECT_EQ(left[8], 0.5f) << "the visited place is ahead";
  EXPECT_EQ(left[10], 0.0f);
}

TEST(EncoderViews, DoNotDependOnHowTheOdometryFrameLies) {
  const EncoderParameters parameters = eightViews(EncoderParameters().input_layout);
  Observation observation;
  observation.goal_bearing = 1.0;
  observation.heading = 0.3;
  const std::vector<float> before = lookInto(3, parameters, observation);
  observation.heading = -2.6;
  EXPECT_EQ(lookInto(3, parameters, observation), before);
}

TEST(EncoderViews, KnowTheDirectionNearestToTheHeading) {
  Observation observation;
  const auto ahead = [&observation](double degrees) {
    observation.heading = degreesToRadians(degrees);
    return bearingsOf(observation).ahead;
  };
  EXPECT_EQ(ahead(0.0), 0);
  EXPECT_EQ(ahead(22.0), 0);
  EXPECT_EQ(ahead(23.0), 1);
  EXPECT_EQ(ahead(-23.0), 7);
  EXPECT_EQ(ahead(170.0), 4);
  EXPECT_EQ(ahead(-170.0), 4);
}

TEST(EncoderViews, TravelInTheMetadataWhereThereAreEight) {
  std::map<std::string, std::string> metadata;
  writeMetadata(EncoderParameters(), &metadata);
  EXPECT_EQ(metadata.count("views"), 0u) << "a model with one view is written as ever";
  const auto views = [&metadata] {
    MetadataReader reader(metadata);
    const EncoderParameters parameters = readEncoderParameters(&reader);
    reader.finish();
    return parameters.views;
  };
  EXPECT_EQ(views(), 1);
  writeMetadata(eightViews(EncoderParameters().input_layout), &metadata);
  EXPECT_EQ(views(), 8);
  const auto refusal = [&](const std::string& wrong) {
    metadata["views"] = wrong;
    return test::refusalOf<std::invalid_argument>(views);
  };
  EXPECT_EQ(refusal("3"), "in the metadata views is 3, expected 1 or 8");
  EXPECT_EQ(refusal("1.5"), "in the metadata views is '1.5', expected a whole number");
  EXPECT_EQ(refusal("9"), "in the metadata views is '9', expected a number in [1, 8]");
}

TEST(EncoderViews, NeedEveryDirectionOrNone) {
  EXPECT_NO_THROW(validate(eightViews({"goal_bearing"})));
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([] {
              validate(eightViews({"goal_bearing", "sector_3"}));
            }),
            "input_layout names 1 of sector_0 .. sector_7, expected all of them or none for eight views");
  EncoderParameters three;
  three.views = 3;
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { validate(three); }), "views is 3, expected 1 or 8");
}

}  // namespace
}  // namespace lstm_planner::test_encoder_views
