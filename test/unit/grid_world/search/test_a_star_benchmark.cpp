#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "grid_world/search/a_star.hpp"
#include "lstm_planner/grid_world/world/movingai.hpp"
#include "support/real_data.hpp"

namespace lstm_planner::test_a_star_benchmark {
namespace {

constexpr int kMapsPerSet = 5;
constexpr int kScenariosPerMap = 16;

std::vector<std::string> scenarioFiles(const std::string& set) {
  std::vector<std::string> files;
  const std::filesystem::path folder = realData("movingai/" + set + "/Scenarios");
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// One unit of the last of six significant digits.
double lastDigit(double length) { return std::pow(10.0, std::floor(std::log10(std::max(length, 1.0))) - 5.0); }

void compareWithOptimum(const std::string& file, std::mt19937& random) {
  const PassableGrid grid = readMovingAiMap(mapOfScenarioFile(file));
  const std::vector<Scenario> scenarios = readScenarios(file);
  AStar search(grid);
  for (int i = 0; i < kScenariosPerMap; ++i) {
    const Scenario& scenario = scenarios[random() % scenarios.size()];
    const GridPath path = search.find(scenario.start, scenario.goal).path;
    // Some Dragon Age maps come with ten scenarios without a path; their length is given as 0.
    ASSERT_EQ(path.found(), scenario.optimal_length > 0.0 || scenario.start == scenario.goal) << file;
    // The benchmark's authors summed up their lengths with rounding: the last digit may be off by one.
    EXPECT_NEAR(path.length(), scenario.optimal_length, lastDigit(scenario.optimal_length)) << file;
  }
}

class AStarOnBenchmark : public testing::TestWithParam<const char*> {};

TEST_P(AStarOnBenchmark, FindsTheOptimalLength) {
  SKIP_WITHOUT_REAL_DATA(realData(std::string("movingai/") + GetParam() + "/Scenarios"));
  const std::vector<std::string> files = scenarioFiles(GetParam());
  std::mt19937 random(4);
  for (int i = 0; i < kMapsPerSet; ++i) compareWithOptimum(files[random() % files.size()], random);
}

INSTANTIATE_TEST_SUITE_P(Sets, AStarOnBenchmark,
                         testing::Values("DragonAge", "Mazes_16w", "Mazes_2w", "Mazes_4w", "Mazes_8w", "Random25",
                                         "Random40"),
                         [](const testing::TestParamInfo<const char*>& set) { return std::string(set.param); });

}  // namespace
}  // namespace lstm_planner::test_a_star_benchmark
