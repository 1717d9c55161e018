// The command `lstm_planner dataset` as a user runs it.

#include <algorithm>
#include <fstream>
#include <iterator>

#include "support/picture_check.hpp"
#include "support/shell.hpp"
#include "unit/dataset/dataset_fixtures.hpp"

namespace lstm_planner::test_dataset_tool {
namespace {

class DatasetTool : public ExampleFileTest {
 protected:
  DatasetTool() : ExampleFileTest(8) {}

  /// In the folder of the test.
  test::Outcome run(const std::string& arguments) const {
    return test::runShell("cd " + folder_ + "; " + LSTM_PLANNER_TOOL + " dataset " + arguments);
  }

  std::string success(const std::string& arguments) const {
    const test::Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments << ": " << outcome.output;
    return outcome.output;
  }
  std::string complaint(const std::string& arguments) const {
    const test::Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    return outcome.output;
  }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(DatasetTool, SaysWhatADatasetHolds) {
  const std::string output = success("info a.db");
  EXPECT_TRUE(contains(output, "1 recording\n8 episodes: 8 arrived\n60 steps, 60 with scan")) << output;
  EXPECT_TRUE(contains(output, "rejected: 7 standing\n")) << output;
  EXPECT_TRUE(contains(output, "  90 deg ")) << output;
  for (const char* quantity : {"stamp", "pose_yaw", "sector_range", "label", "interval"}) {
    EXPECT_TRUE(contains(output, std::string("\n") + quantity + " ")) << quantity;
  }
}

TEST_F(DatasetTool, DrawsADataset) {
  success("info a.db --picture a.png");
  test::expectPicture(in("a.png"), 1400, 800);
}

TEST_F(DatasetTool, TellsASoundDatasetFromOneWithFlaws) {
  EXPECT_EQ(success("check a.db"), "nothing is wrong with 60 steps\n");
  Dataset dataset = readDataset(in("a.db"));
  for (DriveStep& step : dataset.recordings[0].episodes[7].steps) step.observation.heading += 0.1;
  writeDataset(in("b.db"), dataset);
  const test::Outcome outcome = run("check b.db --most 2");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(contains(outcome.output, "recording 0, episode 7, step 0: heading is ")) << outcome.output;
  EXPECT_TRUE(contains(outcome.output, "... and 9 more")) << outcome.output;
}

TEST_F(DatasetTool, MergesWhatItHasSplit) {
  const std::string output = success("split a.db --share 0.3 --training t.db --validation v.db");
  EXPECT_TRUE(contains(output, "training: ")) << output;
  EXPECT_TRUE(contains(output, "validation: ")) << output;
  EXPECT_EQ(success("merge t.db v.db --output m.db"), "2 datasets, 2 recordings, 60 steps\n");
  EXPECT_EQ(success("check m.db"), "nothing is wrong with 60 steps\n");
}

TEST_F(DatasetTool, ExportsForOtherPrograms) {
  EXPECT_EQ(success("export a.db --output a.csv"), "60 steps\n");
  EXPECT_EQ(success("export a.db --output a.npz --scans"), "60 steps\n");
  std::ifstream csv(in("a.csv"));
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(csv), {}, '\n'), 61) << "a head and a line a step";
  std::ifstream npz(in("a.npz"), std::ios::binary);
  EXPECT_EQ(npz.get(), 'P');
  EXPECT_EQ(npz.get(), 'K');
}

/// The options of `model convert` that an export names.
std::string namedOptions(const std::string& output) {
  const std::string command = "lstm_planner model convert FILE.onnx --output own.onnx";
  const std::size_t at = output.find(command);
  return at == std::string::npos ? "none" : output.substr(at + command.size());
}

TEST_F(DatasetTool, NamesWhatAnEncodedExportsNetworkHasToBeToldOfTheRecording) {
  EXPECT_EQ(namedOptions(success("export a.db --output a.csv --encoded")), "\n");
  Dataset dataset = readDataset(in("a.db"));
  RecorderParameters& parameters = dataset.recordings[0].description.parameters;
  parameters.range_cap = 2.0;
  parameters.action_angles = {-M_PI_2, -M_PI / 6.0, 0.0, M_PI / 6.0, M_PI_2};
  parameters.agent.step.length = 0.25;
  parameters.agent.shield.footprint_radius = 0.149;
  writeDataset(in("b.db"), dataset);
  EXPECT_EQ(namedOptions(success("export b.db --output b.csv --encoded")),
            " --range-cap 2 --actions -90 -30 0 30 90 --step-length 0.25 --robot-radius 0.149\n");
}

TEST_F(DatasetTool, ExportsTheInputsThatAreNamed) {
  const std::string output =
      success("export a.db --output a.csv --encoded --inputs angles events --event-range 0.7 --position-cell 0.1");
  std::ifstream csv(in("a.csv"));
  std::string names;
  std::getline(csv, names);
  EXPECT_EQ(names.substr(0, names.find(",label_0")),
            "episode,step,sector_0,sector_1,sector_2,sector_3,sector_4,sector_5,sector_6,sector_7,goal_distance,"
            "goal_bearing,heading,previous_action,event_0,event_1,event_2,event_3,event_4,event_5,event_6,event_7");
  const std::string options = namedOptions(output);
  EXPECT_TRUE(contains(options, " --layout sector_0 sector_1 ")) << output;
  EXPECT_TRUE(contains(options, " event_7 --position-cell 0.1 --event-range 0.7\n")) << output;
  EXPECT_TRUE(
      contains(complaint("export a.db --output a.csv --inputs angles"), "--inputs has no effect without --enc"));
}

TEST_F(DatasetTool, ListsItsActions) {
  const std::string output = success("--help");
  for (const char* action : {"info", "check", "merge", "split", "export"}) {
    EXPECT_TRUE(contains(output, std::string("  ") + action + "\t")) << action;
    EXPECT_TRUE(contains(success(std::string(action) + " --help"), std::string("lstm_planner dataset ") + action));
  }
}

TEST_F(DatasetTool, RefusesWhatItCannotDoWithASentence) {
  EXPECT_TRUE(contains(complaint(""), "an action is missing"));
  EXPECT_TRUE(contains(complaint("paint a.db"), "there is no action 'paint'"));
  EXPECT_TRUE(contains(complaint("info"), "--file"));
  EXPECT_TRUE(contains(complaint("info none.db"), "there is no such file"));
  EXPECT_TRUE(contains(complaint("export a.db --output a.txt"), "ends in .csv or .npz"));
  EXPECT_TRUE(contains(complaint("export a.db --output a.csv --encoded --scans"), "--encoded and --scans exclude"));
  EXPECT_TRUE(
      contains(complaint("export a.db --output a.npz --encoded"), "a.npz', expected a name that ends in .csv,"));
  EXPECT_TRUE(contains(complaint("merge a.db --output a.db"), "there is such a file already"));
  EXPECT_TRUE(contains(complaint("split a.db --share 1 --training t.db --validation v.db"), "share"));
  EXPECT_TRUE(contains(complaint("split a.db --training t.db --validation a.db"), "there is such a file already"));
  EXPECT_FALSE(std::filesystem::exists(in("t.db"))) << "one part alone is of no use";
}

}  // namespace
}  // namespace lstm_planner::test_dataset_tool
