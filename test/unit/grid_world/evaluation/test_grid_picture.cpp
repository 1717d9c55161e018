#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>

#include "lstm_planner/grid_world/evaluation/grid_picture.hpp"
#include "support/scratch_folder.hpp"
#include "unit/grid_world/evaluation/grid_fixtures.hpp"

namespace lstm_planner::test_grid_picture {
namespace {

constexpr int kTitle = 26;  // pixels above the map

cv::Mat draw(const PassableGrid& grid, const GridPicture& picture) {
  const test::ScratchFolder folder;
  writeGridPicture(folder / "picture.png", grid, picture);
  return cv::imread(folder / "picture.png");
}

bool isOrange(const cv::Vec3b& color) { return color[2] > 180 && color[1] < 150 && color[0] < 60; }

/// 40 x 20 cells with the first line blocked; 25 pixels a cell.
PassableGrid hall() {
  PassableGrid grid(40, 20, true);
  for (int column = 0; column < 40; ++column) grid.set({column, 0}, false);
  return grid;
}

TEST(GridPicture, HasTheFirstLineOfTheMapAtTheTop) {
  const cv::Mat image = draw(hall(), {"", {5, 10}, {35, 10}, {}});
  ASSERT_EQ(image.cols, 1000);
  EXPECT_LT(image.at<cv::Vec3b>(kTitle + 12, 500)[0], 120);
  EXPECT_EQ(image.at<cv::Vec3b>(kTitle + 100, 500), cv::Vec3b(255, 255, 255));
}

TEST(GridPicture, DrawsAPathThroughTheMiddlesOfItsCells) {
  GridPicture picture{"", {5, 10}, {35, 10}, {{"path", {{5, 10}, {35, 10}}, true}}};
  const cv::Mat image = draw(hall(), picture);
  EXPECT_TRUE(isOrange(image.at<cv::Vec3b>(kTitle + 10 * 25 + 12, 500)));
  EXPECT_FALSE(isOrange(image.at<cv::Vec3b>(kTitle + 13 * 25 + 12, 500)));
}

TEST(GridPicture, MarksAPathThatEndsBeforeTheGoal) {
  GridPicture picture{"", {5, 10}, {35, 10}, {{"path", {{5, 10}, {20, 10}}, false}}};
  const cv::Point beside_the_end(20 * 25 + 12 + 8, kTitle + 10 * 25 + 12 + 8);
  EXPECT_TRUE(isOrange(draw(hall(), picture).at<cv::Vec3b>(beside_the_end)));
  picture.paths[0].arrived = true;
  EXPECT_FALSE(isOrange(draw(hall(), picture).at<cv::Vec3b>(beside_the_end)));
}

TEST(GridPicture, ShowsThePartOfALargeMapThatMatters) {
  const cv::Mat image = draw(PassableGrid(2000, 1500, true), {"", {900, 700}, {940, 730}, {}});
  // 48 cells and a margin, not 2000: many pixels a cell.
  EXPECT_GE(image.cols, 640);
  EXPECT_LE(image.cols, 1000);
}

TEST(GridPicture, ShrinksPathsAcrossAMapOfManyCells) {
  const cv::Mat image = draw(PassableGrid(3000, 3000, true), {"", {0, 0}, {2999, 2999}, {}});
  EXPECT_EQ(image.cols, 1000);
}

TEST(GridPicture, RefusesWhatCannotBeDrawnOrWritten) {
  EXPECT_THROW(writeGridPicture("/tmp/picture.png", PassableGrid(), {}), std::invalid_argument);
  EXPECT_THROW(writeGridPicture("/no/such/folder/picture.png", hall(), {}), std::runtime_error);
  EXPECT_THROW(writeGridPicture(test::ScratchFolder() / "picture.unknown", hall(), {}), std::runtime_error);
}

}  // namespace
}  // namespace lstm_planner::test_grid_picture
