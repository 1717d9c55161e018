// The command `lstm_planner drive` as a user runs it.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "support/picture_check.hpp"
#include "support/real_data.hpp"
#include "support/tool_test.hpp"

namespace lstm_planner::test_drive_tool {
namespace {

class DriveTool : public test::ToolTest {
 protected:
  static test::Outcome drive(const std::string& arguments) { return runTool("drive " + arguments); }

  /// Drives with the shipped model and reads the JSON file that comes out.
  nlohmann::json result(const std::string& arguments) const {
    const test::Outcome outcome = drive("--model " + shippedModel() + " --json " + in("out.json") + " " + arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    std::ifstream file(in("out.json"));
    return nlohmann::json::parse(file, nullptr, false);
  }

  std::size_t picturesNamed(const std::string& start) const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(in("pictures"))) {
      if (entry.path().filename().string().rfind(start, 0) != 0) continue;
      test::expectPicture(entry.path().string());
      ++count;
    }
    return count;
  }
};

int ends(const nlohmann::json& json) {
  return json["reached"].get<int>() + json["timeouts"].get<int>() + json["no_path"].get<int>() +
         json["stuck"].get<int>() + json["elsewhere"].get<int>();
}

TEST_F(DriveTool, JudgesDrivesAmongPeopleAlikeByAnyNumberOfThreads) {
  const std::string arguments = "--walkers 3 --goals 3 --drift 0.02 --seed 4 --time-limit 40 ";
  const nlohmann::json by_one = result(arguments + "--threads 1 --details " + in("details.csv"));
  EXPECT_EQ(by_one["goals"], 3);
  EXPECT_EQ(ends(by_one), 3);
  EXPECT_EQ(by_one["walkers"], 3);
  EXPECT_EQ(by_one["drift"], 0.02);
  for (const char* key : {"contacts", "bumped", "mean_ratio", "p95_ratio", "mean_time_s", "mean_goal_error_m"}) {
    EXPECT_TRUE(by_one[key].is_number()) << key;
  }
  ASSERT_EQ(by_one["worlds"].size(), 1u);
  EXPECT_EQ(by_one["worlds"][0]["name"], "room");
  std::ifstream details(in("details.csv"));
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(details), {}, '\n'), 4) << "a head and a line a goal";
  EXPECT_EQ(by_one, result(arguments + "--threads 2"));
}

TEST_F(DriveTool, ScoresBarnWorlds) {
  std::ofstream(in("cylinders.csv")) << "world,x,y\n3,-2.25,7\n5,-4,7\n5,-0.5,7\n";
  std::ofstream(in("barn_reference_paths.csv")) << "world,path_length_m\n3,10.1\n5,10\n";
  const nlohmann::json json = result("--barn " + in("cylinders.csv") + " --only 5");
  EXPECT_EQ(json["goals"], 1);
  EXPECT_EQ(json["reached"], 1) << "nothing is in the way";
  EXPECT_EQ(json["worlds"][0]["name"], "barn-5");
  // The reference's time is 5 s. 9 m at 0.3 m/s take 30 s, and 8 times the reference, the limit, is 40 s.
  EXPECT_GT(json["barn_score_k4"].get<double>(), 1.0 / 8.0);
  EXPECT_LE(json["barn_score_k4"].get<double>(), 5.0 / 30.0);
  EXPECT_EQ(json["barn_score_k4"], json["barn_score_k2"]) << "too slow for the difference";
}

TEST_F(DriveTool, GivesNoBarnScoreWithoutReferencePaths) {
  std::ofstream(in("cylinders.csv")) << "world,x,y\n3,-2.25,7\n5,-4,7\n5,-0.5,7\n";
  const test::Outcome outcome = drive("--barn " + in("cylinders.csv") + " --only 5 --json " + in("result.json"));
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("barn_reference_paths.csv"), std::string::npos) << outcome.output;
  EXPECT_EQ(outcome.output.find("k = 4"), std::string::npos) << outcome.output;
  EXPECT_FALSE(nlohmann::json::parse(std::ifstream(in("result.json"))).contains("barn_score_k4"));
}

