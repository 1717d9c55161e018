#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>

#include "lstm_planner/grid_world/evaluation/grid_tasks.hpp"
#include "support/folder_test.hpp"
#include "support/refusal.hpp"
#include "unit/grid_world/evaluation/grid_fixtures.hpp"

namespace lstm_planner::test_grid_tasks {
namespace {

namespace fs = std::filesystem;

/// A set in a folder of its own: maps of one row, and scenarios from its left end to every cell.
class GridTasks : public test::FolderTest {
 protected:
  void SetUp() override { fs::create_directories(rows_ / "Scenarios"), fs::create_directories(rows_ / "Maps"); }

  void addMap(const std::string& name, int columns = 40) {
    const PassableGrid grid(columns, 1, true);
    writeMovingAiMap((rows_ / "Maps" / (name + ".map")).string(), grid);
    std::vector<Scenario> scenarios;
    for (int column = 0; column < columns; ++column) {
      scenarios.push_back({column / 4, name + ".map", columns, 1, {0, 0}, {column, 0}, static_cast<double>(column)});
    }
    writeScenarios((rows_ / "Scenarios" / (name + ".map.scen")).string(), scenarios);
  }
  void addMaps(int first, int last) {
    for (int i = first; i <= last; ++i) addMap("row-" + std::to_string(i));
  }
  /// Replaces a map's row by letters of the format.
  void setTerrain(const std::string& name, const std::string& row) const {
    scratch_.write("Rows/Maps/" + name + ".map",
                   "type octile\nheight 1\nwidth " + std::to_string(row.size()) + "\nmap\n" + row + "\n");
  }
  GridSetFiles files() const { return findGridSets(rows_.string()).front(); }
  std::vector<std::string> mapsOf(MapSelection maps) const {
    ScenarioSelection selection;
    selection.maps = maps;
    return drawGridTasks(files(), selection).map_names;
  }

