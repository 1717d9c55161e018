// What all commands of the tool have in common: their help, their options, and what ends them.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "support/tool_test.hpp"

namespace lstm_planner::test_command_line {
namespace {

class CommandLineTool : public test::ToolTest {
 protected:
  static std::string success(const std::string& arguments) {
    const test::Outcome outcome = runTool(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments << "\n" << outcome.output;
    return outcome.output;
  }

  /// The one sentence that a wrong use is refused with.
  static std::string complaint(const std::string& arguments) {
    const test::Outcome outcome = runTool(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments << "\n" << outcome.output;
    EXPECT_EQ(outcome.output.find('\n'), outcome.output.size() - 1) << outcome.output;
    return outcome.output;
  }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Each with what its usage line asks for.
struct Usage {
  const char* command;
  const char* required;
};
const std::vector<Usage> kUsages = {
    {"drive", ""},
    {"judge", ""},
    {"evaluate", " --scenarios FILE..."},
    {"report", " --output FOLDER --agents TEXT... --scenarios FILE..."},
    {"maps", " --output FILE"},
    {"parameters", ""},
    {"dataset info", " FILE"},
    {"dataset check", " FILE"},
    {"dataset merge", " FILE... --output FILE"},
    {"dataset split", " FILE --training FILE --validation FILE"},
    {"dataset export", " FILE --output FILE"},
    {"dataset from-bag", " FILE... --output FILE"},
    {"dataset from-log", " FILE... --output FILE"},
    {"dataset simulate", " --map FILE... --output FILE"},
    {"train --method dagger", ""},
    {"train --method actor-critic", ""},
    {"train --search", ""},
    {"train --task grid --method imitation", " --output FILE"},
    {"train --task grid --method dagger", " --output FILE"},
    {"train --task grid --method q-learning", " --output FILE"},
};

TEST_F(CommandLineTool, EveryCommandHasAUsageLineWithWhatItRequires) {
  for (const Usage& usage : kUsages) {
    const std::string command = usage.command;
    const std::string help = success(command + " --help");
    const std::string line = "usage: lstm_planner " + command + usage.required + " [OPTION]...\n";
    EXPECT_EQ(help.rfind(line, 0), 0u) << help;
    EXPECT_EQ(success(command + " -h"), help);
  }
}

TEST_F(CommandLineTool, TheUsageLineOfTrainingOnADatasetNamesIt) {
  EXPECT_TRUE(contains(success("train --dataset a.db --help"),
                       "usage: lstm_planner train --dataset FILE... --output FILE [OPTION]...\n"));
}

TEST_F(CommandLineTool, TheHelpWritesDefaultsAndRangesAsPeopleDo) {
  const std::regex many_digits(R"(\d\.\d{7})");
  for (const Usage& usage : kUsages) {
    const std::string help = success(std::string(usage.command) + " --help");
    EXPECT_FALSE(std::regex_search(help, many_digits)) << help;
  }
  EXPECT_TRUE(contains(success("drive --help"), "in [0, 1] (default: 0.001)"));
}

TEST_F(CommandLineTool, PrintsTheParametersOfPluginsAndNodes) {
  const std::string all = success("parameters");
  for (const char* part : {"LstmGlobalPlanner, config/lstm_planner.yaml\n", "SteeringController", "dataset_recorder",
                           "create2_stub", "scripted_teleoperator", "\n  step/length: 0.4  [0.05, 5] m\n",
                           "\n  laser/upside_down: false\n", "\n  driver/speed: 0.3  [0.01, 10] m/s\n"}) {
    EXPECT_TRUE(contains(all, part)) << part;
  }
  const std::string stub = success("parameters stub");
  EXPECT_TRUE(contains(stub, "robot/axle_length"));
  EXPECT_FALSE(contains(stub, "LstmGlobalPlanner"));
}

TEST_F(CommandLineTool, ThePageOfAllParametersIsWhatItPrints) {
  std::ifstream page(std::string(LSTM_PLANNER_SOURCE_DIR) + "/config/parameters.md");
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  EXPECT_EQ(text, success("parameters --markdown"))
      << "the page is old; in the source folder: lstm_planner parameters --markdown > config/parameters.md";
}

TEST_F(CommandLineTool, SaysItsVersion) {
  EXPECT_TRUE(std::regex_match(success("--version"), std::regex(R"(lstm_planner \d+\.\d+\.\d+\n)")));
}

TEST_F(CommandLineTool, StartsWithoutTheLibrariesOfImageFormats) {
  const test::Outcome libraries = test::runShell(std::string("ldd ") + kTool);
  EXPECT_TRUE(contains(libraries.output, "libopencv_core")) << libraries.output;
  EXPECT_FALSE(contains(libraries.output, "libopencv_imgcodecs")) << libraries.output;
}

TEST_F(CommandLineTool, SaysWhichLibraryOfImageFormatsIsMissing) {
  std::ofstream(in("map.yaml")) << "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                                   "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
  std::ofstream(in("map.pgm")) << "P5\n2 2\n255\n1234";
  const test::Outcome outcome = test::runShell(
      std::string("core=$(ldd ") + kTool + " | awk '/lstm_planner_core/ {print $3}'); cp $core '" + in("") +
      "' && LD_LIBRARY_PATH='" + in("") + "' " + kTool + " drive --goals 1 --map '" + in("map.yaml") + "'");
  EXPECT_EQ(outcome.status, 2) << outcome.output;
  EXPECT_TRUE(contains(outcome.output, "map.pgm cannot be decoded: the library of image formats '" +
                                           in("liblstm_planner_image_codecs.so") + "' cannot be loaded"))
      << outcome.output;
}

TEST_F(CommandLineTool, NamesTheNearestOfWhatThereIs) {
  EXPECT_TRUE(contains(complaint("drvie"), "there is no command 'drvie'; the nearest is drive"));
  EXPECT_TRUE(contains(complaint("paint"), "expected one of drive, judge"));
  EXPECT_TRUE(contains(complaint("dataset exprot"), "there is no action 'exprot'; the nearest is export"));
  EXPECT_TRUE(contains(complaint("drive --gaols 3"), "there is no option --gaols; the nearest is --goals"));
  EXPECT_TRUE(contains(complaint("drive --gaols=3 --walkers 1"), "the nearest is --goals"));
  EXPECT_TRUE(contains(complaint("evaluate --scenario x --help"), "the nearest is --scenarios"));
  EXPECT_TRUE(contains(complaint("drive --temperature 3"), "there is no option --temperature\n"));
}

TEST_F(CommandLineTool, NamesWhatChoosesATrainingOrThatThereAreOthers) {
  EXPECT_TRUE(contains(complaint("train --datset a.db"), "there is no option --datset; the nearest is --dataset\n"));
  EXPECT_TRUE(contains(complaint("train datset=a.db"), "the nearest is --dataset\n"));
  EXPECT_TRUE(contains(complaint("train --serch"), "the nearest is --search\n"));
  EXPECT_TRUE(contains(complaint("train --epoch 2"), "the nearest is --epochs\n"));
  EXPECT_TRUE(contains(complaint("train --search --method dagger"), "there is no option --method in this training"));
  EXPECT_TRUE(
      contains(complaint("train --recordings a.db"),
               "there is no option --recordings in this training; lstm_planner train --help names the others\n"));
}

TEST_F(CommandLineTool, RefusesWhatHasNoMeaning) {
  EXPECT_TRUE(contains(complaint("drive --walkers 1 2"), "'2' stands alone"));
  EXPECT_TRUE(contains(complaint("drive --walkers"), "--walkers needs a value"));
  EXPECT_TRUE(contains(complaint("drive --json --seed 1"), "--json needs a value, got --seed"));
  EXPECT_TRUE(contains(complaint("drive --no-shield=2"), "--no-shield takes no value"));
  EXPECT_TRUE(contains(complaint("drive --seed 1 --seed 2"), "--seed is given 2 times, expected once"));
  EXPECT_TRUE(contains(complaint("dataset export a.db"), "--output is required"));
}

TEST_F(CommandLineTool, RefusesOptionsWithoutEffect) {
  const std::string model = "--model " LSTM_PLANNER_SOURCE_DIR "/models/create2_lstm.onnx ";
  const std::pair<std::string, std::string> uses[] = {
      {"drive --worlds open --film-size 800", "--film-size has no effect without --film\n"},
      {"judge --leader route " + model, "--model has no effect with --leader route\n"},
      {"judge --recordings a.db --worlds 3 " + model, "--worlds has no effect with --recordings\n"},
      {"evaluate --scenarios a --four-moves", "--four-moves has no effect without --agent astar\n"},
      {"evaluate --scenarios a --agent dstar --no-escape", "--no-escape has no effect with --agent dstar\n"},
      {"evaluate --scenarios a --no-escape --detour-share 1", "--detour-share has no effect without a network under"},
      {"evaluate --scenarios a --draw-after 3", "--draw-after has no effect without --no-escape\n"},
      {"model convert " LSTM_PLANNER_SOURCE_DIR "/models/grid_lstm_2x8.onnx --task grid --step-length 3 --output " +
           in("own.onnx"),
       "--step-length has no effect with --task grid\n"},
      {"dataset from-bag a.bag --stop 3 --output " + in("a.db"), "--stop has no effect without --hindsight\n"},
  };
  for (const auto& [use, expected] : uses) EXPECT_TRUE(contains(complaint(use), expected)) << use;
}

TEST_F(CommandLineTool, RefusesFilesWithoutAName) {
  EXPECT_TRUE(contains(complaint("maps --output ''"), "--output is '', expected the name of a file\n"));
  EXPECT_TRUE(contains(complaint("drive --map a.yaml ''"), "--map is '', expected the name of a file"));
  EXPECT_TRUE(contains(complaint("drive --pictures '' --worlds open --goals 1 --time-limit 1"),
                       "--pictures is '', expected the name of a folder"));
}

TEST_F(CommandLineTool, RefusesANetworksShapeBesideTheModelThatDecidesIt) {
  const std::string model = LSTM_PLANNER_SOURCE_DIR "/models/grid_lstm_2x8.onnx";
  EXPECT_TRUE(contains(complaint("train --task grid --method imitation --map-size 32 --max-length 40 --goals 6 "
                                 "--steps 50 --epochs 1 --validation 3 --cells 4 --from " +
                                 model + " --output " + in("own.onnx")),
                       "--cells is determined by the model of --from\n"));
}

TEST_F(CommandLineTool, FailsWhereWhatItPrintsIsLost) {
  const test::Outcome outcome = test::runShell(std::string(kTool) + " parameters > /dev/full");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(contains(outcome.output, "standard output cannot be written")) << outcome.output;
}

TEST_F(CommandLineTool, WritesToStandardOutputBehindWhatIsThere) {
  const test::Outcome outcome =
      runIn("drive", "echo before > all.txt; " + std::string(kTool) +
                         " drive --leader route --worlds open --goals 1 --time-limit 1 --json /dev/stdout >> all.txt");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  const std::string all = bytesOf("drive/all.txt");
  for (const char* part : {"before\n", "\nworld ", "\n  \"goals\": 1,\n"}) EXPECT_TRUE(contains(all, part)) << all;
}

TEST_F(CommandLineTool, WritesIntoAPipeAsLongAsItsReaderIsThere) {
  const test::Outcome outcome =
      runIn("drive", "mkfifo pipe; cat pipe > result.json & timeout 60 " + std::string(kTool) +
                         " drive --leader route --worlds open --goals 1 --time-limit 1 --json pipe && wait");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_TRUE(contains(bytesOf("drive/result.json"), "\"goals\": 1,"));
}

TEST_F(CommandLineTool, EveryNumberHasARange) {
  EXPECT_TRUE(contains(complaint("drive --walkers 1001"), "--walkers is 1001, expected a whole number in [0, 1000]"));
  EXPECT_TRUE(contains(complaint("drive --walkers 1.5"), "--walkers is 1.5, expected a whole number in [0, 1000]"));
  EXPECT_TRUE(contains(complaint("drive --walkers many"), "--walkers is 'many', expected a whole number"));
  EXPECT_TRUE(contains(complaint("drive --walkers ''"), "--walkers is '', expected a whole number"));
  EXPECT_TRUE(contains(complaint("drive --seed -1"), "--seed is -1, expected a whole number"));
  EXPECT_TRUE(contains(complaint("drive --dropout nan"), "--dropout is 'nan', expected a number in [0, 1]"));
  EXPECT_TRUE(contains(complaint("drive --threads 99999999999999999999"), "expected a whole number in [1, 1024]"));
  EXPECT_TRUE(contains(complaint("drive --only 0 -7"), "--only is -7, expected a whole number in [0, "));
}

TEST_F(CommandLineTool, FindsTheShippedModelsFromAnyFolder) {
  const test::Outcome outcome = test::runShell("cd '" + folder_ + "' && unset ROS_PACKAGE_PATH && '" + kTool +
                                               "' drive --leader network --worlds open --goals 1 --time-limit 2");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
}

TEST_F(CommandLineTool, TheSecondSignalEndsATrainingAtOnce) {
  const std::string training = std::string(kTool) +
                               " train --method actor-critic --views 8 --cells 4 --kinds open --iterations 1000 "
                               "--worlds 3 --starts 2 --max-steps 40 --validation 2 --threads 1 --output model.onnx "
                               "--checkpoint model.checkpoint";
  const test::Outcome outcome =
      test::runShell("cd '" + folder_ + "'; " + training +
                     " > out.txt & process=$!; until grep -q validation out.txt; do kill -0 $process || break; done; "
                     "kill -INT $process; kill -TERM $process; wait $process; status=$?; cat out.txt; exit $status");
  EXPECT_TRUE(outcome.status == 130 || outcome.status == 143) << outcome.status << "\n" << outcome.output;
  EXPECT_FALSE(contains(outcome.output, "interrupted")) << outcome.output;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    EXPECT_FALSE(contains(entry.path().filename().string(), ".part-")) << entry.path();
  }
}

}  // namespace
}  // namespace lstm_planner::test_command_line
