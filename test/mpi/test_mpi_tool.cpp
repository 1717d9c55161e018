// The command-line tool under mpirun, against the same command run by one process.

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "lstm_planner/grid/map_generators.hpp"
#include "lstm_planner/grid_world/world/scenario_generator.hpp"
#include "support/tool_test.hpp"

namespace lstm_planner::test_mpi_tool {
namespace {

using test::Outcome;
using test::runShell;

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::size_t timesIn(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

class MpiTool : public test::ToolTest {
 protected:
  void SetUp() override {
#ifndef LSTM_PLANNER_HAVE_MPI
    GTEST_SKIP() << "the tool was built without MPI";
#endif
    if (runShell("command -v mpirun").status != 0) GTEST_SKIP() << "there is no mpirun";
    // Open MPI otherwise refuses to run as root (in a container), and more processes than there are processors.
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    ::setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    ::setenv("PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe", 1);  // since version 5
    ToolTest::SetUp();
  }

  static Outcome byRanks(int ranks, const std::string& arguments) {
    return runShell("mpirun -n " + std::to_string(ranks) + " " + kTool + " " + arguments);
  }

  std::string filesOf(const std::string& name) const {
    return " --output " + in(name + ".onnx") + " --checkpoint " + in(name + ".checkpoint");
  }

  std::string trainingWith(const std::string& method_options, const std::string& name) const {
    return "train --task grid --cells 4 --map-size 32 --max-length 40 --validation 10 --threads 1 " + method_options +
           filesOf(name);
  }

  /// What two processes leave behind is to be what one does, byte for byte.
  void expectSameTraining(const std::string& training) {
    // Under the same name, as a checkpoint knows which model it belongs to.
    const Outcome one = runTool(training);
    ASSERT_EQ(one.status, 0) << one.output;
    const std::string checkpoint = contentOf(in("model.checkpoint"));
    ASSERT_EQ(std::remove(in("model.checkpoint").c_str()), 0);
    const Outcome two = byRanks(2, training);
    ASSERT_EQ(two.status, 0) << two.output;
    EXPECT_GT(checkpoint.size(), 1000u);
    EXPECT_TRUE(contentOf(in("model.checkpoint")) == checkpoint);  // EXPECT_EQ would print them
    EXPECT_EQ(timesIn(two.output, "wrote "), 1u) << two.output;
  }
};

TEST_F(MpiTool, RanksThatShareAnEvaluationFindWhatOneProcessFinds) {
  const PassableGrid grid = generateRandomFill({48, 48, 0.25, true}, 1);
  std::filesystem::create_directories(in("set/Maps"));
  std::filesystem::create_directories(in("set/Scenarios"));
  writeMovingAiMap(in("set/Maps/a-0.map"), grid);
  writeScenarios(in("set/Scenarios/a-0.map.scen"), drawScenarios(grid, "a-0.map", {}, 1));
  const auto summaryOf = [&](const std::string& name) {
    nlohmann::json set = nlohmann::json::parse(contentOf(in(name))).at("sets").at(0);
    EXPECT_EQ(set.erase("mean_time_s") + set.erase("ns_per_step"), 2u);
    return set;
  };
  const std::string arguments = "evaluate --agent boundary --scenarios " + in("set") + " --json ";
  const Outcome one = runTool(arguments + in("one.json"));
  ASSERT_EQ(one.status, 0) << one.output;
  const Outcome three = byRanks(3, arguments + in("three.json"));
  ASSERT_EQ(three.status, 0) << three.output;
  EXPECT_GT(summaryOf("one.json").at("scenarios"), 100);
  EXPECT_EQ(summaryOf("one.json"), summaryOf("three.json"));
  EXPECT_EQ(timesIn(three.output, "arrived"), 1u) << three.output;
}

TEST_F(MpiTool, RanksThatShareReinforcementLearnWhatOneProcessLearns) {
  expectSameTraining(
      trainingWith("--method q-learning --updates 6 --epochs 2 --agents 192 --window 8 --goals 20", "model"));
}

TEST_F(MpiTool, RanksThatShareTheRobotsDrivesLearnWhatOneProcessLearns) {
  expectSameTraining(
      "train --method actor-critic --views 8 --cells 4 --kinds open --iterations 2 --worlds 3 --starts 2 "
      "--max-steps 40 --validation 2 --threads 1" +
      filesOf("model"));
}

TEST_F(MpiTool, RanksThatShareImitationLearnWhatOneProcessLearns) {
  expectSameTraining(
      trainingWith("--method imitation --steps 4096 --validation-steps 1024 --batch-steps 512 --sequence 64 "
                   "--burn-in 8 --epochs 2 --goals 20",
                   "model"));
}

TEST_F(MpiTool, SaysOnceWhatIsWrong) {
  const Outcome outcome = byRanks(3, "evaluate --agent nobody --scenarios " + folder_);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(timesIn(outcome.output, "--agent is 'nobody', expected astar"), 1u) << outcome.output;
}

TEST_F(MpiTool, RefusesSeveralProcessesForWhatOneDoes) {
  const Outcome outcome = byRanks(2, "maps --help");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(timesIn(outcome.output, "this command is run by one process, not by 2"), 1u) << outcome.output;
}

TEST_F(MpiTool, WhenARankDiesTheRunEndsAndItsLastCheckpointIsGood) {
  const std::string training =
      trainingWith("--method q-learning --updates 1000000 --epochs 500000 --agents 64 --window 4 --goals 4", "broken");
  // The system kills the second rank after a second of processor time.
  const Outcome broken = runShell("mpirun -n 2 sh -c '[ \"$OMPI_COMM_WORLD_RANK\" = 0 ] || ulimit -t 1; exec " +
                                  std::string(kTool) + " " + training + "'");
  EXPECT_NE(broken.status, 0);
  EXPECT_NE(broken.output.find("rank 1"), std::string::npos) << broken.output;
  EXPECT_EQ(timesIn(broken.output, "wrote "), 0u) << broken.output;

  const Outcome resumed = runShell("ulimit -t 1; " + std::string(kTool) + " " + training);
  EXPECT_NE(resumed.status, 0) << "killed, too";
  const std::size_t going_on = resumed.output.find("going on from " + in("broken.checkpoint") + " after epoch ");
  ASSERT_NE(going_on, std::string::npos) << resumed.output;
}

}  // namespace
}  // namespace lstm_planner::test_mpi_tool
