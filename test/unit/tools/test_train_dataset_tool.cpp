// lstm_planner train --dataset, as a user runs it.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "support/picture_check.hpp"
#include "support/tool_test.hpp"
#include "unit/simulation/recorded_drives_fixtures.hpp"

namespace lstm_planner::test_train_dataset_tool {
namespace {

namespace fs = std::filesystem;

class TrainDatasetTool : public test::ToolTest {
 protected:
  void SetUp() override {
    test::ToolTest::SetUp();
    writeDataset(in("drives.dataset"), drivesAllAround(24, 25, 1));
  }

  bool exists(const std::string& name) const { return fs::exists(in(name)); }

  test::Outcome train(const std::string& options) const {
    return test::runShell("cd '" + folder_ + "' && '" + kTool + "' train " + options);
  }

  void expectRefusal(const std::string& options, const std::string& sentence) const {
    const test::Outcome outcome = train(options);
    EXPECT_EQ(outcome.status, 2) << options;
    EXPECT_NE(outcome.output.find(sentence), std::string::npos) << outcome.output;
    EXPECT_FALSE(exists("model.onnx")) << options;
  }
};

TEST_F(TrainDatasetTool, WritesAModelThatThePlannerTakesAndSaysWhatItCan) {
  const test::Outcome outcome =
      train("--dataset drives.dataset --output model.onnx --inputs events --cells 6 --epochs 5 --threads 1");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  for (const char* said : {"majority-class baseline: accuracy", "recall", "precision", "balanced", "5 epochs in",
                           "wrote model.onnx: accuracy"}) {
    EXPECT_NE(outcome.output.find(said), std::string::npos) << said << "\n" << outcome.output;
  }
  const DrivePolicy policy = DrivePolicy::fromFile(in("model.onnx"));
  EXPECT_NO_THROW(checkFits(policy.description(), 0.4));
  EXPECT_EQ(policy.description().encoder.input_layout.size(), 22u);
  const Model model = readModelFile(in("model.onnx"));
  EXPECT_NE(model.metadata.at("training_command").find("train --dataset drives.dataset"), std::string::npos);
  EXPECT_NE(model.metadata.at("score").find("recorded validation steps: accuracy"), std::string::npos);
}

TEST_F(TrainDatasetTool, TakesTheThesissTwelveInputsAndRoundsWhatOdometrySays) {
  const test::Outcome outcome = train(
      "--dataset drives.dataset --output model.onnx --inputs events-alone angles --position-cell 0.35 --heading-cell "
      "0.39 "
      "--cells 4 --epochs 1 --threads 1");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const EncoderParameters encoder = DrivePolicy::fromFile(in("model.onnx")).description().encoder;
  EXPECT_EQ(encoder.input_layout,
            (std::vector<std::string>{"event_0", "event_1", "event_2", "event_3", "event_4", "event_5", "event_6",
                                      "event_7", "goal_distance", "goal_bearing", "heading", "previous_action"}));
  EXPECT_EQ(encoder.position_cell, 0.35);
  EXPECT_EQ(encoder.heading_cell, 0.39);
}

TEST_F(TrainDatasetTool, TakesTheThesissAlternativesInsideTheLayersAndItsEuclideanLoss) {
  const std::string data = "--dataset drives.dataset --output model.onnx --epochs 1 --threads 1 ";
  const test::Outcome outcome =
      train(data + "--cells 4 --deep-out 3 --activation sigmoid --candidate sigmoid --loss euclidean");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const LayerStack layers = readModelFile(in("model.onnx")).layers;
  EXPECT_EQ(std::get<LstmLayer>(layers[0]).candidate, Activation::kSigmoid);
  EXPECT_EQ(std::get<DenseLayer>(layers[1]).activation, Activation::kSigmoid);
  fs::remove(in("model.onnx"));
  expectRefusal(data + "--cells 4 --activation relu", "no dense layer");
  expectRefusal(data + "--network rnn --candidate sigmoid", "no LSTM layer");
  expectRefusal(data + "--loss hinge", "--loss");
}

TEST_F(TrainDatasetTool, SnapshotsHoldTheWeightsOfTheirEpochs) {
  const std::string data = "--dataset drives.dataset --cells 4 --threads 1 --snapshots 2 --averaging 0 --output ";
  ASSERT_EQ(train(data + "model.onnx --epochs 10 --preset thesis").status, 0);
  for (const char* name : {"model_epoch_02", "model_epoch_04", "model_epoch_10"}) {
    EXPECT_NO_THROW(DrivePolicy::fromFile(in(std::string(name) + ".onnx"))) << name;
  }
  EXPECT_FALSE(exists("model_epoch_03.onnx"));
  const auto weights = [&](const std::string& name) { return parameterVector(readModelFile(in(name)).layers); };
  EXPECT_NE(weights("model_epoch_02.onnx"), weights("model_epoch_04.onnx"));
  // With a constant rate a shorter training is the beginning of a longer one.
  ASSERT_EQ(train(data + "short.onnx --epochs 4 --preset thesis").status, 0);
  EXPECT_EQ(weights("short_epoch_4.onnx"), weights("model_epoch_04.onnx"));
}

TEST_F(TrainDatasetTool, TheSameCommandGivesTheSameModelForAnyNumberOfThreads) {
  const std::string command = "--dataset drives.dataset --cells 4 --epochs 2 --output model.onnx --threads ";
  const auto layers = [&](const char* threads) {
    EXPECT_EQ(train(command + threads).status, 0);
    DrivePolicy policy = DrivePolicy::fromFile(in("model.onnx"));
    const Eigen::VectorXf& preferences = policy.advance(Observation());
    return std::vector<float>(preferences.data(), preferences.data() + preferences.size());
  };
  EXPECT_EQ(layers("1"), layers("2"));
}

TEST_F(TrainDatasetTool, GoesOnAfterCtrlCAsIfNothingHadBeen) {
  const std::string training = std::string("'") + kTool +
                               "' train --dataset ../drives.dataset --cells 4 --epochs 40 --threads 1 --instability "
                               "instability.png --output model.onnx --checkpoint model.checkpoint";
  const test::Outcome whole = runIn("whole", training);
  ASSERT_EQ(whole.status, 0) << whole.output;

  const test::Outcome stopped = runIn("parts", interrupted(training));
  EXPECT_EQ(stopped.status, 130) << stopped.output;
  EXPECT_TRUE(exists("parts/model.onnx")) << "the best epoch until then";
  const test::Outcome resumed = runIn("parts", training);
  ASSERT_EQ(resumed.status, 0) << resumed.output;
  EXPECT_NE(resumed.output.find("going on from model.checkpoint after "), std::string::npos) << resumed.output;
  for (const char* name : {"model.onnx", "instability.csv"}) {
    EXPECT_TRUE(bytesOf(std::string("parts/") + name) == bytesOf(std::string("whole/") + name)) << name;
  }
  const test::Outcome other = runIn("parts", training + " --rate 0.001");
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.output.find("rate"), std::string::npos) << other.output;
}

TEST_F(TrainDatasetTool, FineTuningKeepsInputsAndShapeAndSaysWhatTheModelCouldBefore) {
  ASSERT_EQ(train("--dataset drives.dataset --output first.onnx --inputs events trace --cells 5 --epochs 2").status, 0);
  const test::Outcome outcome =
      train("--dataset drives.dataset --init first.onnx --output model.onnx --epochs 2 --variants 0 --threads 1");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("first.onnx as it is: accuracy"), std::string::npos) << outcome.output;
  const DrivePolicy policy = DrivePolicy::fromFile(in("model.onnx"));
  EXPECT_EQ(policy.description().encoder.input_layout.back(), "steps_since_best");
  fs::remove(in("model.onnx"));
  expectRefusal("--dataset drives.dataset --init first.onnx --output model.onnx --cells 8",
                "--cells is determined by the model of --init");
}

