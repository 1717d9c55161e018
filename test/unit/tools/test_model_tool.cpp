// The command `lstm_planner model` as a user runs it.

#include <fstream>
#include <iterator>
#include <string>

#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "support/tool_test.hpp"

namespace lstm_planner::test_model_tool {
namespace {

const std::string kExported = LSTM_PLANNER_SOURCE_DIR "/test/models/pytorch_states.onnx";

class ModelTool : public test::ToolTest {
 protected:
  static void expectSays(const std::string& arguments, int status, const std::string& part) {
    const test::Outcome outcome = runTool(arguments);
    EXPECT_EQ(outcome.status, status) << arguments << "\n" << outcome.output;
    EXPECT_NE(outcome.output.find(part), std::string::npos) << arguments << "\n" << outcome.output;
  }
};

TEST_F(ModelTool, NamesLayersAndMetadata) {
  const test::Outcome outcome = runTool("model info models/create2_lstm.onnx");
  EXPECT_EQ(outcome.status, 0);
  for (const char* part :
       {"LSTM 32 -> 16", "for      the robot", "training_command lstm_planner train", "step_length"}) {
    EXPECT_NE(outcome.output.find(part), std::string::npos) << part << "\n" << outcome.output;
  }
  expectSays("model info " + kExported, 0, "it has no metadata");
}

TEST_F(ModelTool, FindsShippedModelsSound) {
  for (const char* name : {"create2_lstm", "grid_lstm_2x8", "grid_mlp_4x64", "grid_qlearning"}) {
    expectSays(std::string("model check models/") + name + ".onnx", 0, "can be used");
  }
}

TEST_F(ModelTool, SaysAllThatAModelLacksAtOnce) {
  expectSays("model check " + kExported, 2,
             "the metadata lack input_layout, sector_count, angle_span, range_cap, distance_scale, angle_scale, "
             "action_scale, position_cell, action_angles, step_length, robot_radius");
}

TEST_F(ModelTool, SaysWhatTheMetadataLackEvenIfTheGraphCannotBeRead) {
  std::ifstream exported(kExported, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(exported), {});
  for (std::size_t at; (at = bytes.find("LSTM")) != std::string::npos;) bytes.replace(at, 4, "GRUs");
  std::ofstream(in("gru.onnx"), std::ios::binary) << bytes;
  expectSays("model check " + in("gru.onnx"), 2, ": the operator \"GRUs\" is not known to the planner, expected LSTM");
  expectSays("model check " + in("gru.onnx"), 2, "; the metadata lack input_layout, sector_count,");
}

TEST_F(ModelTool, FitsAnExportedNetworkWithWhatItNeeds) {
  expectSays("model convert " + kExported + " --output " + in("own.onnx") +
                 " --step-length 0.5 --robot-radius 0.2 --range-cap 5 --made-by 'my script'",
             0, "for      the robot");
  const PolicyDescription description = DrivePolicy::fromFile(in("own.onnx")).description();
  EXPECT_EQ(description.step_length, 0.5);
  EXPECT_EQ(description.footprint_radius, 0.2);
  EXPECT_EQ(description.encoder.range_cap, 5.0);
  EXPECT_EQ(readModelFile(in("own.onnx")).metadata.at("training_command"), "my script");
}

TEST_F(ModelTool, KeepsWhatTheModelSaysUnlessAnOptionSaysOtherwise) {
  expectSays("model convert " + kExported + " --output " + in("own.onnx") + " --step-length 0.5 --range-cap 5", 0,
             "for      the robot");
  expectSays("model convert " + in("own.onnx") + " --output " + in("tried.onnx") +
                 " --range-cap 4 --smallest-robot 0.1 --largest-robot 0.5",
             0, "largest_robot    0.5");
  const PolicyDescription description = DrivePolicy::fromFile(in("tried.onnx")).description();
  EXPECT_EQ(description.step_length, 0.5);
  EXPECT_EQ(description.encoder.range_cap, 4.0);
  EXPECT_EQ(description.smallest_radius, 0.1);
}

TEST_F(ModelTool, ForgetsWhatAnOptionSwitchesOff) {
  expectSays("model convert " + kExported + " --output " + in("own.onnx") + " --heading-cell 0.25 --smallest-robot 0.1",
             0, "heading_cell     0.25");
  expectSays("model convert " + in("own.onnx") + " --output " + in("own.onnx") + " --heading-cell 0 --smallest-robot 0",
             0, "for      the robot");
  const PolicyDescription description = DrivePolicy::fromFile(in("own.onnx")).description();
  EXPECT_EQ(description.encoder.heading_cell, 0.0);
  EXPECT_EQ(description.smallest_radius, 0.0);
  expectSays("model convert " LSTM_PLANNER_SOURCE_DIR "/models/create2_lstm.onnx --views 1 --output " + in("own.onnx"),
             2, "the network has 1 outputs, its action set has 5");
}

TEST_F(ModelTool, RefusesWhatDoesNotFitAndWritesNothing) {
  expectSays("model convert " + kExported + " --output " + in("own.onnx") + " --actions -90 0 90", 2,
             "the network has 5 outputs, its action set has 3");
  expectSays("model convert " + kExported + " --output " + in("own.onnx") + " --layout sector_0 heading", 2,
             "the network takes 14 inputs, its input layout has 2");
  expectSays("model convert " + kExported + " --output " + in("own.onnx") + " --task grid", 2,
             "the network has 14 inputs and 5 outputs, expected 11 and 8");
  EXPECT_THROW(readModelFile(in("own.onnx")), ModelFileError);
}

}  // namespace
}  // namespace lstm_planner::test_model_tool
