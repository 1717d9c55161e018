#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "grid_world/agent/a_star_agent.hpp"
#include "lstm_planner/grid_world/evaluation/grid_episode.hpp"
#include "unit/grid_world/evaluation/grid_fixtures.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_grid_episode {
namespace {

/// The cells of the top row can be walked from end to end; the middle of the second row is blocked.
PassableGrid corridor() { return gridFrom({"..........", "....@@...."}); }

GridEpisode run(const PassableGrid& grid, CellIndex start, CellIndex goal, GridAgent* agent,
                const GridEpisodeRules& rules = {}, std::vector<CellIndex>* path = nullptr) {
  return runGridEpisode(grid, RangeTable(grid), start, goal, rules, agent, path);
}

TEST(GridEpisode, EndsOneCellBeforeTheGoal) {
  ScriptedAgent agent({kEast});
  std::vector<CellIndex> path;
  const GridEpisode episode = run(corridor(), {0, 0}, {9, 0}, &agent, {}, &path);
  EXPECT_EQ(episode.end, GridEpisode::End::kArrived);
  EXPECT_EQ(episode.straight_moves, 8);
  EXPECT_EQ(episode.diagonal_moves, 0);
  ASSERT_EQ(path.size(), 9u);
  EXPECT_EQ(path.front(), (CellIndex{0, 0}));
  EXPECT_EQ(path.back(), (CellIndex{8, 0}));
}

TEST(GridEpisode, CountsDiagonalMovesApart) {
  ScriptedAgent agent({kNorthEast});
  const PassableGrid open(6, 6, true);
  // Rows grow with the direction's rows, whatever side of the file that is.
  const GridEpisode episode = run(open, {0, 0}, {5, 5}, &agent);
  EXPECT_EQ(episode.end, GridEpisode::End::kArrived);
  EXPECT_EQ(episode.straight_moves, 0);
  EXPECT_EQ(episode.diagonal_moves, 4);
  EXPECT_DOUBLE_EQ(episode.length(), 4.0 * std::sqrt(2.0));
}

TEST(GridEpisode, IsOverAtTheFirstCollision) {
  ScriptedAgent agent({kEast});
  const GridEpisode episode = run(corridor(), {1, 1}, {9, 1}, &agent);
  EXPECT_EQ(episode.end, GridEpisode::End::kCollision);
  EXPECT_EQ(episode.steps(), 2) << "the move into the wall at column 4 is not made";
  EXPECT_FALSE(agent.last_moved);
}

TEST(GridEpisode, HoldsCuttingACornerForACollisionUnlessAllowed) {
  // North-east from (0, 0) leads to (1, 1), past the blocked (1, 0).
  const PassableGrid grid = gridFrom({".@...", ".....", "....."});
  ScriptedAgent agent({kNorthEast, kEast});
  GridEpisodeRules rules;
  EXPECT_EQ(run(grid, {0, 0}, {4, 1}, &agent, rules).end, GridEpisode::End::kCollision);
  rules.corner_cutting = CornerCutting::kAllowed;
  rules.max_steps = 1;
  EXPECT_EQ(run(grid, {0, 0}, {4, 1}, &agent, rules).end, GridEpisode::End::kTimeout);
}

TEST(GridEpisode, TimesOutAfterTheLastStepAllowed) {
  ScriptedAgent agent({kEast, kWest});
  GridEpisodeRules rules;
  rules.max_steps = 17;
  const GridEpisode episode = run(corridor(), {0, 0}, {9, 0}, &agent, rules);
  EXPECT_EQ(episode.end, GridEpisode::End::kTimeout);
  EXPECT_EQ(episode.steps(), 17);
  EXPECT_EQ(agent.observations.size(), 17u);
}

TEST(GridEpisode, ArrivesWithTheLastStepAllowed) {
  ScriptedAgent agent({kEast});
  GridEpisodeRules rules;
  rules.max_steps = 8;
  EXPECT_EQ(run(corridor(), {0, 0}, {9, 0}, &agent, rules).end, GridEpisode::End::kArrived);
}

TEST(GridEpisode, WithoutLimitEndsSoonForAnAgentThatRunsInCircles) {
  // An agent without memory of what it saw: the list of the fixture would grow.
  class Shuttle : public GridAgent {
    void start(CellIndex /*start*/, CellIndex /*goal*/) override {}
    void observe(const GridObservation& observation) override { east_ = observation.cell.column == 0; }
    int decide() override { return east_ ? kEast : kWest; }
    GridLeader leader() const override { return GridLeader::kGreedy; }
    std::size_t peakBytes() const override { return sizeof(*this); }
    bool east_ = true;
  } agent;
  GridEpisodeRules rules;
  rules.max_steps = 0;
  const GridEpisode episode = run(corridor(), {0, 0}, {9, 0}, &agent, rules);
  EXPECT_EQ(episode.end, GridEpisode::End::kTimeout);
  EXPECT_EQ(episode.steps(), 2 + circlingSteps(2)) << "both cells are known after two steps";
}

TEST(GridEpisode, CountsWhoLedEachStep) {
  ScriptedAgent agent({kEast, kNorthEast, kWest, kEast, kEast});
  GridEpisodeRules rules;
  rules.max_steps = 5;
  const GridEpisode episode = run(PassableGrid(20, 20, true), {5, 5}, {19, 19}, &agent, rules);
  EXPECT_EQ(episode.led, (std::array<std::int64_t, kGridLeaderCount>{3, 0, 2, 0}));
  EXPECT_EQ(episode.on_path, 1);
  EXPECT_EQ(episode.overruled_by_shield, 1);
  EXPECT_EQ(episode.overruled_by_bound, 4);
}

TEST(GridEpisode, EndsWhenTheAgentKnowsThatThereIsNoPath) {
  ScriptedAgent agent({kEast, kNoPath});
  const GridEpisode episode = run(corridor(), {0, 0}, {9, 0}, &agent);
  EXPECT_EQ(episode.end, GridEpisode::End::kNoPath);
  EXPECT_EQ(episode.steps(), 1);
}

TEST(GridEpisode, ShowsTheAgentWhatTheRaysMeet) {
  ScriptedAgent agent({kEast});
  run(corridor(), {3, 0}, {9, 0}, &agent);
  ASSERT_FALSE(agent.observations.empty());
  const GridObservation& first = agent.observations.front();
  EXPECT_EQ(first.cell, (CellIndex{3, 0}));
  EXPECT_EQ(first.goal, (CellIndex{9, 0}));
  EXPECT_EQ(first.ranges, senseRanges(corridor(), {3, 0}));
}

TEST(GridEpisode, NeedsNoStepWhereTheStartIsNearEnough) {
  ScriptedAgent agent({kEast});
  GridEpisode episode = run(corridor(), {3, 0}, {4, 0}, &agent);
  episode.optimal_length = 1.0;
  EXPECT_EQ(episode.end, GridEpisode::End::kArrived);
  EXPECT_EQ(episode.steps(), 0);
  EXPECT_EQ(episode.ratio(), 1.0) << "0 would praise the agent for nothing";
}

TEST(GridEpisode, CountsTheInputsOfAnAgentThatDoesNotSearch) {
  ScriptedAgent agent({kEast});
  const GridEpisode episode = run(corridor(), {0, 0}, {9, 0}, &agent);
  EXPECT_EQ(episode.expanded, 8);
  EXPECT_EQ(episode.peak_bytes, 108);
}

TEST(GridEpisode, LetsAStarTravelTheOptimumLessTheLastCell) {
  const PassableGrid grid = gridFrom({"...@....", ".@.@.@@.", ".@...@..", ".@@@@@.@", "........"});
  AStarAgent agent(grid);
  GridEpisode episode = run(grid, {0, 0}, {7, 0}, &agent);
  const double optimum = AStar(grid).find({0, 0}, {7, 0}).path.length();
  episode.optimal_length = optimum;
  EXPECT_EQ(episode.end, GridEpisode::End::kArrived);
  EXPECT_DOUBLE_EQ(episode.length(), optimum - 1.0);
  EXPECT_LT(episode.ratio(), 1.0);
  EXPECT_GT(episode.expanded, episode.steps());
}

TEST(GridEpisode, RefusesAStartInAWallAndADecisionThatIsNoDirection) {
  ScriptedAgent agent({8});
  EXPECT_THROW(run(corridor(), {4, 1}, {9, 0}, &agent), std::invalid_argument);
  EXPECT_THROW(run(corridor(), {-1, 0}, {9, 0}, &agent), std::invalid_argument);
  EXPECT_THROW(run(corridor(), {0, 0}, {9, 0}, &agent), std::logic_error);
}

}  // namespace
}  // namespace lstm_planner::test_grid_episode
