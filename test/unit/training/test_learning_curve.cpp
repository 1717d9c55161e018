#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "lstm_planner/training/learning_curve.hpp"
#include "support/picture_check.hpp"
#include "support/scratch_folder.hpp"

namespace lstm_planner::test_learning_curve {
namespace {

namespace fs = std::filesystem;

LossSum lossSum(double loss, std::int64_t right, std::int64_t wrong) {
  LossSum sum;
  sum.weight = static_cast<double>(right + wrong);
  sum.loss = loss * sum.weight;
  sum.confusion.setZero(2, 2);
  sum.confusion(0, 0) = right;
  sum.confusion(0, 1) = wrong;
  return sum;
}

std::vector<EpochReport> curve() {
  return {{1, 0.5, lossSum(1.5, 1, 3), lossSum(2.0, 1, 1), true},
          {2, 0.25, lossSum(0.5, 3, 1), lossSum(0.75, 3, 1), true}};
}

class LearningCurve : public ::testing::Test {
 protected:
  void SetUp() override { path_ = std::getenv("PATH"); }
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }
  std::string file(const std::string& name) const { return folder_ / name; }
  std::string content(const std::string& name) const { return folder_.read(name); }

  // A quote and a space: both shells on the way must leave them alone.
  const test::ScratchFolder folder_{"learning curve's"};
  std::string path_;
};

TEST_F(LearningCurve, CsvHasALineAnEpoch) {
  writeLearningCurveCsv(file("curve.csv"), curve());
  EXPECT_EQ(content("curve.csv"),
            "epoch,learning_rate,training_accuracy,training_loss,validation_accuracy,validation_loss,best\n"
            "1,0.5,0.25,1.5,0.5,2,1\n"
            "2,0.25,0.75,0.5,0.75,0.75,1\n");
}

TEST_F(LearningCurve, ColumnsOfAMissingValidationSetAreEmpty) {
  auto without = curve();
  for (EpochReport& report : without) report.validation = {};
  writeLearningCurveCsv(file("curve.csv"), without);
  EXPECT_NE(content("curve.csv").find("\n1,0.5,0.25,1.5,,,1\n"), std::string::npos);
}

TEST_F(LearningCurve, AveragedWeightsHaveColumnsOfTheirOwn) {
  auto with_average = curve();
  for (EpochReport& report : with_average) report.averaged = lossSum(0.25, 7, 1);
  writeLearningCurveCsv(file("curve.csv"), with_average);
  EXPECT_NE(content("curve.csv").find(",best,averaged_accuracy,averaged_loss\n"), std::string::npos);
  EXPECT_NE(content("curve.csv").find("\n1,0.5,0.25,1.5,0.5,2,1,0.875,0.25\n"), std::string::npos);
}

TEST_F(LearningCurve, PictureShowsTheCurves) {
  writeLearningCurve(file("curve.png"), curve());
  test::expectPicture(file("curve.png"), 900, 800);
  auto without = curve();
  for (EpochReport& report : without) report.validation = {};
  writeLearningCurve(file("without.png"), without);
  test::expectPicture(file("without.png"), 900, 800);
  auto with_average = curve();
  for (EpochReport& report : with_average) report.averaged = lossSum(0.25, 7, 1);
  writeLearningCurve(file("average.png"), with_average);
  test::expectPicture(file("average.png"), 900, 800);
}

TEST_F(LearningCurve, MissingGnuplotIsSaidAndTheCsvIsThere) {
  ::setenv("PATH", folder_.path().c_str(), 1);
  try {
    writeLearningCurve(file("curve.png"), curve());
    FAIL() << "drew without gnuplot";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("needs gnuplot, which is not installed"), std::string::npos)
        << error.what();
  }
  EXPECT_NE(content("curve.csv").find("\n2,0.25,"), std::string::npos);
}

TEST_F(LearningCurve, UnwritableFileIsNamed) {
  try {
    writeLearningCurveCsv(file("no_such_folder/curve.csv"), curve());
    FAIL() << "wrote into a folder that does not exist";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no_such_folder/curve.csv"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lstm_planner::test_learning_curve
