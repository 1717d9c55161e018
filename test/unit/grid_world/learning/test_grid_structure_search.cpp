#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "lstm_planner/grid_world/learning/grid_structure_search.hpp"
#include "unit/grid_world/learning/grid_learning_fixtures.hpp"

namespace lstm_planner::test_grid_structure_search {
namespace {

GridImitationParameters tinySearch(int threads) {
  GridImitationParameters parameters = thesisImitation();
  parameters.course = smallCourse();
  parameters.dataset.steps = 300;
  parameters.validation_steps = 100;
  parameters.trainer.epochs = 2;
  parameters.threads = threads;
  return parameters;
}

std::vector<StructureOutcome> search(int threads, const std::vector<StructureTrial>& trials,
                                     const std::function<bool(double)>& progress = {}) {
  return searchGridStructures(tinySearch(threads), trials, {{smallCave(1)}}, {{smallCave(2)}}, progress);
}

TEST(StructureSearch, TriesWhatTheThesisTried) {
  const std::vector<StructureTrial> trials = thesisTrials();
  EXPECT_EQ(trials.size(), 14u);
  const auto best = std::max_element(trials.begin(), trials.end(), [](const auto& a, const auto& b) {
    return a.thesis_accuracy.value_or(0.0) < b.thesis_accuracy.value_or(0.0);
  });
  EXPECT_EQ(best->structure(), "2 LSTM layers - 8 cells");  // its final model
  EXPECT_EQ(best->sequence_steps, 512);
}

TEST(StructureSearch, GivesTheSameAccuraciesForAnyNumberOfThreads) {
  const std::vector<StructureTrial> trials = {{1, 1, 4, 128, std::nullopt}, {4, 2, 8, 512, 0.886}};
  const auto one = search(1, trials);
  const auto three = search(3, trials);
  ASSERT_EQ(one.size(), 2u);
  ASSERT_EQ(three.size(), 2u);
  EXPECT_EQ(one[1].weights, 1256u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(one[i].validation_accuracy, three[i].validation_accuracy);
    EXPECT_EQ(one[i].training_accuracy, three[i].training_accuracy);
  }
}

TEST(StructureSearch, LearnsMoreInMoreEpochs) {
  GridImitationParameters parameters = tinySearch(2);
  const std::vector<StructureTrial> trials = {{1, 1, 8, 128, std::nullopt}};
  const auto accuracy = [&](int epochs) {
    parameters.trainer.epochs = epochs;
    const auto outcome = searchGridStructures(parameters, trials, {{smallCave(1)}}, {{smallCave(2)}});
    return outcome.at(0).validation_accuracy;
  };
  // One answer out of eight.
  EXPECT_LT(accuracy(1), 0.3);
  EXPECT_GT(accuracy(100), 0.6);
}

TEST(StructureSearch, EndsWhenToldAndKeepsWhatIsDone) {
  const std::vector<StructureTrial> trials = {{1, 1, 4, 128, {}}, {1, 1, 4, 256, {}}, {1, 1, 4, 512, {}}};
  // Two epochs of six are the first structure.
  const auto outcomes = search(1, trials, [](double share) { return share < 0.5; });
  ASSERT_EQ(outcomes.size(), 1u);
  EXPECT_EQ(outcomes[0].trial.sequence_steps, 128);
}

TEST(StructureSearch, TablesHaveTheThesisBesideTheOutcome) {
  const std::vector<StructureOutcome> outcomes = {{{1, 1, 4, 128, std::nullopt}, 264, 0.9, 0.8, 2},
                                                  {{1, 1, 4, 512, 0.8402}, 264, 0.91, 0.81, 3},
                                                  {{2, 2, 2, 1024, 0.7552}, 200, 0.92, 0.82, 4}};
  const std::string tables = structureTables(outcomes);
  EXPECT_NE(tables.find("| 1 LSTM layer - 4 cells | 264 | - | 80.00 % | 84.02 % | 81.00 % |"), std::string::npos);
  // Table 3.3 has the first structure again, and nothing where nothing was tried.
  EXPECT_NE(tables.find("Table 3.3"), std::string::npos);
  EXPECT_NE(tables.find("| 1 LSTM layer - 4 cells | 264 | 84.02 % | 81.00 % | - | - |"), std::string::npos);
  EXPECT_NE(tables.find("| 2 LSTM layers - 2 cells | 200 | - | - | 75.52 % | 82.00 % |"), std::string::npos);
  EXPECT_EQ(tables.find("Table 3.5"), std::string::npos);
  const std::string csv = structureCsv(outcomes);
  EXPECT_NE(csv.find("\n1,1,4,264,128,,0.8,0.9,2\n"), std::string::npos);
  EXPECT_NE(csv.find("\n1,1,4,264,512,0.8402,0.81,0.91,3\n"), std::string::npos);
}

}  // namespace
}  // namespace lstm_planner::test_grid_structure_search