TEST_F(TrainDatasetTool, ANetworkWithViewsFollowsADriverWhileItPractises) {
  const std::string practice =
      "--method actor-critic --views 8 --cells 4 --kinds open --iterations 1 --worlds 2 --starts 2 --max-steps 40 "
      "--validation 2 --threads 1 --output model.onnx ";
  const test::Outcome outcome = train(practice + "--recordings drives.dataset --validation-recordings drives.dataset");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("recordings: accuracy"), std::string::npos) << outcome.output;
  const test::Outcome judged =
      test::runShell("cd '" + folder_ + "' && '" + kTool + "' judge --model model.onnx --recordings drives.dataset");
  ASSERT_EQ(judged.status, 0) << judged.output;
  EXPECT_NE(judged.output.find("600 recorded steps: accuracy"), std::string::npos) << judged.output;
  EXPECT_NE(judged.output.find("majority-class baseline: accuracy"), std::string::npos) << judged.output;
  fs::remove(in("model.onnx"));
  expectRefusal(practice + "--recordings drives.dataset --recordings-weight 0", "--recordings-weight is 0");
  expectRefusal(practice + "--recordings missing.dataset", "missing.dataset");
  expectRefusal(practice + "--recordings drives.dataset ./drives.dataset", "dataset './drives.dataset' is given twice");
}

