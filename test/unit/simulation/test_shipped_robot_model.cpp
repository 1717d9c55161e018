#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lstm_planner/practice/drive_judge.hpp"
#include "lstm_planner/practice/step_simulator.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "support/real_data.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_shipped_robot_model {
namespace {

struct Score {
  double arrival = 0.0;
  double efficiency = 0.0;
};

/// Alone: no boundary following, no memory of obstacles. 40 drives in worlds of a kind that no training saw.
Score scoreOf(const DrivePolicy& policy, WorldKind kind, Leader leader = Leader::kNetwork) {
  constexpr int kWorlds = 10;
  constexpr int kMostSteps = 600;
  constexpr std::uint64_t kSeed = 4;
  DriveCourseParameters course;
  course.worlds = {kind};
  course.shortest = 4.0;
  AgentParameters agent = practiceAgent(policy.description());
  agent.leader = leader;
  Score score;
  const std::vector<JudgedDrive> drives =
      judgeEach(policy, agent, course, WorldUse::kJudging, kWorlds, kMostSteps, kSeed, 2);
  for (const JudgedDrive& drive : drives) {
    score.arrival += (drive.arrived ? 1.0 : 0.0) / static_cast<double>(drives.size());
    score.efficiency += drive.efficiency / static_cast<double>(drives.size());
  }
  return score;
}

DrivePolicy randomPolicy() {
  const PolicyDescription description;
  const LayerStack layers =
      initialised(makeNetwork(Encoder(description.encoder).size(), {}, description.actions.size()), 3);
  return DrivePolicy(description, layers);
}

/// A kind of worlds with what the shipped network has to do there, and nothing useless does.
struct Bound {
  WorldKind kind;
  double arrival;
  double efficiency;
  bool greedy_fails;  ///< where nothing is in the way, or poles, going for the goal is enough
};

class ShippedRobotModel : public ::testing::TestWithParam<Bound> {};

TEST_P(ShippedRobotModel, LeadsAloneWhereUselessPoliciesDoNot) {
  const Bound& bound = GetParam();
  const Score shipped = scoreOf(DrivePolicy::fromFile(shippedModel()), bound.kind);
  EXPECT_GE(shipped.arrival, bound.arrival);
  EXPECT_GE(shipped.efficiency, bound.efficiency);
  if (bound.greedy_fails) {
    EXPECT_LT(scoreOf(noPolicy(), bound.kind, Leader::kGreedy).arrival, bound.arrival) << "greedy";
  }
  EXPECT_LT(scoreOf(test::straightAheadPolicy(), bound.kind).arrival, bound.arrival) << "straight on";
  EXPECT_LT(scoreOf(randomPolicy(), bound.kind).arrival, bound.arrival) << "random weights";
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ShippedRobotModel,
    ::testing::Values(Bound{WorldKind::kMaze, 0.7, 0.5, true}, Bound{WorldKind::kOffice, 0.7, 0.5, true},
                      Bound{WorldKind::kCorridors, 0.7, 0.6, true}, Bound{WorldKind::kRooms, 0.8, 0.65, true},
                      Bound{WorldKind::kForest, 0.9, 0.85, false}, Bound{WorldKind::kOpen, 0.99, 0.9, false}),
    [](const auto& info) { return std::string(toString(info.param.kind)); });

}  // namespace
}  // namespace lstm_planner::test_shipped_robot_model
