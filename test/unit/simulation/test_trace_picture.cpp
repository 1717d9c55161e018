#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <string>

#include "lstm_planner/simulation/trace_picture.hpp"
#include "support/refusal.hpp"
#include "support/scratch_folder.hpp"

namespace lstm_planner::test_trace_picture {
namespace {

/// 100 x 50 cells of 0.1 m from (-2, 1): at 1000 pixels a cell is 10 pixels wide.
OccupancyGrid room() {
  OccupancyGrid grid(100, 50, 0.1, {-2.0, 1.0, 0.0});
  for (int column = 0; column < 100; ++column) grid.set({column, 0}, Cell::kOccupied);
  for (int row = 0; row < 50; ++row) grid.set({99, row}, Cell::kUnknown);
  return grid;
}

cv::Mat draw(const OccupancyGrid& grid, const TracePicture& picture, int longest_side) {
  const test::ScratchFolder folder;
  writeTracePicture(folder / "picture.png", grid, picture, longest_side);
  return cv::imread(folder / "picture.png");
}

cv::Vec3b pixel(const cv::Mat& image, int column, int row) { return image.at<cv::Vec3b>(row, column); }

bool isRed(const cv::Vec3b& color) { return color[2] > 150 && color[0] < 120 && color[1] < 120; }
bool isBlue(const cv::Vec3b& color) { return color[0] > 150 && color[2] < 120; }
bool isGreen(const cv::Vec3b& color) { return color[1] > 120 && color[0] < 120 && color[2] < 120; }

TEST(TracePicture, PutsRowZeroOfTheMapAtTheBottom) {
  const cv::Mat image = draw(room(), {}, 1000);
  ASSERT_EQ(image.cols, 1000);
  ASSERT_EQ(image.rows, 500);
  EXPECT_LT(pixel(image, 700, 495)[0], 60);
  EXPECT_EQ(pixel(image, 700, 5), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(pixel(image, 995, 250), cv::Vec3b(205, 205, 205));
}

TEST(TracePicture, DrawsTracesRedWhereTheMapFrameSaysSo) {
  TracePicture picture;
  picture.traces = {{{0.0, 3.0}, {4.0, 3.0}}};
  const cv::Mat image = draw(room(), picture, 1000);
  // x = 2 m is 4 m from the left border, y = 3 m is 2 m above the lower one.
  EXPECT_TRUE(isRed(pixel(image, 400, 299)) || isRed(pixel(image, 400, 300)));
  EXPECT_EQ(pixel(image, 400, 200), cv::Vec3b(255, 255, 255));
}

TEST(TracePicture, TellsReachedGoalsFromMissedOnes) {
  TracePicture picture;
  picture.goals = {{{1.0, 3.0}, "", true}, {{4.0, 3.0}, "", false}};
  const cv::Mat image = draw(room(), picture, 1000);
  EXPECT_TRUE(isGreen(pixel(image, 300, 300)));
  EXPECT_FALSE(isGreen(pixel(image, 600, 300)));
  EXPECT_NE(pixel(image, 600, 300), cv::Vec3b(255, 255, 255));
}

TEST(TracePicture, DrawsEscapesOverTracesAndCirclesUnderThem) {
  TracePicture picture;
  picture.traces = {{{0.0, 3.0}, {4.0, 3.0}}};
  picture.parts = {{Leader::kRoute, true, {{1.0, 3.0}, {2.0, 3.0}}}};
  picture.circles = {{{3.0, 3.0}, 0.5}};
  const cv::Mat image = draw(room(), picture, 1000);
  EXPECT_TRUE(isRed(pixel(image, 250, 299)) || isRed(pixel(image, 250, 300)));
  EXPECT_TRUE(isBlue(pixel(image, 350, 299)) || isBlue(pixel(image, 350, 300)));
  EXPECT_TRUE(isRed(pixel(image, 500, 299)) || isRed(pixel(image, 500, 300)));
  EXPECT_LT(pixel(image, 500, 270)[0], 60) << "0.3 m above the middle of the circle";
}

TEST(TracePicture, ShowsPeopleWhereTheyAre) {
  TracePicture picture;
  picture.walkers = {std::vector<Point2>(200, Point2{1.0, 3.0})};
  const cv::Mat image = draw(room(), picture, 1000);
  EXPECT_LT(pixel(image, 325, 299)[2], 200) << "the rim of a disc of 0.25 m";
  EXPECT_EQ(pixel(image, 340, 299), cv::Vec3b(255, 255, 255));
}

TEST(TracePicture, ExplainsItselfBelowTheMap) {
  TracePicture picture;
  picture.title = "a title";
  picture.legend = true;
  const int one_line = draw(room(), picture, 1000).rows;
  EXPECT_GT(one_line, 500);
  EXPECT_LT(pixel(draw(room(), picture, 1000), 700, 495)[2], 60) << "the map stays where it was";
  for (int i = 0; i < 40; ++i) picture.title += " that is long";
  const cv::Mat image = draw(room(), picture, 1000);
  EXPECT_GT(image.rows, one_line) << "more lines";
  EXPECT_EQ(image.cols, 1000);
}

TEST(TracePicture, ShrinksMapsWithMoreCellsThanPixels) {
  const cv::Mat image = draw(OccupancyGrid(3000, 1500, 0.05), {}, 600);
  EXPECT_EQ(image.cols, 600);
  EXPECT_EQ(image.rows, 300);
}

TEST(TracePicture, DrawsThingsFarOutsideTheMapWithoutHarm) {
  TracePicture picture;
  picture.traces = {{{0.0, 3.0}, {1e12, -1e12}}};
  picture.goals = {{{-1e9, 0.0}, "far", true}};
  EXPECT_FALSE(draw(room(), picture, 1000).empty());
}

TEST(TracePicture, RefusesWhatCannotBeDrawnOrWritten) {
  const test::ScratchFolder folder;
  const auto refusal = [&](const std::string& name, const OccupancyGrid& map) {
    return test::refusalOf([&] { writeTracePicture(folder / name, map, {}); });
  };
  const std::string missing = "missing/picture.png";
  const std::string unknown = "picture.unknown";
  EXPECT_EQ(refusal("picture.png", OccupancyGrid()), "an empty map cannot be drawn");
  EXPECT_EQ(refusal(missing, room()),
            "picture '" + folder / missing + "' cannot be written: No such file or directory");
  EXPECT_EQ(refusal(unknown, room()),
            "picture '" + folder / unknown + "' cannot be written (expected a path to a .png or .jpg)");
}

}  // namespace
}  // namespace lstm_planner::test_trace_picture
