#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"

namespace lstm_planner::test_grid_encoder {
namespace {

using Inputs = GridEncoderParameters::Inputs;

std::vector<float> encoded(const GridEncoder& encoder, int view) {
  std::vector<float> input(static_cast<std::size_t>(encoder.size()));
  encoder.encode(view, input.data(), 1);
  return input;
}

GridEncoder looking(const GridMemory& memory, Inputs inputs, int views) {
  GridEncoder encoder({inputs, views});
  encoder.prepare(memory);
  return encoder;
}

TEST(GridEncoder, TheThesissInputIsRangesDistanceAngleAndPreviousAction) {
  GridMemory memory;
  memory.start();
  memory.observe({{10, 10}, {10, 40}, {25, 50, 1, 50, 50, 50, 50, 50}});
  memory.step(4);
  memory.observe({{9, 10}, {9, 40}, {25, 50, 1, 50, 50, 50, 50, 50}});
  const GridEncoder encoder = looking(memory, Inputs::kThesis, 1);
  const std::vector<float> expected = {0.5f, 1.0f, 0.02f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 30.0f / 130.0f, 0.5f, 0.0f};
  ASSERT_EQ(encoder.size(), 11);
  const std::vector<float> input = encoded(encoder, 0);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_FLOAT_EQ(input[i], expected[i]) << i;
}

TEST(GridEncoder, AViewSeesWhatLiesAheadOfItFirst) {
  GridMemory memory;
  memory.start();
  memory.observe({{10, 10}, {10, 40}, {1, 2, 4, 8, 16, 32, 50, 50}});
  const GridEncoder encoder = looking(memory, Inputs::kTrace, 8);
  const int goal = GridEncoder::kRayFeatures * kGridRayCount;
  const std::vector<float> ahead = encoded(encoder, 2);
  EXPECT_FLOAT_EQ(ahead[0], std::log2(4.0f) / std::log2(50.0f));
  EXPECT_FLOAT_EQ(ahead[7], std::log2(2.0f) / std::log2(50.0f));
  EXPECT_FLOAT_EQ(ahead[goal], 1.0f);
  EXPECT_NEAR(ahead[goal + 1], 0.0f, 1e-6f);
  // Two views to the left the goal lies at the right hand, an angle of -90 degrees.
  EXPECT_NEAR(encoded(encoder, 4)[goal + 1], -1.0f, 1e-6f);
}

TEST(GridEncoder, RemembersWhereItCameFrom) {
  GridMemory memory;
  memory.start();
  const GridRanges open = {50, 50, 50, 50, 50, 50, 50, 50};
  memory.observe({{10, 10}, {90, 10}, open});
  memory.step(0);
  memory.observe({{11, 10}, {90, 10}, open});
  const std::vector<float> input = encoded(looking(memory, Inputs::kTrace, 8), 0);
  const int freshness = 1 * kGridRayCount;
  const int frequency = 2 * kGridRayCount;
  EXPECT_FLOAT_EQ(input[freshness + 4], 1.0f - 1.0f / 16.0f);  // one step ago: log2(2) of 16
  EXPECT_FLOAT_EQ(input[frequency + 4], 1.0f / 3.0f);
  EXPECT_FLOAT_EQ(input[freshness + 0], 0.0f);
}

TEST(GridEncoder, InputsStayInTheirRangeWhateverIsObserved) {
  Random random(2);
  GridMemory memory = makeGridMemory({Inputs::kBoundary, 8});
  for (int episode = 0; episode < 20; ++episode) {
    memory.start();
    CellIndex cell{static_cast<int>(uniformIndex(random, 8000)), static_cast<int>(uniformIndex(random, 8000))};
    const CellIndex goal{static_cast<int>(uniformIndex(random, 8000)), static_cast<int>(uniformIndex(random, 8000))};
    for (int step = 0; step < 500; ++step) {
      GridRanges ranges{};
      for (auto& range : ranges) range = static_cast<std::uint8_t>(1 + uniformIndex(random, kGridRayCap));
      memory.observe({cell, goal, ranges});
      for (const Inputs inputs : {Inputs::kThesis, Inputs::kTrace, Inputs::kBoundary}) {
        for (const float value : encoded(looking(memory, inputs, 8), step % 8)) {
          ASSERT_TRUE(value >= -1.0f && value <= 1.5f) << value;
        }
      }
      const int direction = static_cast<int>(uniformIndex(random, 8));
      memory.step(direction);
      cell = cellBeside(cell, direction);
    }
  }
}

TEST(GridEncoder, OfTheBoundaryTellsWhatItsInputsHoldTurnedForEachView) {
  GridMemory memory = makeGridMemory({Inputs::kBoundary, 8});
  memory.start();
  // An obstacle to the east, which it follows to the north.
  const GridRanges walled = {1, 1, 50, 50, 50, 50, 50, 1};
  for (int row = 10; row < 15; ++row) {
    memory.observe({{10, row}, {90, 10}, walled});
    memory.step(2);
  }
  const GridEncoder encoder = looking(memory, Inputs::kBoundary, 8);
  ASSERT_EQ(encoder.size(), GridEncoder({Inputs::kTrace, 8}).size() + BoundaryInputs::kCount);
  const BoundaryInputs inputs(*memory.boundary(), memory.observation());
  const std::size_t first = GridEncoder::kRayFeatures * kGridRayCount;
  EXPECT_EQ(inputs.rays[BoundaryInputs::kRightHand][2], 1.0f);
  EXPECT_EQ(inputs.rays[BoundaryInputs::kOtherEnd][6], 1.0f);
  for (const int view : {0, 3}) {
    const std::vector<float> input = encoded(encoder, view);
    for (std::size_t feature = 0; feature < BoundaryInputs::kRayFeatures; ++feature) {
      for (int ray = 0; ray < kGridRayCount; ++ray) {
        EXPECT_EQ(input[first + feature * kGridRayCount + static_cast<std::size_t>(ray)],
                  inputs.rays[feature][static_cast<std::size_t>((ray + view) & 7)]);
      }
    }
    EXPECT_TRUE(std::equal(inputs.scalars.begin(), inputs.scalars.end(), input.end() - BoundaryInputs::kScalars));
  }
}

TEST(GridEncoder, AllViewsAtOnceSeeWhatEachSees) {
  GridMemory memory = makeGridMemory({Inputs::kBoundary, 8});
  memory.start();
  for (int row = 10; row < 15; ++row) {
    memory.observe({{10, row}, {90, 40}, {1, 1, 50, 9, 7, 8, 20, 1}});
    memory.step(2);
  }
  for (const Inputs inputs : {Inputs::kThesis, Inputs::kTrace, Inputs::kBoundary}) {
    const GridEncoder encoder = looking(memory, inputs, 8);
    constexpr int kStride = 11;
    std::vector<float> all(static_cast<std::size_t>(encoder.size() * kStride));
    encoder.encodeViews(all.data(), kStride);
    for (int view = 0; view < 8; ++view) {
      const std::vector<float> one = encoded(encoder, view);
      for (std::size_t i = 0; i < one.size(); ++i) {
        ASSERT_EQ(all[i * kStride + static_cast<std::size_t>(view)], one[i]) << nameOf(inputs) << ' ' << i;
      }
    }
  }
}

TEST(GridEncoder, RefusesToTellOfABoundaryThatIsNotRemembered) {
  GridMemory memory;
  memory.start();
  memory.observe({{10, 10}, {10, 40}, {1, 2, 4, 8, 16, 32, 50, 50}});
  try {
    looking(memory, Inputs::kBoundary, 8);
    FAIL() << "was not refused";
  } catch (const std::invalid_argument& refusal) {
    EXPECT_STREQ(refusal.what(), "grid_inputs is boundary, expected a memory of the boundary");
  }
}

TEST(GridEncoder, TravelsInTheMetadata) {
  std::map<std::string, std::string> metadata;
  writeMetadata(GridEncoderParameters{Inputs::kThesis, 1}, &metadata);
  const GridEncoderParameters parameters = readGridEncoderParameters(metadata);
  EXPECT_EQ(parameters.inputs, Inputs::kThesis);
  EXPECT_EQ(parameters.views, 1);
  metadata["grid_inputs"] = "smells";
  EXPECT_THROW(readGridEncoderParameters(metadata), std::invalid_argument);
  EXPECT_THROW(GridEncoder({Inputs::kTrace, 3}), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_grid_encoder
