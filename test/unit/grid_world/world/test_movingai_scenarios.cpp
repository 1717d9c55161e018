#include <string>
#include <vector>

#include "unit/grid_world/world/movingai_fixtures.hpp"

namespace lstm_planner::test_movingai_scenarios {
namespace {

class MovingAiScenarios : public MovingAiFiles {
 protected:
  /// What reading says about a file with this one scenario.
  std::string said(const std::string& scenario) const {
    const std::string path = write("a.scen", "version 1\n" + scenario + "\n");
    return refusal([&] { readScenarios(path); });
  }
};

const Scenario kScenario{1, "maps/a.map", 4, 3, {0, 1}, {3, 2}, 3.41421};

TEST_F(MovingAiScenarios, AreReadFieldByField) {
  const std::vector<Scenario> scenarios =
      readScenarios(write("a.scen", "version 1\n1\tmaps/a.map\t512\t256\t144\t48\t150\t49\t6.41421\n"));
  ASSERT_EQ(scenarios.size(), 1u);
  EXPECT_EQ(scenarios[0].bucket, 1);
  EXPECT_EQ(scenarios[0].map, "maps/a.map");
  EXPECT_EQ(scenarios[0].columns, 512);
  EXPECT_EQ(scenarios[0].rows, 256);
  EXPECT_EQ(scenarios[0].start, (CellIndex{144, 48}));
  EXPECT_EQ(scenarios[0].goal, (CellIndex{150, 49}));
  EXPECT_EQ(scenarios[0].optimal_length, 6.41421);
}

TEST_F(MovingAiScenarios, MayHaveForeignLineEndsVersionsAndEmptyLinesAtTheEnd) {
  const std::string line = "0 a.map 4 3 0 1 3 2 3.41421";
  EXPECT_EQ(readScenarios(write("a.scen", "version 1.0\r\n" + line + "\r\n" + line)).size(), 2u);
  EXPECT_EQ(readScenarios(write("a.scen", "version 1\n" + line + "\n\n\n")).size(), 1u);
  EXPECT_EQ(readScenarios(write("a.scen", "version 1\n")).size(), 0u);
}

TEST_F(MovingAiScenarios, MayNameAMapWithBlanks) {
  EXPECT_EQ(readScenarios(write("a.scen", "version 1\n0\tmaps/a  big map.map\t4\t3\t0\t1\t3\t2\t2\n")).at(0).map,
            "maps/a  big map.map");
}

TEST_F(MovingAiScenarios, RefuseOtherVersions) {
  EXPECT_EQ(refusal([&] { readScenarios(write("a.scen", "version 2\n")); }),
            "the scenario file a.scen, line 1: 'version 2', expected 'version 1'");
  EXPECT_EQ(refusal([&] { readScenarios(write("a.scen", "0 a.map 4 3 0 1 3 2 2\n")); }),
            "the scenario file a.scen, line 1: '0 a.map 4 3 0 1 3 2 2', expected 'version 1'");
}

TEST_F(MovingAiScenarios, RefuseBadFieldsWithTheirLine) {
  const std::string where = "the scenario file a.scen, line 2: ";
  EXPECT_EQ(said("0 a.map 4 3 0 1 3 2"),
            where +
                "a scenario of 8 fields, expected 9: bucket, map, its width and height, start column and row, goal "
                "column and row, optimal length");
  EXPECT_EQ(said("-1 a.map 4 3 0 1 3 2 2"), where + "the bucket is '-1', expected a whole number of at least 0");
  EXPECT_EQ(said("0 a\tb.map 4 3 0 1 3 2 2"), where + "the map is 'a\\x09b.map', expected a file's name");
  EXPECT_EQ(said(std::string(5000, ' ')), where + "the line has 5000 letters, expected at most 4096");
  EXPECT_EQ(said("0 a.map 0 3 0 1 3 2 2"), where + "the map's width is '0', expected a whole number of at least 1");
  EXPECT_EQ(said("0 a.map 4 3 0 1 3 x 2"), where + "the goal's row is 'x', expected a whole number of at least 0");
  EXPECT_EQ(said("0 a.map 4 3 0 3 3 2 2"), where + "the start (0, 3) lies outside the map of 4 x 3 cells");
  for (const std::string length : {"far", "-1", "1,5", "nan", "inf", "1e999", "0x10"}) {
    EXPECT_EQ(said("0 a.map 4 3 0 1 3 2 " + length),
              where + "the optimal length is '" + length + "', expected a number of at least 0");
  }
}

TEST_F(MovingAiScenarios, KeepTheirLineNumberBecauseNoneBetweenThemMayBeEmpty) {
  const std::string path = write("a.scen", "version 1\n0 a.map 4 3 0 1 3 2 2\n\n0 a.map 4 3 0 1 3 2 2\n");
  EXPECT_EQ(refusal([&] { readScenarios(path); }).substr(0, 58),
            "the scenario file a.scen, line 3: a scenario of 0 fields, ");
}

TEST_F(MovingAiScenarios, AreWrittenWithSixSignificantDigits) {
  Scenario long_one = kScenario;
  long_one.optimal_length = 1091.99876;
  writeScenarios(in("b.scen"), {kScenario, long_one});
  EXPECT_EQ(contentOf(in("b.scen")),
            "version 1\n1\tmaps/a.map\t4\t3\t0\t1\t3\t2\t3.41421\n1\tmaps/a.map\t4\t3\t0\t1\t3\t2\t1092\n");
  EXPECT_EQ(readScenarios(in("b.scen")).size(), 2u);
}

TEST_F(MovingAiScenarios, AreNotWrittenWhenTheyCouldNotBeReadAgain) {
  std::vector<Scenario> bad(5, kScenario);
  bad[0].map = "";
  bad[1].map = "a\nb.map";
  bad[2].goal = {4, 0};
  bad[3].optimal_length = -1.0;
  bad[4].bucket = -1;
  for (const Scenario& scenario : bad) {
    EXPECT_EQ(
        refusal([&] {
          writeScenarios(in("b.scen"), {kScenario, scenario});
        }),
        "the scenario file b.scen, line 3: not written, expected a map with a name, start and goal inside it, and "
        "a finite length");
  }
  EXPECT_THROW(writeScenarios(in("missing/b.scen"), {kScenario}), MovingAiFileError);
}

TEST_F(MovingAiScenarios, AreCheckedAgainstTheirMap) {
  PassableGrid grid(4, 3, true);
  const auto saidOf = [&](const Scenario& scenario) {
    return refusal([&] { checkScenario(scenario, 7, grid, in("a.scen")); });
  };
  EXPECT_EQ(saidOf(kScenario), "");
  grid.set(kScenario.goal, false);
  const std::string where = "the scenario file a.scen, line 7: ";
  EXPECT_EQ(saidOf(kScenario), where + "the goal (3, 2) lies in a wall of the map");
  Scenario outside = kScenario;
  outside.start = {-1, 0};
  EXPECT_EQ(saidOf(outside), where + "the start (-1, 0) lies outside the map of 4 x 3 cells");
  Scenario other = kScenario;
  other.columns = 5;
  EXPECT_EQ(saidOf(other), where + "a scenario for a map of 5 x 3 cells, but the map has 4 x 3 cells");
}

TEST_F(MovingAiScenarios, FindTheMapThatTheyName) {
  const auto scenariosFor = [&](const std::string& map) {
    return write("set/Scenarios/b-random-1.scen", "version 1\n0\t" + map + "\t1\t1\t0\t0\t0\t0\t0\n");
  };
  const std::string above = write("set/a.map", "type octile\n");
  EXPECT_EQ(mapOfScenarioFile(scenariosFor("a.map")), above);
  const std::string of_the_set = write("set/Maps/b.map", "type octile\n");
  EXPECT_EQ(mapOfScenarioFile(scenariosFor("b.map")), of_the_set);
  EXPECT_EQ(mapOfScenarioFile(scenariosFor("maps/dao/b.map")), of_the_set) << "folders of the benchmark's authors";
  const std::string beside = write("set/Scenarios/b.map", "type octile\n");
  EXPECT_EQ(mapOfScenarioFile(scenariosFor("b.map")), beside);
  const std::string in_folder = write("set/Scenarios/maps/dao/b.map", "type octile\n");
  EXPECT_EQ(mapOfScenarioFile(scenariosFor("maps/dao/b.map")), in_folder);
  const std::string elsewhere = write("elsewhere/b.map", "type octile\n");
  EXPECT_EQ(mapOfScenarioFile(scenariosFor(std::filesystem::absolute(elsewhere).string())),
            std::filesystem::absolute(elsewhere).string());
  EXPECT_EQ(mapNamedIn(scenariosFor("maps/dao/b.map")), "maps/dao/b.map");
}

TEST_F(MovingAiScenarios, FindTheMapInTheLayoutOfHog2) {
  const std::string scenarios = write("scenarios/bg512/a.map.scen", "version 1\n0 maps/bgmaps/a.map 1 1 0 0 0 0 0\n");
  const std::string named = write("maps/bgmaps/a.map", "type octile\n");
  EXPECT_EQ(mapOfScenarioFile(scenarios), named);
  const std::string of_the_set = write("maps/bg512/a.map", "type octile\n");
  EXPECT_EQ(mapOfScenarioFile(scenarios), of_the_set) << "the other one is smaller in that repository";
  const std::string beside = write("scenarios/bg512/a.map", "type octile\n");
  EXPECT_EQ(mapOfScenarioFile(scenarios), beside) << "as everywhere";
}

TEST_F(MovingAiScenarios, GoByTheirFilesNameOnlyWhereTheMapTheyNameIsNotFound) {
  const std::string scenarios = write("set/Scenarios/a.map.scen", "version 1\n0 c.map 1 1 0 0 0 0 0\n");
  EXPECT_EQ(refusal([&] { mapOfScenarioFile(scenarios); }),
            "the scenario file set/Scenarios/a.map.scen names the map 'c.map', and there is none of these: "
            "set/Scenarios/c.map, set/c.map, set/Maps/c.map, set/Scenarios/a.map, set/a.map, set/Maps/a.map, "
            "maps/Scenarios/c.map, c.map");
  const std::string renamed = write("set/Maps/a.map", "type octile\n");
  EXPECT_EQ(mapOfScenarioFile(scenarios), renamed);
  const std::string named = write("set/Maps/c.map", "type octile\n");
  EXPECT_EQ(mapOfScenarioFile(scenarios), named) << "although there is an a.map, too";
}

TEST_F(MovingAiScenarios, WithoutAnyAreForTheMapOfTheirFilesName) {
  const std::string scenarios = write("a.map.scen", "version 1\n");
  EXPECT_EQ(mapNamedIn(scenarios), "");
  EXPECT_EQ(refusal([&] { mapOfScenarioFile(scenarios); }).substr(0, 66),
            "the scenario file a.map.scen names no map, and there is none of th");
  const std::string beside = write("a.map", "type octile\n");
  EXPECT_EQ(mapOfScenarioFile(scenarios), beside);
}

TEST_F(MovingAiScenarios, AreForOneMap) {
  const std::string scenarios = write("a.scen", "version 1\n0 a.map 1 1 0 0 0 0 0\n0 b.map 1 1 0 0 0 0 0\n");
  EXPECT_EQ(
      refusal([&] { mapOfScenarioFile(scenarios); }),
      "the scenario file a.scen, line 3: the map is 'b.map', but that of the lines before is 'a.map', expected one "
      "map a file");
}

}  // namespace
}  // namespace lstm_planner::test_movingai_scenarios
