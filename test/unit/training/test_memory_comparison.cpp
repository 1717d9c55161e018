#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "lstm_planner/training/memory_comparison.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_memory_comparison {
namespace {

MemoryComparisonParameters shortComparison() {
  MemoryComparisonParameters parameters;
  parameters.delays = {2, 6};
  parameters.shown_delay = 6;
  parameters.sequences = 100;
  parameters.measured_sequences = 2;
  parameters.epochs = 2;
  parameters.seeds = 2;
  return parameters;
}

TEST(MemoryComparison, SaysAccuracyAndSensitivityOfEachNetworkForAnyNumberOfThreads) {
  MemoryComparisonParameters parameters = shortComparison();
  parameters.threads = 1;
  const auto outcomes = compareMemory(parameters, memoryNetworks());
  parameters.threads = 2;
  EXPECT_EQ(memoryTables(parameters, compareMemory(parameters, memoryNetworks())), memoryTables(parameters, outcomes));
  ASSERT_EQ(outcomes.size(), 6u);
  EXPECT_EQ(outcomes[0].weights, 8u * (3 + 8 + 1) + 2 * (8 + 1));
  EXPECT_NEAR(static_cast<double>(outcomes[1].weights), static_cast<double>(outcomes[5].weights), 10.0);
  for (const MemoryOutcome& outcome : outcomes) {
    SCOPED_TRACE(outcome.network.name);
    ASSERT_EQ(outcome.accuracies.size(), 2u);
    EXPECT_EQ(outcome.accuracies[0].size(), 2u);
    EXPECT_EQ(outcome.after.rows(), outcome.network.shape.cells[0]);
    EXPECT_EQ(outcome.after.cols(), 7);
    EXPECT_NE(outcome.after, outcome.before);
    EXPECT_EQ(relativeSensitivity(outcome.before)[0], 1.0);
    EXPECT_EQ(outcome.radius_after > 0.0, outcome.network.shape.kind == NetworkShape::Kind::kRnn);
  }
}

TEST(MemoryComparison, EndsWithTheNetworksThatAreComplete) {
  const auto outcomes = compareMemory(shortComparison(), memoryNetworks(), [](double share) { return share < 0.5; });
  EXPECT_EQ(outcomes.size(), 2u);
}

TEST(MemoryComparison, TellsNothingOfUnitsThatDependOnNoInput) {
  MemoryComparisonParameters parameters = shortComparison();
  parameters.sequences = 2;
  parameters.learning_rate = 100.0;  // saturates all units
  const std::string tables = memoryTables(parameters, compareMemory(parameters, {memoryNetworks().front()}));
  EXPECT_EQ(tables.find("nan"), std::string::npos) << tables;
}

TEST(MemoryComparison, RefusesADelayThatIsNotMeasured) {
  MemoryComparisonParameters parameters = shortComparison();
  const auto refusal = [&] { return test::refusalOf<std::invalid_argument>([&] { validate(parameters); }); };
  parameters.shown_delay = 5;
  EXPECT_EQ(refusal(), "parameter shown_delay is 5, expected one of the delays");
  parameters = shortComparison();
  parameters.delays = {};
  EXPECT_EQ(refusal(), "delays is empty, expected at least one");
}

}  // namespace
}  // namespace lstm_planner::test_memory_comparison
