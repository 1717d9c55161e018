// The command `lstm_planner train` for the robot without a dataset, as a user runs it.

#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "support/tool_test.hpp"

namespace lstm_planner::test_train_robot_tool {
namespace {

class TrainRobotTool : public test::ToolTest {
 protected:
  static test::Outcome success(const std::string& arguments) {
    const test::Outcome outcome = runTool(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments << "\n" << outcome.output;
    return outcome;
  }

  /// Trains at once, and with Ctrl-C in between: the model is the same.
  void expectTheSameAfterCtrlC(const std::string& options) const {
    const std::string training =
        std::string(kTool) + " train " + options + " --output model.onnx --checkpoint model.checkpoint";
    const test::Outcome whole = runIn("whole", training);
    ASSERT_EQ(whole.status, 0) << whole.output;

    const test::Outcome stopped = runIn("parts", interrupted(training));
    EXPECT_EQ(stopped.status, 130) << stopped.output;
    EXPECT_NE(stopped.output.find("interrupted; the same command continues from here"), std::string::npos)
        << stopped.output;
    const test::Outcome resumed = runIn("parts", training);
    ASSERT_EQ(resumed.status, 0) << resumed.output;
    EXPECT_TRUE(bytesOf("parts/model.onnx") == bytesOf("whole/model.onnx"));
  }
};

TEST_F(TrainRobotTool, ImitationReinforcementAndJudgingFollowOnEachOther) {
  success("train --inputs trace motion --rounds 1 --worlds 4 --epochs 2 --validation 4 --cells 4 --output " +
          in("first.onnx"));
  EXPECT_EQ(DrivePolicy::fromFile(in("first.onnx")).description().encoder.views, 1);
  success("train --method actor-critic --init " + in("first.onnx") +
          " --iterations 1 --worlds 3 --starts 2 --max-steps 40 --validation 2 --keep last --output " + in("own.onnx"));
  EXPECT_NE(bytesOf("own.onnx"), bytesOf("first.onnx")) << "nothing was learned";
  const test::Outcome judged = success("judge --worlds 8 --max-steps 60 --model " + in("own.onnx"));
  for (const char* kind : {"mazes", "offices", "corridors", "forest", "open", "rooms", "furnished", "all"}) {
    EXPECT_NE(judged.output.find(std::string("\n") + kind), std::string::npos) << judged.output;
  }
}

/// Wilson's interval of 0 of n ends at z^2 / (n + z^2), z = 1.96.
TEST_F(TrainRobotTool, OfEightDrivesInTwoWorldsTheIntervalIsThatOfTwo) {
  const test::Outcome judged = success("judge --leader none --kinds open --worlds 2 --max-steps 1");
  EXPECT_NE(judged.output.find("0.0 %  [0.0, 65.8]"), std::string::npos) << judged.output;
}

TEST_F(TrainRobotTool, WorldsWithoutAPathOfTheLengthWantedAreNotJudgedIn) {
  const test::Outcome outcome = runTool("judge --leader none --kinds open --worlds 1 --shortest 200");
  EXPECT_EQ(outcome.status, 2) << outcome.output;
  EXPECT_NE(outcome.output.find("parameter shortest is 200, expected at most"), std::string::npos) << outcome.output;
}

TEST_F(TrainRobotTool, AModelThatIsNoneOfTheRobotsIsNamedAlsoOneOfThePackageFromAnotherFolder) {
  const std::string model = "models/grid_lstm_2x8.onnx";
  const std::string train = std::string(kTool) + " train --method actor-critic --init " + model + " --output own.onnx";
  const test::Outcome outcome = runIn("elsewhere", train);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.output.find("--init " + model + ": the metadata lack "), std::string::npos) << outcome.output;
}

TEST_F(TrainRobotTool, WhatCannotBeWrittenIsSaidBeforeAnythingIsLearned) {
  for (const char* method : {"dagger", "actor-critic"}) {
    for (const std::string& output : {std::string("/no_such_folder/own.onnx"), folder_}) {
      const test::Outcome outcome = runTool("train --method " + std::string(method) + " --output " + output);
      EXPECT_EQ(outcome.status, 2) << method;
      EXPECT_NE(outcome.output.find("cannot write '" + output + "': "), std::string::npos) << outcome.output;
      EXPECT_EQ(outcome.output.find("accuracy"), std::string::npos) << outcome.output;
    }
  }
}

TEST_F(TrainRobotTool, AShippedModelIsNotWrittenUnlessItIsNamed) {
  for (const char* method : {"dagger", "actor-critic"}) {
    const test::Outcome help = success("train --help --method " + std::string(method));
    EXPECT_NE(help.output.find("ONNX file to write (default: own.onnx)"), std::string::npos) << help.output;
  }
}

TEST_F(TrainRobotTool, SizesHaveBounds) {
  for (const char* bad : {"--worlds 100001", "--cells 8 4097", "--deep-in 0", "--rounds 1000001", "--threads 1025"}) {
    const test::Outcome outcome = runTool(std::string("train ") + bad);
    EXPECT_EQ(outcome.status, 2) << bad;
    EXPECT_NE(outcome.output.find(", expected a whole number in [1, "), std::string::npos) << outcome.output;
  }
}

TEST_F(TrainRobotTool, ReinforcementStartsFromNothing) {
  success(
      "train --method actor-critic --views 8 --cells 4 --kinds open --iterations 2 --worlds 3 --starts 2 "
      "--max-steps 40 --validation 2 --output " +
      in("own.onnx"));
  EXPECT_EQ(DrivePolicy::fromFile(in("own.onnx")).description().encoder.views, 8);
}

TEST_F(TrainRobotTool, ReinforcementGoesOnAfterCtrlCAsIfNothingHadBeen) {
  expectTheSameAfterCtrlC(
      "--method actor-critic --views 8 --cells 4 --kinds open --iterations 10 --worlds 3 --starts 2 --max-steps 40 "
      "--validation 2 --threads 1");
}

TEST_F(TrainRobotTool, ImitationGoesOnAfterCtrlCAsIfNothingHadBeen) {
  expectTheSameAfterCtrlC(
      "--rounds 4 --epochs 5 --cells 4 --kinds open --worlds 4 --starts 2 --max-steps 40 --validation 2 --threads 1");
}

TEST_F(TrainRobotTool, ImitationRefusesTheCheckpointOfAnother) {
  const std::string training =
      "train --rounds 1 --epochs 1 --cells 4 --kinds open --worlds 1 --validation 1 --output " + in("own.onnx") +
      " --checkpoint " + in("own.checkpoint");
  success(training);
  const test::Outcome other = runTool(training + " --rate 0.5");
  EXPECT_EQ(other.status, 2) << other.output;
  EXPECT_NE(other.output.find("rate = 0.01 instead of 0.5"), std::string::npos) << other.output;
  EXPECT_NE(success(training + " --method dagger --threads 1 --curve " + in("curve.png")).output.find("going on from"),
            std::string::npos);
}

}  // namespace
}  // namespace lstm_planner::test_train_robot_tool
