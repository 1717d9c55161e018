#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/grid/map_generators.hpp"
#include "lstm_planner/grid_world/world/map_set.hpp"
#include "unit/grid_world/world/movingai_fixtures.hpp"

namespace lstm_planner::test_map_set {
namespace {

class MapSets : public MovingAiFiles {
 protected:
  void SetUp() override {
    MovingAiFiles::SetUp();
    std::filesystem::create_directories(in("Maps"));
    std::filesystem::create_directories(in("Scenarios"));
  }

  static MapSet mazes() {
    MapSet set;
    set.name = "maze40-3";
    set.count = 2;
    set.generate = [](std::uint64_t seed) { return generateMaze({40, 30, 3, 0.1}, seed); };
    set.scenarios.per_bucket = 2;
    return set;
  }
};

TEST_F(MapSets, AreReadLikeThoseOfTheBenchmark) {
  const std::size_t written = writeMapSet(folder_, mazes());
  std::size_t read = 0;
  for (const std::string name : {"maze40-3-0.map", "maze40-3-1.map"}) {
    const std::string path = in("Scenarios/" + name + ".scen");
    const std::string map_path = mapOfScenarioFile(path);
    EXPECT_EQ(std::filesystem::path(map_path).filename(), name);
    const PassableGrid grid = readMovingAiMap(map_path);
    const std::vector<Scenario> scenarios = readScenarios(path);
    for (std::size_t i = 0; i < scenarios.size(); ++i) {
      checkScenario(scenarios[i], i + kFirstScenarioLine, grid, path);
      EXPECT_EQ(scenarios[i].map, name);
    }
    read += scenarios.size();
  }
  EXPECT_EQ(read, written);
  EXPECT_NE(contentOf(in("Maps/maze40-3-0.map")), contentOf(in("Maps/maze40-3-1.map")));
}

TEST_F(MapSets, AreTheSameForTheSameSeed) {
  writeMapSet(folder_, mazes());
  const std::string map = contentOf(in("Maps/maze40-3-1.map"));
  const std::string scenarios = contentOf(in("Scenarios/maze40-3-1.map.scen"));
  MapSet second = mazes();
  second.count = 1;
  second.seed = mazes().seed + 1;
  writeMapSet(folder_, second);
  EXPECT_EQ(contentOf(in("Maps/maze40-3-0.map")), map) << "map k of seed s is map 0 of seed s + k";
  EXPECT_NE(contentOf(in("Scenarios/maze40-3-0.map.scen")), scenarios) << "but it names itself otherwise";
}

TEST_F(MapSets, AreRefusedWithoutANameACountOrAWay) {
  MapSet bad = mazes();
  for (const std::string name : {"", "a/b", "a b", "../a"}) {
    bad.name = name;
    EXPECT_THROW(writeMapSet(folder_, bad), std::invalid_argument) << name;
  }
  bad = mazes();
  bad.count = 0;
  EXPECT_THROW(writeMapSet(folder_, bad), std::invalid_argument);
  bad = mazes();
  bad.generate = [](std::uint64_t) { return PassableGrid(3, 3, false); };
  EXPECT_THROW(writeMapSet(folder_, bad), std::runtime_error);
  EXPECT_THROW(writeMapSet(in("missing"), mazes()), MovingAiFileError);
}

}  // namespace
}  // namespace lstm_planner::test_map_set