  const fs::path rows_ = scratch_.path() / "Rows";
};

std::vector<int> goals(const GridTaskSet& set) {
  std::vector<int> columns;
  for (const GridTask& task : set.tasks) columns.push_back(100 * static_cast<int>(task.map) + task.goal.column);
  return columns;
}

TEST_F(GridTasks, NamesASetAfterTheFolderAboveScenarios) {
  addMap("row-0");
  for (const fs::path& given : {rows_, rows_ / "Scenarios", rows_ / "", rows_.parent_path()}) {
    const std::vector<GridSetFiles> sets = findGridSets(given.string());
    ASSERT_EQ(sets.size(), 1u) << given;
    EXPECT_EQ(sets[0].name, "Rows") << given;
    EXPECT_EQ(sets[0].maps.size(), 1u) << given;
  }
}

TEST_F(GridTasks, FindsScenariosBesideTheirMaps) {
  addMap("row-0");
  const fs::path beside = rows_.parent_path() / "generated";
  fs::create_directories(beside);
  fs::copy(rows_ / "Maps" / "row-0.map", beside);
  fs::copy(rows_ / "Scenarios" / "row-0.map.scen", beside);
  const GridSetFiles files = findGridSets(beside.string()).front();
  EXPECT_EQ(files.name, "generated");
  EXPECT_EQ(drawGridTasks(files, {}).tasks.size(), 40u);
}

TEST_F(GridTasks, FindsTheSetsInAFolderOfScenarios) {
  addMap("row-0");
  const fs::path root = rows_.parent_path() / "hog2";
  for (const char* set : {"bg512", "dao"}) {
    fs::create_directories(root / "scenarios" / set);
    fs::create_directories(root / "maps" / set);
    fs::copy(rows_ / "Maps" / "row-0.map", root / "maps" / set);
    fs::copy(rows_ / "Scenarios" / "row-0.map.scen", root / "scenarios" / set);
  }
  for (const fs::path& given : {root, root / "scenarios"}) {
    const std::vector<GridSetFiles> sets = findGridSets(given.string());
    ASSERT_EQ(sets.size(), 2u) << given;
    EXPECT_EQ(sets[0].name, "bg512") << given;
    EXPECT_EQ(sets[1].name, "dao") << given;
    EXPECT_EQ(drawGridTasks(sets[1], {}).tasks.size(), 40u) << given;
  }
}

TEST_F(GridTasks, TellsTheSetsOfOneArchiveApartByTheirNames) {
  for (const char* name : {"maze512-8-0", "maze512-8-1", "maze512-16-0"}) addMap(name);
  const std::vector<GridSetFiles> sets = findGridSets(rows_.string());
  ASSERT_EQ(sets.size(), 2u);
  EXPECT_EQ(sets[0].name, "maze512-16");
  EXPECT_EQ(sets[1].name, "maze512-8");
  EXPECT_EQ(sets[1].maps.size(), 2u);
  EXPECT_EQ(findGridSets(rows_.parent_path().string()).size(), 2u) << "also in a folder of sets";
  addMap("arena");
  EXPECT_EQ(findGridSets(rows_.string()).size(), 1u) << "names without numbers are one set";
}

TEST_F(GridTasks, GoesByTheMapsThatScenariosNameNotByTheNamesOfTheirFiles) {
  addMaps(0, 7);
  // As the benchmark for several agents names them: 2 files a map here, with numbers of their own.
  const fs::path scenarios = rows_ / "Scenarios";
  for (int i = 0; i < 8; ++i) {
    const std::string map = "row-" + std::to_string(i);
    fs::copy(scenarios / (map + ".map.scen"), scenarios / (map + "-random-9.scen"));
    fs::rename(scenarios / (map + ".map.scen"), scenarios / (map + "-even-1.scen"));
  }
  EXPECT_EQ(mapsOf(MapSelection::kValidation), (std::vector<std::string>{"row-6", "row-7"}))
      << "not a map whose other scenarios were learnt from, and none twice";
  const GridTaskSet all = drawGridTasks(files(), {});
  EXPECT_EQ(all.maps.size(), 8u);
  EXPECT_EQ(all.tasks.size(), 8u * 2u * 40u);
}

TEST_F(GridTasks, RefusesFoldersWithoutScenarios) {
  EXPECT_THROW(findGridSets((rows_ / "nothing").string()), std::invalid_argument);
  EXPECT_THROW(findGridSets((rows_ / "Maps").string()), std::invalid_argument);
}

TEST_F(GridTasks, KeepsTrainingAndValidationMapsApart) {
  addMaps(0, 7);
  EXPECT_EQ(mapsOf(MapSelection::kTrain),
            (std::vector<std::string>{"row-0", "row-1", "row-2", "row-3", "row-4", "row-5"}));
  EXPECT_EQ(mapsOf(MapSelection::kValidation), (std::vector<std::string>{"row-6", "row-7"}));
  EXPECT_EQ(mapsOf(MapSelection::kAll).size(), 8u);
}

TEST_F(GridTasks, GoesByTheNumberInTheNameNotByThePlace) {
  addMaps(8, 9);
  EXPECT_EQ(mapsOf(MapSelection::kValidation).size(), 2u);
  EXPECT_THROW(mapsOf(MapSelection::kTrain), std::invalid_argument);
}

TEST_F(GridTasks, TrainsOnTheFirstHalfOfALargeSet) {
  for (int i = 0; i < 22; ++i) addMap(std::string(1, static_cast<char>('a' + i)), 2);
  EXPECT_EQ(mapsOf(MapSelection::kTrain).size(), 11u);
  EXPECT_EQ(mapsOf(MapSelection::kTrain).back(), "k");
  EXPECT_EQ(mapsOf(MapSelection::kValidation).front(), "l");
}

TEST_F(GridTasks, TakesLengthsWithinTheLimitsInclusive) {
  addMap("row-0");
  ScenarioSelection selection;
  selection.min_length = 10.0;
  selection.max_length = 12.0;
  EXPECT_EQ(goals(drawGridTasks(files(), selection)), (std::vector<int>{10, 11, 12}));
  selection.min_length = 50.0;
  selection.max_length = 60.0;
  EXPECT_THROW(drawGridTasks(files(), selection), std::invalid_argument);
}

TEST_F(GridTasks, HasTheOptimaOfAgentsThatMayCutCorners) {
  scratch_.write("Rows/Maps/row-0.map", "type octile\nheight 2\nwidth 4\nmap\n.@.@\n..@.\n");
  const auto from_start = [](int column, double length) {
    return Scenario{0, "row-0.map", 4, 2, {0, 0}, {column, 1}, length};
  };
  writeScenarios((rows_ / "Scenarios" / "row-0.map.scen").string(), {from_start(1, 2.0), from_start(3, 7.0)});
  GridTaskSet set = drawGridTasks(files(), {});
  allowCornerCutting(&set, 2);
  EXPECT_DOUBLE_EQ(set.tasks.at(0).optimal_length, moveLength(1));
  EXPECT_DOUBLE_EQ(set.tasks.at(1).optimal_length, 3.0 * moveLength(1)) << "between two corners, too";
}

TEST_F(GridTasks, DrawsTheSameForTheSameSeedAndNothingTwice) {
  addMaps(0, 3);
  ScenarioSelection selection;
  selection.count = 30;
  selection.seed = 7;
  const std::vector<int> drawn = goals(drawGridTasks(files(), selection));
  EXPECT_EQ(drawn, goals(drawGridTasks(files(), selection)));
  EXPECT_EQ(std::set<int>(drawn.begin(), drawn.end()).size(), 30u);
  EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end())) << "map by map";
  selection.seed = 8;
  EXPECT_NE(drawn, goals(drawGridTasks(files(), selection)));
}

TEST_F(GridTasks, DrawsAllWhenThereAreFewerThanAskedFor) {
  addMap("row-0");
  ScenarioSelection selection;
  selection.count = 1000;
  EXPECT_EQ(drawGridTasks(files(), selection).tasks.size(), 40u);
}

