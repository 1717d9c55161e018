#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "support/folder_test.hpp"
#include "support/refusal.hpp"
#include "training/training_checkpoint.hpp"

namespace lstm_planner::test_training_checkpoint {
namespace {

class TrainingCheckpointFile : public test::FolderTest {
 protected:
  void SetUp() override {
    writeTrainingCheckpoint(path_, {{{"seed", 1}, {"cells", {8, 8}}}, {{"best", 0.1}}, {0, 10, 255, 13}});
  }

  std::string refusal(const nlohmann::json& settings) {
    return test::refusalOf<std::invalid_argument>([&] { readTrainingCheckpoint(path_, settings); });
  }

  const std::string path_ = in("checkpoint");
};

TEST_F(TrainingCheckpointFile, GivesBackWhatWasWritten) {
  const auto checkpoint = readTrainingCheckpoint(path_, {{"seed", 1}, {"cells", {8, 8}}});
  ASSERT_TRUE(checkpoint.has_value());
  EXPECT_EQ(checkpoint->learner, (std::vector<std::uint8_t>{0, 10, 255, 13}));
  EXPECT_EQ(checkpoint->progress.at("best").get<double>(), 0.1);  // to the last bit
}

TEST_F(TrainingCheckpointFile, IsEmptyWhereThereIsNoFile) {
  EXPECT_FALSE(readTrainingCheckpoint(path_ + ".other", {}).has_value());
}

TEST_F(TrainingCheckpointFile, RefusesOtherSettingsNamingTheFirst) {
  EXPECT_NE(refusal({{"seed", 2}, {"cells", {8, 8}}}).find("seed = 1 instead of 2"), std::string::npos);
  EXPECT_NE(refusal({{"seed", 1}, {"cells", {16}}}).find("cells = [8,8] instead of [16]"), std::string::npos);
  EXPECT_NE(refusal({{"seed", 1}, {"cells", {8, 8}}, {"rate", 1}}).find("without rate"), std::string::npos);
  EXPECT_NE(refusal({{"seed", 1}}).find("with cells"), std::string::npos);
}

TEST_F(TrainingCheckpointFile, RefusesATruncatedFile) {
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 1);
  EXPECT_NE(refusal({{"seed", 1}, {"cells", {8, 8}}}).find("3 bytes of the learner, expected 4"), std::string::npos);
}

TEST_F(TrainingCheckpointFile, RefusesOtherFiles) {
  std::ofstream(path_) << "lstm_planner training checkpoint 1\n{\"settings\": [\n";
  EXPECT_NE(refusal({}).find("is not a checkpoint"), std::string::npos);
  std::ofstream(path_, std::ios::trunc).close();
  EXPECT_NE(refusal({}).find("is not a checkpoint"), std::string::npos);
}

TEST_F(TrainingCheckpointFile, RefusesAnotherVersion) {
  std::ofstream(path_) << "lstm_planner training checkpoint 2\n"
                       << R"({"settings": {}, "progress": {}, "learner_bytes": 4})"
                       << "\nfour";
  EXPECT_NE(refusal({}).find("is not a checkpoint"), std::string::npos);
}

TEST_F(TrainingCheckpointFile, RefusesALengthThatIsNoNumber) {
  std::ofstream(path_) << "lstm_planner training checkpoint 1\n"
                       << R"({"settings": {}, "progress": {}, "learner_bytes": "four"})"
                       << "\nfour";
  EXPECT_NE(refusal({}).find("4 bytes of the learner, expected \"four\""), std::string::npos);
}

TEST_F(TrainingCheckpointFile, RefusesAHeaderOfManyLevels) {
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  std::ofstream(path_) << "lstm_planner training checkpoint 1\n"
                       << R"({"settings": {"seed": )" << deep << R"(}, "progress": {}, "learner_bytes": 0})"
                       << "\n";
  EXPECT_NE(refusal({{"seed", 1}}).find("more than 16 levels"), std::string::npos);
}

TEST_F(TrainingCheckpointFile, RefusesAPipe) {
  std::filesystem::remove(path_);
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_NE(refusal({}).find("a regular file"), std::string::npos);
}

TEST_F(TrainingCheckpointFile, LeavesTheOldOneWhenItCannotWrite) {
  EXPECT_THROW(writeTrainingCheckpoint(path_ + "/below", {}), std::runtime_error);
  EXPECT_TRUE(readTrainingCheckpoint(path_, {{"seed", 1}, {"cells", {8, 8}}}).has_value());
}

}  // namespace
}  // namespace lstm_planner::test_training_checkpoint
