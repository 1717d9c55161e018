// The commands `lstm_planner maps` and `report` as a user runs them.

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/grid_world/search/grid_distances.hpp"
#include "lstm_planner/grid_world/world/movingai.hpp"
#include "support/picture_check.hpp"
#include "support/tool_test.hpp"

namespace lstm_planner::test_maps_tool {
namespace {

namespace fs = std::filesystem;

class MapsTool : public test::ToolTest {
 protected:
  void success(const std::string& arguments) const {
    const test::Outcome outcome = runTool(arguments);
    ASSERT_EQ(outcome.status, 0) << arguments << "\n" << outcome.output;
  }
};

TEST_F(MapsTool, EachKindWritesMapsWithScenariosOfTheRightLength) {
  for (const std::string kind : {"maze", "random", "rooms", "caves"}) {
    success("maps --kind " + kind + " --count 2 --columns 40 --rows 32 --name it --output " + in(kind));
    for (const char* name : {"it-0.map", "it-1.map"}) {
      const PassableGrid grid = readMovingAiMap(in(kind + "/Maps/" + name));
      EXPECT_EQ(grid.columns(), 40) << kind;
      EXPECT_EQ(grid.rows(), 32) << kind;
      const auto scenarios = readScenarios(in(kind + "/Scenarios/" + name + ".scen"));
      ASSERT_GT(scenarios.size(), 10u) << kind;
      const auto& last = scenarios.back();
      EXPECT_NEAR(GridDistances(grid, last.goal, CornerCutting::kForbidden).at(last.start), last.optimal_length, 1e-3)
          << kind;
    }
  }
}

TEST_F(MapsTool, TheKindBuildingIsAMapServerMapOfTheSizeAskedFor) {
  success("maps --output " + in("house") + " --width 8 --height 6 --resolution 0.1");
  const OccupancyGrid map = readMapServerMap(in("house.yaml"));
  EXPECT_EQ(map.columns(), 80);
  EXPECT_EQ(map.rows(), 60);
}

TEST_F(MapsTool, AFolderWhoseNameIsNoUtf8IsJudgedInLikeAnother) {
  const std::string folder = in("pi\xe8ge");
  success("maps --kind random --columns 32 --rows 32 --output " + folder);
  success("evaluate --agent greedy --scenarios " + folder + " --json " + in("result.json"));
  EXPECT_NE(bytesOf("result.json").find("\"name\": \"pi\xef\xbf\xbdge\""), std::string::npos);
}

TEST_F(MapsTool, TwoSetsOfOneNameAreRefused) {
  success("maps --kind random --columns 32 --rows 32 --output " + in("some"));
  const std::string inside = in("some") + "/Scenarios";
  const test::Outcome twice = runTool("evaluate --agent greedy --scenarios " + in("some") + " " + inside);
  EXPECT_EQ(twice.status, 2);
  EXPECT_NE(twice.output.find("set some is given twice, again in '" + inside + "'"), std::string::npos) << twice.output;
}

TEST_F(MapsTool, EvaluateSaysAndWritesItsResultBeforeItDraws) {
  success("maps --kind maze --corridor-width 4 --columns 48 --rows 48 --name it --output " + in("mazes"));
  // No file may be longer than 2 blocks, which is too little for a picture.
  const test::Outcome outcome =
      runIn("results", "trap '' XFSZ; ulimit -f 2; " + std::string(kTool) + " evaluate --agent astar --scenarios " +
                           in("mazes") + " --count 20 --json result.json --pictures pictures");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.output.find("  100.00%"), std::string::npos) << outcome.output;
  EXPECT_NE(bytesOf("results/result.json").find("\"success\": 1.0"), std::string::npos);
}

TEST_F(MapsTool, EvaluateHasTheOptimumOfItsRules) {
  success("maps --kind maze --corridor-width 4 --columns 48 --rows 48 --name it --output " + in("mazes"));
  const std::string evaluate = "evaluate --agent astar --count 50 --scenarios " + in("mazes");
  const auto ratioOf = [&](const std::string& rules) {
    success(evaluate + rules + " --json " + in("result.json"));
    return nlohmann::json::parse(bytesOf("result.json"))["sets"][0]["mean_ratio"].get<double>();
  };
  EXPECT_NEAR(ratioOf(" --corner-cutting"), ratioOf(""), 0.01) << "A* walks the optimum but for its last cell";
}

TEST_F(MapsTool, ABuildingsNameHasNoEnding) {
  const test::Outcome outcome = runTool("maps --output " + in("house.yaml"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.output.find("house.yaml', expected a path without .yaml, which is added"), std::string::npos)
      << outcome.output;
  EXPECT_TRUE(fs::is_empty(in("")));
}

TEST_F(MapsTool, AnUnknownKindIsRefused) {
  const test::Outcome outcome = runTool("maps --kind jungle --output " + in("jungle"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.output.find("jungle"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("caves"), std::string::npos) << "what would have been accepted: " << outcome.output;
}

TEST_F(MapsTool, ReportShowsHowLongNetworksRemember) {
  success("report --memory-task --delays 3 5 --shown-delay 5 --sequences 64 --epochs 2 --seeds 1 --output " +
          in("memory"));
  const std::string report = bytesOf("memory/memory.md");
  for (const char* said : {"| RNN 8 | 114 |", "| LSTM 8, bias 1 | 402 |", "spectral radius"}) {
    EXPECT_NE(report.find(said), std::string::npos) << said << "\n" << report;
  }
  test::expectPicture(in("memory/sensitivity.png"), 1100, 600);
  for (const char* name : {"figure_2_06", "figure_2_09"}) {
    const cv::Mat picture = cv::imread(in("memory/") + name + ".png", cv::IMREAD_GRAYSCALE);
    ASSERT_FALSE(picture.empty()) << name;
    EXPECT_GT(cv::countNonZero(picture < 60), 1000) << name;  // at least one shade is nearly black
  }
}

TEST_F(MapsTool, ReportComparesTablesOfValuesWithAgents) {
  success("report --q-table --size 16 --maps 1 --starts 5 --episodes 1 50 --agents greedy --output " + in("table.md"));
  const std::string report = bytesOf("table.md");
  for (const char* said : {"| mazes | table, 50 episodes |", "| caves | greedy | - |"}) {
    EXPECT_NE(report.find(said), std::string::npos) << said << "\n" << report;
  }
}

TEST_F(MapsTool, ReportComparesAgentsInTablesAndPictures) {
  success("maps --kind maze --corridor-width 4 --columns 48 --rows 48 --name it --output " + in("mazes"));
  success("report --output " + in("report") + " --scenarios " + in("mazes") +
          " --agents astar dstar boundary lstm=" LSTM_PLANNER_SOURCE_DIR "/models/grid_lstm_2x8.onnx --count 20");
  const std::string report = bytesOf("report/report.md");
  for (const char* agent : {"A*", "D*", "boundary", "LSTM"}) EXPECT_NE(report.find(agent), std::string::npos) << agent;
  EXPECT_NE(report.find("| A* | 100.0 % |"), std::string::npos) << report;
  EXPECT_NE(report.find("paths of at least 0 cells"), std::string::npos) << report;
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(in("report"))) {
    if (entry.path().extension() != ".png") continue;
    ++pictures;
    const cv::Mat picture = cv::imread(entry.path().string(), cv::IMREAD_COLOR);
    ASSERT_FALSE(picture.empty()) << entry.path();
    EXPECT_GT(test::countColoured(picture), 100) << entry.path();
  }
  EXPECT_EQ(pictures, 2) << "success by length, and a figure of the thesis";
  const test::Outcome no_file =
      runTool("report --output " + in("r") + " --scenarios " + in("mazes") + " --agents lstm=");
  EXPECT_EQ(no_file.status, 2) << no_file.output;
  EXPECT_NE(no_file.output.find("agent 'lstm=' has no file behind '='"), std::string::npos) << no_file.output;
}

}  // namespace
}  // namespace lstm_planner::test_maps_tool