TEST_F(GridTasks, LeavesOutGoalsThatCannotBeReached) {
  addMap("row-0", 3);
  const std::string path = (rows_ / "Scenarios" / "row-0.map.scen").string();
  std::vector<Scenario> scenarios = readScenarios(path);
  scenarios[2].optimal_length = 0.0;
  writeScenarios(path, scenarios);
  const GridTaskSet set = drawGridTasks(files(), {});
  EXPECT_EQ(goals(set), (std::vector<int>{0, 1})) << "a path of length 0 to the start itself is none too short";
  EXPECT_EQ(set.without_path, 1u);
}

TEST_F(GridTasks, DrawsTheSameAsEarlierVersions) {
  addMaps(0, 3);
  ScenarioSelection selection;
  selection.count = 6;
  EXPECT_EQ(goals(drawGridTasks(files(), selection)), (std::vector<int>{22, 102, 104, 138, 232, 305}))
      << "or published results could not be repeated";
}

TEST_F(GridTasks, ReadsOnlyTheMapsOfScenariosThatAreDrawn) {
  addMaps(0, 1);
  ScenarioSelection selection;
  selection.count = 1;
  const std::string drawn = drawGridTasks(files(), selection).map_names.at(0);
  fs::remove(rows_ / "Maps" / (drawn == "row-0" ? "row-1.map" : "row-0.map"));
  EXPECT_NO_THROW(drawGridTasks(files(), selection));
}

TEST_F(GridTasks, LeavesOutScenariosInWaterTreesOrWalls) {
  addMap("row-0", 6);
  setTerrain("row-0", ".GSWT@");
  const GridTaskSet set = drawGridTasks(files(), {});
  EXPECT_EQ(goals(set), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(set.with_blocked_end, 3u);
  setTerrain("row-0", "W.....");
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { drawGridTasks(files(), {}); }),
            "set Rows has no scenario to run in its 1 maps: 6 that start or end on a cell that is not passable");
}

TEST_F(GridTasks, LeavesOutByTheThesissRuleAllThatIsNotADot) {
  addMap("row-0", 6);
  setTerrain("row-0", ".GSWT.");
  ScenarioSelection selection;
  selection.rule = PassableRule::kThesis;
  const GridTaskSet set = drawGridTasks(files(), selection);
  EXPECT_EQ(goals(set), (std::vector<int>{0, 5}));
  EXPECT_EQ(set.with_blocked_end, 4u);
}

TEST_F(GridTasks, DrawsAnotherScenarioForEachThatIsLeftOut) {
  addMaps(0, 3);
  setTerrain("row-1", "." + std::string(39, 'W'));
  ScenarioSelection selection;
  selection.count = 100;
  const GridTaskSet set = drawGridTasks(files(), selection);
  const std::vector<int> drawn = goals(set);
  EXPECT_EQ(std::set<int>(drawn.begin(), drawn.end()).size(), 100u) << "121 can be run";
  EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end())) << "map by map";
  EXPECT_GT(set.with_blocked_end, 0u);
  EXPECT_LE(set.with_blocked_end, 39u) << "160 less 121";
  selection.count = 140;
  const GridTaskSet all = drawGridTasks(files(), selection);
  EXPECT_EQ(all.tasks.size(), 121u) << "all that there are";
  EXPECT_EQ(all.with_blocked_end, 39u);
}

TEST_F(GridTasks, SaysWhatWasLeftOutIfNothingIsLeft) {
  addMap("row-0", 6);
  const std::string path = (rows_ / "Scenarios" / "row-0.map.scen").string();
  std::vector<Scenario> scenarios = readScenarios(path);
  scenarios[3].optimal_length = 0.0;
  writeScenarios(path, scenarios);
  ScenarioSelection selection;
  const auto refusal = [&] {
    return test::refusalOf<std::invalid_argument>([&] { drawGridTasks(files(), selection); });
  };
  selection.max_length = 1.5;
  selection.min_length = 1.2;
  EXPECT_EQ(refusal(),
            "set Rows has no scenario to run in its 1 maps: 3 shorter than 1.2 cells, 3 longer than 1.5 cells");
  for (Scenario& scenario : scenarios) scenario.optimal_length = 0.0;
  scenarios.erase(scenarios.begin());
  writeScenarios(path, scenarios);
  EXPECT_EQ(
      test::refusalOf<std::invalid_argument>([&] { drawGridTasks(files(), {}); }),
      "set Rows has no scenario to run in its 1 maps: 5 of the optimal length 0 although start and goal differ: there "
      "is no path");
  writeScenarios(path, {});
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { drawGridTasks(files(), {}); }),
            "set Rows has no scenario to run in its 1 maps: the files name none");
}

TEST_F(GridTasks, RefusesScenariosOfAnotherMap) {
  addMap("row-0", 40);
  writeMovingAiMap((rows_ / "Maps" / "row-0.map").string(), PassableGrid(30, 1, true));
  EXPECT_EQ(test::refusalOf<MovingAiFileError>([&] { drawGridTasks(files(), {}); }),
            "the scenario file " + (fs::canonical(rows_) / "Scenarios" / "row-0.map.scen").string() +
                ", line 2: a scenario for a map of 40 x 1 cells, but the map has 30 x 1 cells");
}

}  // namespace
}  // namespace lstm_planner::test_grid_tasks
