#include <gtest/gtest.h>

#include "lstm_planner/common/canvas.hpp"

namespace lstm_planner::test_canvas {
namespace {

const cv::Vec3b kWhite(255, 255, 255);
const cv::Vec3b kBlack(0, 0, 0);
const cv::Scalar kRed(0, 0, 255);

cv::Mat whiteCells(int rows, int columns) { return cv::Mat(rows, columns, CV_8UC3, kWhite); }

TEST(Canvas, CellsBecomeSquaresOfWholePixelsWithinTheLongerSide) {
  cv::Mat cells = whiteCells(2, 3);
  cells.at<cv::Vec3b>(1, 2) = kBlack;
  Canvas canvas(cells, 20);
  EXPECT_DOUBLE_EQ(canvas.scale(), 6.0);  // 20 / 3, rounded down
  EXPECT_EQ(canvas.image().size(), cv::Size(18, 12));
  EXPECT_EQ(canvas.image().at<cv::Vec3b>(6, 12), kBlack);
  EXPECT_EQ(canvas.image().at<cv::Vec3b>(6, 11), kWhite);
  EXPECT_EQ(canvas.image().at<cv::Vec3b>(5, 12), kWhite);
}

TEST(Canvas, AThinWallOfALargeMapIsStillSeen) {
  cv::Mat cells = whiteCells(40, 100);
  cells.col(33).setTo(kBlack);
  Canvas canvas(cells, 25);
  EXPECT_DOUBLE_EQ(canvas.scale(), 0.25);
  EXPECT_EQ(canvas.image().size(), cv::Size(25, 10));
  // One of four columns that become one pixel.
  EXPECT_NEAR(canvas.image().at<cv::Vec3b>(5, 8)[0], 255 * 3 / 4, 1);
}

TEST(Canvas, PlacesLieBetweenPixels) {
  EXPECT_EQ(Canvas::fine(1.0, 2.5), cv::Point(16, 40));
  EXPECT_EQ(Canvas::pixelOf(Canvas::fine(3.9, 7.0)), cv::Point(3, 7));
}

TEST(Canvas, ACrossReachesAsFarToEachSide) {
  Canvas canvas(whiteCells(41, 41), 41);
  canvas.cross(Canvas::fine(20.0, 20.0), 10.0, kRed, 1);
  for (const cv::Point& place : {cv::Point(20, 20), cv::Point(12, 12), cv::Point(28, 12), cv::Point(12, 28)}) {
    EXPECT_LT(canvas.image().at<cv::Vec3b>(place)[0], 128) << place;
  }
  EXPECT_EQ(canvas.image().at<cv::Vec3b>(20, 10), kWhite);
  EXPECT_EQ(canvas.image().at<cv::Vec3b>(5, 5), kWhite);
}

}  // namespace
}  // namespace lstm_planner::test_canvas
