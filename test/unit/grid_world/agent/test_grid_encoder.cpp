#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lstm_planner/base/common/random.hpp"
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
  GridMemory memory = makeGridMemory({Inputs::kWalk, 8});
  for (int episode = 0; episode < 20; ++episode) {
    memory.start();
    CellIndex cell{static_cast<int>(uniformIndex(random, 8000)), static_cast<int>(uniformIndex(random, 8000))};
    const CellIndex goal{static_cast<int>(uniformIndex(random, 8000)), static_cast<int>(uniformIndex(random, 8000))};
    for (int step = 0; step < 500; ++step) {
      GridRanges ranges{};
      for (auto& range : ranges) range = static_cast<std::uint8_t>(1 + uniformIndex(random, kGridRayCap));
      memory.observe({cell, goal, ranges});
      for (const Inputs inputs : {Inputs::kThesis, Inputs::kTrace, Inputs::kWalk}) {
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

TEST(GridEncoder, OfTheWalkTellsWhatItsInputsHoldTurnedForEachView) {
  GridMemory memory = makeGridMemory({Inputs::kWalk, 8});
  memory.start();
  const GridRanges open = {50, 50, 50, 50, 50, 50, 50, 50};
  for (int column = 10; column < 50; ++column) {
    memory.observe({{column, 10}, {90, 10}, open});
    memory.step(0);
  }
  const GridEncoder encoder = looking(memory, Inputs::kWalk, 8);
  ASSERT_EQ(encoder.size(), GridEncoder({Inputs::kTrace, 8}).size() + WalkInputs::size({true, true, true}));
  const WalkInputs inputs(*memory.walk(), memory.observation(), 0);
  const int first = GridEncoder::kRayFeatures * kGridRayCount;
  EXPECT_GT(inputs.rays[WalkInputs::kNearer][4], 0.5f) << "back west the start is nearer";
  for (const int view : {0, 3}) {
    const std::vector<float> input = encoded(encoder, view);
    for (int ray = 0; ray < kGridRayCount; ++ray) {
      EXPECT_EQ(input[static_cast<std::size_t>(first + ray)],
                inputs.rays[WalkInputs::kNearer][static_cast<std::size_t>((ray + view) & 7)]);
    }
    EXPECT_EQ(input[input.size() - 7], inputs.scalars[0]);
  }
}

TEST(GridEncoder, APartOfTheWalkHasTheValuesOfTheWholeInTheirOrder) {
  GridMemory memory = makeGridMemory({Inputs::kWalk, 8});
  memory.start();
  for (int column = 10; column < 50; ++column) {
    memory.observe({{column, 10}, {90, 10}, {50, 50, 50, 9, 7, 8, 1, 1}});
    memory.step(0);
  }
  const std::vector<float> whole = encoded(looking(memory, Inputs::kWalk, 8), 3);
  std::size_t of_parts = 0;
  for (const auto& [inputs, size] : {std::pair<Inputs, std::size_t>{Inputs::kStart, 2 * kGridRayCount + 1},
                                     {Inputs::kOpenings, kGridRayCount + 4 + 2},
                                     {Inputs::kHands, 2 * kGridRayCount}}) {
    const std::vector<float> part = encoded(looking(memory, inputs, 8), 3);
    EXPECT_EQ(part.size(), encoded(looking(memory, Inputs::kTrace, 8), 3).size() + size);
    auto next = whole.begin();
    for (const float value : part) {
      next = std::find(next, whole.end(), value);
      ASSERT_NE(next, whole.end()) << nameOf(inputs);
      ++next;
    }
    of_parts += size;
  }
  EXPECT_EQ(of_parts, static_cast<std::size_t>(WalkInputs::size({true, true, true})));
}

TEST(GridEncoder, RefusesToTellOfAWalkThatIsNotRemembered) {
  GridMemory memory;
  memory.start();
  memory.observe({{10, 10}, {10, 40}, {1, 2, 4, 8, 16, 32, 50, 50}});
  EXPECT_THROW(looking(memory, Inputs::kWalk, 8), std::invalid_argument);
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
