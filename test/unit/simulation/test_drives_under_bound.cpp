#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/generated_world.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_drives_under_bound {
namespace {

/// What the bound promises of any network: it arrives where the remembered path does, on paths that are longer by the
/// allowance and the share, 10 % at most in these worlds, and by what it sees from other places, which is chance.
class DrivesUnderBound : public ::testing::Test {
 protected:
  /// Sum of the driven paths, m, of four drives in each of four worlds; fails where one does not arrive.
  static double pathOf(const DrivePolicy& policy, const AgentParameters& parameters) {
    double path = 0.0;
    for (const WorldKind kind : {WorldKind::kMaze, WorldKind::kOffice, WorldKind::kRooms, WorldKind::kCorridors}) {
      const GridWorld world(generateWorld(kind, worldSeed(WorldUse::kValidation, 3, 0)));
      const std::vector<DriveTask> tasks = drawTasks(world, 4, parameters.shield.footprint_radius, 0.12, 4.0, 3);
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        NavigationAgent agent(policy, parameters);
        const DriveResult result = drive(world, tasks[i], test::quickDrive(400.0), i, &agent);
        EXPECT_EQ(static_cast<int>(result.end), static_cast<int>(DriveResult::End::kReached))
            << toString(kind) << ", task " << i << ", after " << result.path_length << " m";
        EXPECT_EQ(result.contacts, 0);
        path += result.path_length;
      }
    }
    return path;
  }

  static double routeLength() {
    static const double length = pathOf(noPolicy(), test::routeLed());
    return length;
  }
};

TEST_F(DrivesUnderBound, ANetworkThatAlwaysAnswersTheSameArrives) {
  const double path = pathOf(test::policyPreferring({0.0f, 0.0f, 0.0f, 0.0f, 1.0f}), AgentParameters());
  RecordProperty("ratio", std::to_string(path / routeLength()));
  EXPECT_LT(path, 1.10 * routeLength());
}

TEST_F(DrivesUnderBound, ANetworkOfRandomWeightsArrives) {
  LayerStack layers = test::layersPreferring({0.0f, 0.0f, 0.0f, 0.0f, 0.0f});
  Random random(1);
  const auto fill = [&random](auto& weights) {
    for (Eigen::Index i = 0; i < weights.size(); ++i)
      weights.data()[i] = static_cast<float>(2.0 * uniform(random) - 1.0);
  };
  RecurrentLayer& memory = std::get<RecurrentLayer>(layers.front());
  fill(memory.input);
  fill(memory.recurrent);
  DenseLayer& output = std::get<DenseLayer>(layers.back());
  fill(output.weights);
  fill(output.bias);
  const double path = pathOf(DrivePolicy(PolicyDescription(), layers), AgentParameters());
  RecordProperty("ratio", std::to_string(path / routeLength()));
  EXPECT_LT(path, 1.10 * routeLength());
}

TEST(EnclosedGoal, IsGivenUpAfterEachWayToItWasLookedForOnce) {
  OccupancyGrid grid = test::emptyHall(6.0, 6.0);
  test::fillBox(2.65, 2.7, 3.35, 3.25, &grid);
  const GridWorld world(grid);
  AgentParameters parameters;
  parameters.goal_drift = 0.0;  // the goal is in the box, and not beside it
  const DrivePolicy policy = DrivePolicy::fromFile(LSTM_PLANNER_SOURCE_DIR "/test/models/goal_seeking.onnx");
  // Four times what was remembered is taken for wrong; then comes the boundary, with room and once more without.
  const double round = 2.0 * (0.7 + 0.55) + 2.0 * M_PI * (parameters.shield.footprint_radius + 0.12);
  for (int seed = 0; seed < 4; ++seed) {
    NavigationAgent agent(policy, parameters);
    const DriveTask task{{1.5, 4.5, M_PI_2 - 0.4 * (seed % 9)}, {3.0, 2.97}, 0.0};
    const DriveResult result = drive(world, task, test::quickDrive(600.0), static_cast<std::uint64_t>(seed), &agent);
    EXPECT_EQ(static_cast<int>(result.end), static_cast<int>(DriveResult::End::kNoPath)) << seed;
    EXPECT_EQ(result.contacts, 0);
    EXPECT_LT(result.path_length, 6.0 * round) << seed;
  }
}

}  // namespace
}  // namespace lstm_planner::test_drives_under_bound
