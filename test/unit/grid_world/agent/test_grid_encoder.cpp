#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_grid_encoder {
namespace {

std::vector<float> encoded(const GridObservation& observation, int previous_direction) {
  std::vector<float> input(kGridInputs);
  encodeGrid(observation, previous_direction, input.data(), 1);
  return input;
}

TEST(GridEncoder, TheInputIsRangesDistanceAngleAndPreviousAction) {
  const std::vector<float> input = encoded({{9, 10}, {9, 40}, {25, 50, 1, 50, 50, 50, 50, 50}}, 4);
  const std::vector<float> expected = {0.5f, 1.0f, 0.02f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 30.0f / 130.0f, 0.5f, 0.0f};
  ASSERT_EQ(input.size(), 11u);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_FLOAT_EQ(input[i], expected[i]) << i;
}

TEST(GridEncoder, WithoutAMoveBeforeSaysWhatTheMiddleDirectionSays) {
  EXPECT_EQ(encoded({{9, 10}, {9, 40}, {}}, kNoPath), encoded({{9, 10}, {9, 40}, {}}, 4));
}

TEST(GridEncoder, InputsStayInTheirRangeWhateverIsObserved) {
  Random random(2);
  const auto coordinate = [&random] { return static_cast<int>(uniformIndex(random, 8000)); };
  for (int step = 0; step < 10000; ++step) {
    GridObservation observation{{coordinate(), coordinate()}, {coordinate(), coordinate()}, {}};
    if (step % 100 == 0) observation.goal = observation.cell;
    for (auto& range : observation.ranges) range = static_cast<std::uint8_t>(1 + uniformIndex(random, kGridRayCap));
    for (const float value : encoded(observation, step % 9 - 1)) ASSERT_TRUE(value >= -1.0f && value <= 1.0f) << value;
  }
}

TEST(GridEncoder, TravelsInTheMetadata) {
  std::map<std::string, std::string> metadata;
  const auto refusal = [&metadata] {
    return test::refusalOf<std::invalid_argument>([&] { checkGridMetadata(metadata); });
  };
  EXPECT_EQ(refusal(), "the model has no grid_inputs, expected one made for the grid world");
  writeGridMetadata(&metadata);
  EXPECT_NO_THROW(checkGridMetadata(metadata));
  metadata["grid_inputs"] = "trace";
  EXPECT_EQ(refusal(), "grid_inputs is 'trace', expected thesis");
}

}  // namespace
}  // namespace lstm_planner::test_grid_encoder
