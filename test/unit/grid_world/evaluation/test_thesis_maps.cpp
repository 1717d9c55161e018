#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/grid_world/evaluation/thesis_maps.hpp"

namespace lstm_planner::test_thesis_maps {
namespace {

GridSetFiles setOf(const std::string& name, int maps) {
  GridSetFiles set{name, {}};
  for (int i = 0; i < maps; ++i)
    set.maps.push_back({std::to_string(i), {name + "/" + std::to_string(i) + ".map.scen"}});
  return set;
}

std::vector<GridSetFiles> benchmark() {
  return {setOf("DragonAge", 30), setOf("Mazes_2w", 8),  setOf("Mazes_4w", 8),
          setOf("Mazes_8w", 8),   setOf("Random25", 12), setOf("Random40", 8)};
}

std::vector<std::string> filesOf(const std::vector<GridMapFiles>& maps) {
  std::vector<std::string> files;
  for (const GridMapFiles& map : maps) files.insert(files.end(), map.scenario_files.begin(), map.scenario_files.end());
  return files;
}

std::string setOfFile(const std::string& file) { return file.substr(0, file.find('/')); }

TEST(ThesisMaps, TrainsOnFiveMapsOfTheFourSetsAndValidatesOnThreeOthers) {
  const ThesisMaps maps = chooseThesisMaps(benchmark(), 1);
  ASSERT_EQ(maps.training.size(), 5u);
  ASSERT_EQ(maps.validation.size(), 3u);
  const std::vector<std::string> training = filesOf(maps.training);
  const std::vector<std::string> validation = filesOf(maps.validation);
  std::set<std::string> all(training.begin(), training.end());
  all.insert(validation.begin(), validation.end());
  EXPECT_EQ(all.size(), 8u) << "no map twice";
  std::set<std::string> sets;
  for (const std::string& file : training) sets.insert(setOfFile(file));
  EXPECT_EQ(sets, (std::set<std::string>{"Mazes_2w", "Mazes_4w", "Random25", "Random40"}));
}

TEST(ThesisMaps, TestsInAtMostTenMapsOfEachSetNoneOfThemTrainedOn) {
  const ThesisMaps maps = chooseThesisMaps(benchmark(), 1);
  ASSERT_EQ(maps.tests.size(), 3u);
  EXPECT_EQ(maps.tests[0].name, "DragonAge");
  EXPECT_EQ(maps.tests[0].maps.size(), 10u);
  EXPECT_EQ(maps.tests[1].maps.size(), 8u) << "where there are fewer, all";
  const std::vector<std::string> training = filesOf(maps.training);
  const std::vector<std::string> validation = filesOf(maps.validation);
  for (const std::string& file : filesOf(maps.tests[2].maps)) {
    EXPECT_EQ(std::count(training.begin(), training.end(), file), 0) << file;
    EXPECT_EQ(std::count(validation.begin(), validation.end(), file), 0) << file;
  }
}

TEST(ThesisMaps, IsTheSameForTheSameSeed) {
  EXPECT_EQ(filesOf(chooseThesisMaps(benchmark(), 7).training), filesOf(chooseThesisMaps(benchmark(), 7).training));
  EXPECT_NE(filesOf(chooseThesisMaps(benchmark(), 7).training), filesOf(chooseThesisMaps(benchmark(), 8).training));
}

TEST(ThesisMaps, KnowsTheSetsByTheNamesInTheBenchmarksArchivesToo) {
  const ThesisMaps maps = chooseThesisMaps({setOf("dao", 3), setOf("maze512-2", 3), setOf("maze512-4", 3),
                                            setOf("random512-25", 3), setOf("random512-40", 3), setOf("maze512-32", 3)},
                                           1);
  EXPECT_EQ(setOfFile(filesOf(maps.training)[0]), "random512-25");
  EXPECT_EQ(setOfFile(filesOf(maps.training)[1]), "maze512-2");
}

TEST(ThesisMaps, SaysWhichSetIsMissing) {
  std::vector<GridSetFiles> sets = benchmark();
  sets.pop_back();
  EXPECT_THROW(chooseThesisMaps(sets, 1), std::invalid_argument);
  sets.push_back(setOf("Random40", 1));
  EXPECT_THROW(chooseThesisMaps(sets, 1), std::invalid_argument) << "one map is none to validate on";
}

}  // namespace
}  // namespace lstm_planner::test_thesis_maps