TEST_F(TrainDatasetTool, ThesisPresetMeasuresTheInstability) {
  const test::Outcome outcome = train(
      "--preset thesis --epochs 4 --dataset drives.dataset --output model.onnx "
      "--instability instability.png --curve curve.png --confusion confusion.png --threads 1");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("the accuracy of an epoch (Eq. 4.5) and that of the weights at its end"),
            std::string::npos);
  for (const char* name : {"instability", "curve", "confusion"})
    EXPECT_TRUE(exists(std::string(name) + ".csv")) << name;
  test::expectPicture(in("instability.png"), 1000, 900);
  test::expectPicture(in("curve.png"), 900, 800);
  test::expectPicture(in("confusion.png"), 720, 640);
}

TEST_F(TrainDatasetTool, BadOptionsAreRefusedWithASentenceBeforeAnythingIsWritten) {
  expectRefusal("--dataset missing.dataset --output model.onnx", "missing.dataset");
  expectRefusal("--dataset drives.dataset", "output");
  expectRefusal("--dataset drives.dataset --output model.onnx --preset quick",
                "--preset is 'quick', expected thesis or stable");
  expectRefusal("--dataset drives.dataset --output model.onnx --balance half", "expected none, sqrt or inverse");
  expectRefusal("--dataset drives.dataset --output model.onnx --inputs smell", "--inputs names 'smell'");
  expectRefusal("--dataset drives.dataset --output model.onnx --task grid", "--task is 'grid'");
  expectRefusal("--dataset drives.dataset --output model.onnx --method dagger", "--method dagger exclude each other");
  expectRefusal("--dataset drives.dataset --output model.onnx --averaging 0 --instability i.png", "--averaging is 0");
  expectRefusal(
      "--dataset drives.dataset --output model.onnx --validation-dataset drives.dataset --validation-share 0.5",
      "exclude each other");
  expectRefusal("--dataset drives.dataset --output model.onnx --validation-dataset drives.dataset",
                "in the training set and in the validation set");
  expectRefusal("--dataset drives.dataset --output drives.dataset",
                "--output is 'drives.dataset', which is also the file of --dataset");
  expectRefusal("--dataset drives.dataset --output model.onnx --checkpoint ./model.onnx",
                "'model.onnx', which is also the file of --checkpoint");
  expectRefusal("--dataset drives.dataset --output no_such_folder/model.onnx", "cannot write 'no_such_folder");
  std::ofstream(in("text.dataset")) << "not a database";
  expectRefusal("--dataset text.dataset --output model.onnx", "text.dataset");
}

}  // namespace
}  // namespace lstm_planner::test_train_dataset_tool
