#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "lstm_planner/drive/perception/encoder.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_encoder {
namespace {

Eigen::VectorXf encode(const EncoderParameters& parameters, const Observation& observation) {
  const Encoder encoder(parameters);
  Eigen::VectorXf input(encoder.size());
  encoder.encode(observation, input);
  return input;
}

TEST(Encoder, FollowsTheLayout) {
  EncoderParameters parameters;
  parameters.input_layout = {"previous_action", "sector_7",    "goal_distance",    "goal_bearing",
                             "heading",         "heading_sin", "goal_bearing_cos", "sector_0"};
  Observation observation;
  observation.sector_ranges = {1.5, 6.0, 6.0, 6.0, 6.0, 6.0, 6.0, 3.0};
  observation.goal_distance = 5.0;
  observation.goal_bearing = M_PI / 3.0;
  observation.heading = -M_PI_2;
  observation.previous_action = M_PI_4;
  const Eigen::VectorXf input = encode(parameters, observation);
  const double expected[] = {0.5, 0.5, 0.5, 1.0 / 3.0, -0.5, -1.0, 0.5, 0.25};
  ASSERT_EQ(input.size(), 8);
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(input[i], expected[i], 1e-6) << i;
}

TEST(Encoder, TellsHowOftenTheRobotWasThere) {
  EncoderParameters parameters;
  parameters.input_layout = {"visits_0", "visits_7"};
  Observation observation;
  observation.visits = {0.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 3.0};
  const Eigen::VectorXf input = encode(parameters, observation);
  EXPECT_EQ(input[0], 0.0f);
  EXPECT_NEAR(input[1], 0.75, 1e-6);
}

TEST(Encoder, IsToldNothingThatASearchFound) {
  EncoderParameters parameters;
  parameters.input_layout.push_back("route_bearing_sin");
  EXPECT_THROW(Encoder{parameters}, std::invalid_argument);
}

TEST(Encoder, MakesEventsOfRangesBelowTheirThreshold) {
  EncoderParameters parameters;
  parameters.input_layout = {"event_0", "event_3", "event_7"};
  parameters.event_range = 0.8;
  Observation observation;
  observation.sector_ranges = {0.79, 0.0, 0.0, 0.8, 0.0, 0.0, 0.0, 0.1};
  const Eigen::VectorXf input = encode(parameters, observation);
  EXPECT_EQ(input[0], 1.0f);
  EXPECT_EQ(input[1], 0.0f);
  EXPECT_EQ(input[2], 1.0f);
}

TEST(Encoder, StaysFiniteForEveryFiniteObservation) {
  const double largest = std::numeric_limits<double>::max();
  for (const double value : {largest, -largest, 0.0, 1e-300}) {
    EncoderParameters parameters;
    parameters.input_layout.insert(
        parameters.input_layout.end(),
        {"goal_bearing", "heading", "event_0", "visits_4", "step_visits_0", "room_freshness_7", "hall_freshness_3",
         "room_visits", "behind_best", "steps_since_best", "motion_forward", "motion_left", "motion_turn"});
    Observation observation;
    observation.sector_ranges.fill(value);
    observation.goal_distance = value;
    observation.goal_bearing = value;
    observation.heading = value;
    observation.previous_action = value;
    observation.route_bearing = value;
    observation.visits.fill(value);
    for (PlacesAround& places : observation.places) {
      places.visits.fill(std::abs(value));
      places.ages.fill(value);
    }
    observation.room_visits = value;
    observation.behind_best = value;
    observation.steps_since_best = value;
    observation.motion = {value, value};
    observation.turn = value;
    for (const double length : {value, std::numeric_limits<double>::infinity()}) {
      observation.route_length = length;
      EXPECT_TRUE(encode(parameters, observation).allFinite()) << value;
    }
  }
}

TEST(Encoder, EncodesTheDriveSoFar) {
  EncoderParameters parameters;
  parameters.input_layout = {"room_visits_2",    "room_freshness_2", "room_freshness_3", "hall_visits_2",
                             "steps_since_best", "behind_best",      "motion_forward",   "motion_turn"};
  Observation observation;
  observation.places[1].visits[2] = 2.0;
  observation.places[1].ages[2] = 0.0;
  observation.places[1].ages[3] = 5.0;  // of a place where it never was
  observation.steps_since_best = 8191.0;
  observation.behind_best = 5.0;
  observation.motion = {0.4, 0.0};
  observation.turn = M_PI_2;
  const Eigen::VectorXf input = encode(parameters, observation);
  EXPECT_FLOAT_EQ(input[0], 0.5f);
  EXPECT_FLOAT_EQ(input[1], 1.0f) << "it is there now";
  EXPECT_FLOAT_EQ(input[2], 0.0f);
  EXPECT_FLOAT_EQ(input[3], 0.0f);
  EXPECT_FLOAT_EQ(input[4], 1.0f);
  EXPECT_FLOAT_EQ(input[5], 0.5f);
  EXPECT_FLOAT_EQ(input[6], 0.4f);
  EXPECT_FLOAT_EQ(input[7], 1.0f);
}

TEST(Encoder, RoundsTheHeadingAndTellsTheBearingFromThere) {
  EncoderParameters parameters;
  parameters.input_layout = {"goal_bearing", "heading", "goal_bearing_sin", "heading_cos"};
  parameters.heading_cell = M_PI / 8.0;
  Observation observation;
  observation.heading = 0.9 * M_PI / 8.0;
  observation.goal_bearing = 0.2;
  const Eigen::VectorXf input = encode(parameters, observation);
  EXPECT_NEAR(input[1], 1.0 / 8.0, 1e-6) << "of pi";
  EXPECT_NEAR(input[0] + input[1], (observation.goal_bearing + observation.heading) / M_PI, 1e-6)
      << "the goal lies where it was in the odometry frame";
  EXPECT_NEAR(input[2], std::sin(M_PI * input[0]), 1e-6);
  EXPECT_NEAR(input[3], std::cos(M_PI * input[1]), 1e-6);
  observation.heading = 1.1 * M_PI / 8.0;
  EXPECT_NEAR(encode(parameters, observation)[1], input[1], 1e-6) << "a little turn is not told";
}

TEST(Encoder, RefusesAnInputOfAnotherSize) {
  const Encoder encoder{EncoderParameters()};
  Eigen::VectorXf input(3);
  EXPECT_THROW(encoder.encode({}, input), std::invalid_argument);
}

EncoderParameters readBack(const std::map<std::string, std::string>& metadata) {
  MetadataReader reader(metadata);
  const EncoderParameters parameters = readEncoderParameters(&reader);
  reader.finish();
  return parameters;
}

TEST(EncoderParameters, SurviveTheMetadataBitForBit) {
  EncoderParameters written;
  written.input_layout = {"sector_3", "goal_distance"};
  written.range_cap = 0.1 + 0.2;  // has no short decimal form
  written.position_cell = 0.35;
  written.heading_cell = 0.1 + 0.2;
  std::map<std::string, std::string> metadata;
  writeMetadata(written, &metadata);
  const EncoderParameters read = readBack(metadata);
  EXPECT_EQ(read.input_layout, written.input_layout);
  EXPECT_EQ(read.range_cap, written.range_cap);
  EXPECT_EQ(read.angle_span, written.angle_span);
  EXPECT_EQ(read.position_cell, written.position_cell);
  EXPECT_EQ(read.heading_cell, written.heading_cell);
}

TEST(EncoderParameters, TellTheEventRangeOnlyWhereThereAreEvents) {
  std::map<std::string, std::string> metadata;
  writeMetadata(EncoderParameters{}, &metadata);
  EXPECT_EQ(metadata.count("event_range"), 0u) << "a model without events is written as ever";
  EXPECT_EQ(metadata.count("heading_cell"), 0u);
  EncoderParameters written;
  written.input_layout.push_back("event_0");
  written.event_range = 0.6;
  writeMetadata(written, &metadata);
  EXPECT_EQ(readBack(metadata).event_range, 0.6);
  metadata.erase("event_range");
  EXPECT_THROW(readBack(metadata), std::invalid_argument);
}

TEST(EncoderParameters, NameAllThatIsWrongInTheMetadataAtOnce) {
  std::map<std::string, std::string> metadata;
  writeMetadata(EncoderParameters{}, &metadata);
  metadata.erase("range_cap");
  metadata.erase("angle_scale");
  metadata["distance_scale"] = "far";
  metadata["input_layout"] = "sector_9";
  const std::string refusal = test::refusalOf<std::invalid_argument>([&] { readBack(metadata); });
  for (const char* part : {"range_cap", "angle_scale", "distance_scale is 'far'", "sector_9"}) {
    EXPECT_NE(refusal.find(part), std::string::npos) << part << ": " << refusal;
  }
}

TEST(EncoderParameters, NameWhatIsWrongInTheMetadata) {
  std::map<std::string, std::string> good;
  writeMetadata(EncoderParameters{}, &good);
  const auto refusal = [&good](const std::string& key, const std::string& value) -> std::string {
    std::map<std::string, std::string> metadata = good;
    metadata[key] = value;
    return test::refusalOf<std::invalid_argument>([&] { readBack(metadata); });
  };
  EXPECT_EQ(refusal("range_cap", "6.0 "), "") << "the good metadata with a blank";
  EXPECT_NE(refusal("range_cap", "six").find("range_cap is 'six'"), std::string::npos);
  EXPECT_NE(refusal("range_cap", "-1").find("range_cap is '-1'"), std::string::npos);
  EXPECT_NE(refusal("distance_scale", "nan").find("distance_scale is 'nan'"), std::string::npos);
  EXPECT_NE(refusal("sector_count", "24").find("expected a number in [8, 8]"), std::string::npos);
  EXPECT_NE(refusal("input_layout", "sector_8").find("sector_8"), std::string::npos);
  EXPECT_NE(refusal("input_layout", "heading,heading").find("twice"), std::string::npos);
  EXPECT_NE(refusal("input_layout", "").find("input_layout is empty"), std::string::npos);
  EXPECT_NE(refusal("angle_span", "6.28").find("angle_span is '6.28'"), std::string::npos);
  good.erase("angle_scale");
  EXPECT_NE(refusal("range_cap", "6").find("lack angle_scale"), std::string::npos);
}

}  // namespace
}  // namespace lstm_planner::test_encoder
