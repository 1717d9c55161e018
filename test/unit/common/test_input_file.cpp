#include <sys/stat.h>

#include <fstream>
#include <functional>
#include <vector>

#include "lstm_planner/common/csv_file.hpp"
#include "lstm_planner/common/input_file.hpp"
#include "lstm_planner/dataset/carmen_log.hpp"
#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/grid_world/world/movingai.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "support/folder_test.hpp"
#include "support/refusal.hpp"
#include "training/training_checkpoint.hpp"

namespace lstm_planner::test_input_file {
namespace {

class InputFile : public test::FolderTest {
 protected:
  std::string written(const std::string& name, const std::string& content) const {
    return scratch_.write(name, content);
  }
};

TEST_F(InputFile, GivesTheWholeContent) {
  const std::string content("a\0b\n", 4);
  EXPECT_EQ(readInputFile(written("a", content), 4), content);
  EXPECT_EQ(readInputFile(written("b", ""), 4), "");
}

TEST_F(InputFile, SaysWhyThereIsNone) {
  const auto both = [&](const std::string& path) {
    const std::string reason = test::refusalOf([&] { readInputFile(path, 3); });
    EXPECT_EQ(test::refusalOf([&] { checkInputFile(path, 3); }), reason);
    return reason;
  };
  EXPECT_EQ(both(in("none")), "there is no such file");
  EXPECT_EQ(both(folder_), "it is a folder, expected a file");
  EXPECT_EQ(both("/dev/zero"), "it is a pipe or a device, expected a regular file");
  EXPECT_EQ(both(written("a", "1234")), "it has 4 bytes, expected at most 3");
}

TEST_F(InputFile, NoReaderWaitsForAPipeOrReadsADevice) {
  const std::string pipe = in("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto imageOf = [this](const std::string& path) {
    return written("map.yaml", "image: " + path +
                                   "\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
                                   "free_thresh: 0.2\n");
  };
  const std::vector<std::function<void(const std::string&)>> readers = {
      [](const std::string& path) { readMapServerMap(path, -1.0); },
      [&](const std::string& path) { readMapServerMap(imageOf(path), -1.0); },
      [](const std::string& path) { readMovingAiMap(path, PassableRule::kBenchmark); },
      [](const std::string& path) { readScenarios(path); },
      [](const std::string& path) { CsvFile(path, {"x"}); },
      [](const std::string& path) { readCarmenLog(path); },
      [](const std::string& path) { readModelFile(path); },
      [](const std::string& path) { readTrainingCheckpoint(path, {}); },
      [](const std::string& path) { readDataset(path); },
  };
  for (std::size_t i = 0; i < readers.size(); ++i) {
    for (const std::string& path : {pipe, std::string("/dev/zero")}) {
      const std::string sentence = test::refusalOf([&] { readers[i](path); });
      EXPECT_NE(sentence.find(path), std::string::npos) << "reader " << i << ": " << sentence;
      EXPECT_NE(sentence.find("it is a pipe or a device"), std::string::npos) << "reader " << i << ": " << sentence;
    }
  }
}

}  // namespace
}  // namespace lstm_planner::test_input_file
