#include <gtest/gtest.h>

#include <stdexcept>

#include "lstm_planner/grid_world/agent/greedy_agent.hpp"
#include "lstm_planner/grid_world/evaluation/q_table_comparison.hpp"

namespace lstm_planner::test_q_table_comparison {
namespace {

QTableComparisonParameters smallComparison() {
  QTableComparisonParameters parameters;
  parameters.size = 16;
  parameters.maps = 2;
  parameters.starts = 10;
  parameters.episodes = {1, 1500};
  return parameters;
}

TEST(QTableComparison, TablesLearnTheirMapAndTheirGoalAlone) {
  const GridAgentMaker greedy = [](const PassableGrid&) { return std::make_unique<GreedyAgent>(); };
  QTableComparisonParameters parameters = smallComparison();
  parameters.threads = 1;
  const auto outcomes = compareQTables(parameters, {{"greedy", greedy}});
  parameters.threads = 2;
  EXPECT_EQ(toMarkdown(compareQTables(parameters, {{"greedy", greedy}})), toMarkdown(outcomes));
  ASSERT_EQ(outcomes.size(), 3u);
  for (const QTableOutcome& outcome : outcomes) {
    SCOPED_TRACE(outcome.maps);
    ASSERT_EQ(outcome.rows.size(), 4u);
    EXPECT_LT(outcome.rows[0].arrived, 1.0);
    EXPECT_EQ(outcome.rows[1].arrived, 1.0);
    EXPECT_LT(outcome.rows[1].ratio, 1.05);  // shortest but for a few cells that are hardly ever visited
    EXPECT_GT(outcome.rows[1].steps, outcome.rows[0].steps);
    EXPECT_LT(outcome.rows[2].arrived, 0.7) << "for another goal";  // where the other goal is on the path
    EXPECT_EQ(outcome.rows[3].agent, "greedy");
    EXPECT_EQ(outcome.rows[3].steps, 0);
  }
}

TEST(QTableComparison, TellsNothingOfAGoalNearAllStarts) {
  QTableComparisonParameters parameters;
  parameters.size = 8;
  parameters.maps = 1;
  parameters.starts = 1;
  parameters.episodes = {1};
  const std::string table = toMarkdown(compareQTables(parameters, {}));
  EXPECT_NE(table.find("another goal | 67 | - | - |"), std::string::npos) << table;
}

TEST(QTableComparison, RefusesWhatMakesNoSense) {
  QTableComparisonParameters parameters = smallComparison();
  parameters.episodes = {10, 5};
  EXPECT_THROW(validate(parameters), std::invalid_argument);
  parameters = smallComparison();
  parameters.size = 4;
  EXPECT_THROW(validate(parameters), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_q_table_comparison
