#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "lstm_planner/training/confusion.hpp"
#include "support/picture_check.hpp"
#include "support/refusal.hpp"
#include "support/scratch_folder.hpp"

namespace lstm_planner::test_confusion {
namespace {

namespace fs = std::filesystem;

/// The third label never occurs, the first is always taken for the second.
ConfusionMatrix confusion() {
  ConfusionMatrix counts(3, 3);
  counts << 0, 4, 0, 2, 6, 0, 0, 0, 0;
  return counts;
}

TEST(Confusion, RecallIsByLabelAndPrecisionByAnswer) {
  const std::vector<double> recall = recalls(confusion());
  EXPECT_EQ(recall[0], 0.0);
  EXPECT_DOUBLE_EQ(recall[1], 0.75);
  EXPECT_TRUE(std::isnan(recall[2]));
  const std::vector<double> precision = precisions(confusion());
  EXPECT_EQ(precision[0], 0.0);
  EXPECT_DOUBLE_EQ(precision[1], 0.6);
  EXPECT_TRUE(std::isnan(precision[2]));
}

TEST(Confusion, BalancedAccuracyIsTheMeanRecallOfTheLabelsThatOccur) {
  EXPECT_DOUBLE_EQ(balancedAccuracy(confusion()), 0.375);
  EXPECT_EQ(balancedAccuracy(ConfusionMatrix::Zero(3, 3)), 0.0);
  ConfusionMatrix always_straight = ConfusionMatrix::Zero(5, 5);
  always_straight.col(2) << 1, 2, 900, 3, 4;
  EXPECT_DOUBLE_EQ(balancedAccuracy(always_straight), 0.2);
}

TEST(Confusion, TextHasARowALabelWithItsRecallAndARowOfPrecisions) {
  EXPECT_EQ(confusionText(confusion(), {"-45", "0", "45"}),
            "label \\ answer     -45       0      45  recall\n"
            "           -45       0       4       0     0.0\n"
            "             0       2       6       0    75.0\n"
            "            45       0       0       0       -\n"
            "precision          0.0    60.0       -\n");
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([] {
              confusionText(confusion(), {"-45", "0"});
            }),
            "the confusion matrix has 3 classes, expected 2 as there are names");
}

TEST(Confusion, PictureIsDrawnAndTheCountsAreBesideIt) {
  const test::ScratchFolder folder("a folder");
  writeConfusion(folder / "it.png", confusion(), {"-45", "0", "45"});
  test::expectPicture(folder / "it.png", 720, 640);
  EXPECT_EQ(folder.read("it.csv"), "label,answer -45,answer 0,answer 45\n-45,0,4,0\n0,2,6,0\n45,0,0,0\n");
}

}  // namespace
}  // namespace lstm_planner::test_confusion