TEST_F(DriveTool, DrawsPicturesOfGeneratedWorlds) {
  const nlohmann::json json = result("--worlds open --goals 3 --time-limit 5 --pictures " + in("pictures"));
  EXPECT_EQ(json["timeouts"], 3) << "5 m in 5 s";
  EXPECT_EQ(json["worlds"].size(), 3u);
  EXPECT_EQ(picturesNamed("missed_open-"), 3u);
  result("--worlds open --goals 3 --pictures " + in("pictures"));
  for (const char* name : {"best_open-", "median_open-", "worst_open-"}) EXPECT_EQ(picturesNamed(name), 1u) << name;
}

TEST_F(DriveTool, EachConditionHasItsEffect) {
  const auto drive = [this](const std::string& conditions) {
    nlohmann::json json = result("--map " LSTM_PLANNER_SOURCE_DIR "/config/demo_building.yaml --goals 4 " + conditions);
    EXPECT_EQ(json["reached"], 4) << conditions;
    EXPECT_EQ(json["contacts"], 0) << conditions;
    return json;
  };
  const nlohmann::json usual = drive("");
  EXPECT_LT(usual["mean_goal_error_m"], 0.2) << "the odometry is exact, and position_tolerance 0.2 m";
  EXPECT_LT(usual["mean_ratio"], 1.5);

  const nlohmann::json slip = drive("--slip 0.2 --no-drift-correction");
  EXPECT_EQ(slip["slip"], 0.2);
  EXPECT_GT(slip["mean_goal_error_m"], 0.5) << "the odometry does not notice";
  EXPECT_LT(drive("--slip 0.2")["mean_goal_error_m"], 0.25) << "the scans do";
  const nlohmann::json latency = drive("--latency 0.4");
  EXPECT_EQ(latency["latency_s"], 0.4);
  EXPECT_GT(latency["mean_time_s"], usual["mean_time_s"]) << "it drives with more care";
  for (const auto& [key, value] : {std::pair("dropout", 0.5), std::pair("noise_m", 0.02)}) {
    const std::string option = key == std::string("dropout") ? "--dropout " : "--noise ";
    const nlohmann::json other = drive(option + std::to_string(value));
    EXPECT_EQ(other[key], value);
    EXPECT_NE(other["mean_time_s"], usual["mean_time_s"]) << "it saw something else";
  }
}

/// What README says of each leader, in a sample: nothing is touched, every goal is reached, on paths that are no
/// longer.
struct SampleBound {
  const char* leader;
  double barn_ratio;
  double barn_score;
  double building_ratio;
};

class DriveToolSample : public DriveTool, public ::testing::WithParamInterface<SampleBound> {
 protected:
  nlohmann::json resultOfLeader(const std::string& where) const {
    return result("--leader " + std::string(GetParam().leader) + " --drift 0.02 " + where);
  }
};

TEST_P(DriveToolSample, OfBarnWorldsIsAsInTheReadme) {
  const std::string barn = realData("barn/barn_cylinders.csv");
  SKIP_WITHOUT_REAL_DATA(barn);
  const nlohmann::json json = resultOfLeader("--barn " + barn + " --only 1 20 50 80 100 140 160 200 220 250");
  EXPECT_EQ(json["goals"], 10);
  EXPECT_EQ(json["reached"], json["goals"]);
  EXPECT_EQ(json["contacts"], 0);
  EXPECT_LE(json["mean_ratio"], GetParam().barn_ratio);
  EXPECT_GE(json["barn_score_k4"], GetParam().barn_score);
}

TEST_P(DriveToolSample, OfRealBuildingsIsAsInTheReadme) {
  const std::string map = realData("maps/building_31.yaml");
  SKIP_WITHOUT_REAL_DATA(map);
  const nlohmann::json json = resultOfLeader("--goals 6 --map " + map + " " + realData("maps/stata_basement.yaml") +
                                             " " + realData("maps/brsu-c069.yaml") + " " + willowMap() + "=0.19");
  EXPECT_EQ(json["goals"], 24);
  EXPECT_EQ(json["reached"], 24);
  EXPECT_EQ(json["contacts"], 0);
  EXPECT_LE(json["mean_ratio"], GetParam().building_ratio);
}

INSTANTIATE_TEST_SUITE_P(Leaders, DriveToolSample,
                         ::testing::Values(SampleBound{"route", 0.9, 0.17, 1.25},
                                           SampleBound{"network", 1.0, 0.15, 1.6}),
                         [](const auto& info) { return std::string(info.param.leader); });

