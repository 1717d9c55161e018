#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "lstm_planner/simulation/drive_film.hpp"
#include "support/scratch_folder.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_drive_film {
namespace {

/// A hall of 8 x 4 m, cut in two by a wall with an opening at the upper end.
OccupancyGrid cutHall() {
  OccupancyGrid grid = test::emptyHall(8.0, 4.0);
  test::fillBox(4.0, 0.0, 4.2, 2.8, &grid);
  return grid;
}

/// The drive from the left part to the right one, a frame a second, 100 pixels a metre.
class DriveFilmTest : public ::testing::Test {
 protected:
  DriveFilmTest() {
    const GridWorld world(cutHall());
    NavigationAgent agent(test::straightAheadPolicy(), test::routeLed());
    result_ =
        drive(world, kTask, test::quickDrive(120.0), 1, &agent, filmOf(cutHall(), kTask, folder_.path(), {1.0, 800}));
  }

  int frames() const {
    return static_cast<int>(
        std::distance(std::filesystem::directory_iterator(folder_.path()), std::filesystem::directory_iterator()));
  }

  /// The colour at a place of the hall, m.
  cv::Vec3b at(int frame, double x, double y) const {
    char name[32];
    std::snprintf(name, sizeof(name), "%04d.png", frame);
    const cv::Mat picture = cv::imread(folder_ / name);
    EXPECT_EQ(picture.cols, 800) << name;
    EXPECT_EQ(picture.rows, 400) << name;
    if (picture.empty()) return {};
    return picture.at<cv::Vec3b>(static_cast<int>(400 - 100 * y), static_cast<int>(100 * x));
  }

  inline static const DriveTask kTask{{1.0, 1.0, 0.0}, {7.0, 1.0}};
  inline static const cv::Vec3b kUnseen{205, 205, 205};
  inline static const cv::Vec3b kSeen{255, 255, 255};
  const test::ScratchFolder folder_;
  DriveResult result_;
};

TEST_F(DriveFilmTest, HasAFrameAPeriod) {
  ASSERT_EQ(result_.end, DriveResult::End::kReached);
  const double last_command = result_.time - 0.1;
  EXPECT_EQ(frames(), 1 + static_cast<int>(last_command + 1e-6));
}

TEST_F(DriveFilmTest, ShowsWhatIsBehindAWallOnlyWhenItWasSeen) {
  EXPECT_EQ(at(0, 3.0, 1.5), kSeen);
  EXPECT_EQ(at(0, 5.0, 1.5), kUnseen);
  EXPECT_EQ(at(frames() - 1, 5.0, 1.5), kSeen);
}

TEST_F(DriveFilmTest, DrawsWhatIsRememberedAndNothingElse) {
  const int last = frames() - 1;
  const auto isDark = [](const cv::Vec3b& color) { return color[0] < 60 && color[1] < 60 && color[2] < 60; };
  EXPECT_FALSE(isDark(at(0, 7.95, 1.0))) << "the right wall is in nobody's sight at first";
  // In front of the robot in the end; the wall in the middle lies behind it, out of the scanner's sight.
  EXPECT_TRUE(isDark(at(last, 4.02, 1.0)) || isDark(at(last, 3.98, 1.0)));
  EXPECT_EQ(at(last, 2.0, 3.0), kSeen);
}

TEST_F(DriveFilmTest, ShowsGoalRobotAndPath) {
  const auto isGreen = [](const cv::Vec3b& color) { return color[1] > 120 && color[0] < 120 && color[2] < 120; };
  EXPECT_TRUE(isGreen(at(0, 7.0, 1.0)));
  EXPECT_EQ(at(0, 1.0, 1.0), cv::Vec3b(130, 40, 0)) << "the robot where it starts";
  const int last = frames() - 1;
  bool route_is_drawn = false;
  for (double y = 2.8; y < 4.0; y += 0.01) route_is_drawn |= at(last, 4.1, y) == cv::Vec3b(235, 130, 20);
  EXPECT_TRUE(route_is_drawn) << "through the opening";
}

TEST(DriveFilm, RefusesWhatCannotBeDrawn) { EXPECT_THROW(filmOf(OccupancyGrid(), {}, ".", {}), std::invalid_argument); }

}  // namespace
}  // namespace lstm_planner::test_drive_film