TEST_F(DriveTool, RefusesBadOptionsWithASentence) {
  const auto complaint = [](const std::string& arguments) {
    const test::Outcome outcome = drive(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    return outcome.output;
  };
  EXPECT_NE(complaint("").find("one of --map, --barn, --worlds and --walkers is needed"), std::string::npos);
  EXPECT_NE(complaint("--map a.yaml --worlds open").find("exclude each other"), std::string::npos);
  EXPECT_NE(complaint("--worlds jungle").find("furnished or dynabarn"), std::string::npos);
  EXPECT_NE(complaint("--walkers -1").find("--walkers is -1, expected a whole number in [0, 1000]"), std::string::npos);
  EXPECT_NE(complaint("--walkers 1 --drift 2").find("--drift is 2, expected a number in [0, 0.5]"), std::string::npos);
  EXPECT_NE(complaint("--walkers 1 --goals 0").find("--goals"), std::string::npos);
  EXPECT_NE(complaint("--walkers 1 --knows-map").find("--knows-map needs --map, or --worlds"), std::string::npos);
  EXPECT_NE(complaint("--worlds open --knows-map --drift 0.02").find("expected --drift 0, --slip 0"),
            std::string::npos);
  EXPECT_NE(complaint("--worlds open --knows-map --wheel-error 0.01").find("--wheel-error 0"), std::string::npos);
  EXPECT_NE(complaint("--worlds open --knows-map --no-memory").find("exclude each other"), std::string::npos);
  EXPECT_NE(complaint("--barn " + in("none.csv")).find("none.csv' cannot be read"), std::string::npos);
  EXPECT_NE(complaint("--walkers 1 --goals 1 --only 7").find("--only is 7, expected"), std::string::npos);
  EXPECT_NE(complaint("--walkers 1 --goals 1 --only 0 7").find("--only is 7, expected"), std::string::npos)
      << "what is there does not hide what is not";
}

TEST_F(DriveTool, ReadsTheModelBeforeItMakesWorlds) {
  const test::Outcome outcome = drive("--walkers 1 --goals 1 --only 7 --model " + in("none.onnx"));
  EXPECT_NE(outcome.output.find("none.onnx"), std::string::npos) << outcome.output;
}

TEST_F(DriveTool, SaysNothingOfWhatThereIsNot) {
  const test::Outcome outcome = drive("--worlds open --goals 1 --time-limit 5 --no-memory --model " + shippedModel());
  EXPECT_NE(outcome.output.find("overruled by the shield in"), std::string::npos) << outcome.output;
  for (const char* said : {"remembered path", "bound", "detours"}) {
    EXPECT_EQ(outcome.output.find(said), std::string::npos) << outcome.output;
  }
  EXPECT_NE(outcome.output.find("      -      -          -\n"), std::string::npos)
      << "no drive arrived: no path, no time\n"
      << outcome.output;
}

TEST_F(DriveTool, TellsMapsOfTheSameNameApart) {
  ASSERT_EQ(runTool("maps --width 8 --height 8 --output " + in("plan")).status, 0);
  const nlohmann::json json =
      result("--leader route --goals 1 --time-limit 1 --map " + in("plan.yaml") + " " + in("plan.yaml") + "=0.19");
  ASSERT_EQ(json["worlds"].size(), 2u);
  EXPECT_EQ(json["worlds"][0]["name"], "plan");
  EXPECT_EQ(json["worlds"][1]["name"], "plan-2");
}

TEST_F(DriveTool, DrawsTheStatesOfNetworksWithAndWithoutRecurrentCells) {
  const std::string perceptron = in("perceptron.onnx");
  const test::Outcome training =
      runTool("train rounds=1 worlds=1 kinds=open epochs=1 validation=1 max-steps=5 network=mlp cells=[8,8] output=" +
              perceptron);
  ASSERT_EQ(training.status, 0) << training.output;
  for (const std::string& model : {shippedModel(), perceptron}) {
    const test::Outcome outcome =
        drive("--worlds open --goals 1 --only 0 --time-limit 3 --model " + model + " --states " + in("states.png"));
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    test::expectPicture(in("states.png"));
  }
}

}  // namespace
}  // namespace lstm_planner::test_drive_tool
