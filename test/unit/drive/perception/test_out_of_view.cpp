#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lstm_planner/drive/perception/out_of_view.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"

namespace lstm_planner::test_out_of_view {
namespace {

/// A scanner in the middle of the robot that sees half of what is around.
class OutOfViewTest : public ::testing::Test {
 protected:
  OutOfViewTest() {
    parameters_.noise = 0.0;
    parameters_.dropout = 0.0;
    parameters_.mount.pose = {};
    parameters_.beams = 181;
    parameters_.angle_min = -M_PI_2;
    parameters_.angle_increment = M_PI / 180.0;
    parameters_.range_min = 0.02;
  }

  void sense(const Pose2& pose) {
    Hokuyo scanner(parameters_, 1);
    scanner.scan(world_, pose, 0.0, &scan_);
    perceive(scan_, parameters_.mount, Hokuyo::rules(), 6.0, &situation_);
    situation_.pose = pose;
    out_of_view_.show(situation_);
  }

  /// Of what is remembered, how much lies within 1 cm of the post's rim; all must.
  std::size_t onThePost(const Pose2& pose, const Circle& post) const {
    for (const Point2& point : out_of_view_.points()) {
      EXPECT_NEAR(distanceBetween(toParentFrame(pose, point), post.center), post.radius, 0.01);
    }
    return out_of_view_.points().size();
  }

  static constexpr Circle kPost{{0.6, 0.0}, 0.1};
  CircleWorld world_{{kPost}};
  HokuyoParameters parameters_;
  LaserScan scan_;
  Situation situation_;
  OutOfView out_of_view_{Footprint({{0.3, 0.2}, {0.3, -0.2}, {-0.3, -0.2}, {-0.3, 0.2}})};
};

TEST_F(OutOfViewTest, RemembersNothingThatIsInView) {
  sense({});
  sense({});
  EXPECT_EQ(out_of_view_.points().size(), 0u);
}

TEST_F(OutOfViewTest, RemembersWhatLeftTheFieldOfViewWhereItIs) {
  sense({});
  const Pose2 turned{0.05, 0.02, M_PI};
  sense(turned);
  EXPECT_GT(onThePost(turned, kPost), 10u);
  const Pose2 on{0.0, 0.02, M_PI - 0.3};
  sense(on);
  EXPECT_GT(onThePost(on, kPost), 10u);
}

TEST_F(OutOfViewTest, RemembersWhatAFilterTakesOutOfTheScan) {
  sense({});
  scan_.ranges.assign(scan_.ranges.size(), static_cast<float>(scan_.range_max) + 1.0f);
  perceive(scan_, parameters_.mount, urgNodeRules(), 6.0, &situation_);
  out_of_view_.show(situation_);
  EXPECT_GT(onThePost({}, kPost), 10u);
}

TEST_F(OutOfViewTest, RemembersWhatASlowTurnTakesOutOfView) {
  constexpr double kTurn = 0.3 * M_PI / 180.0;  // per scan; less than half of the angle between two beams
  sense({});
  const std::vector<Point2> seen = situation_.obstacles;
  ASSERT_GT(seen.size(), 10u);
  Pose2 pose;
  for (; pose.yaw < M_PI_2 + 0.25; pose.yaw += kTurn) sense(pose);
  onThePost(situation_.pose, kPost);
  for (const Point2& place : seen) {
    double nearest = 1.0;
    for (const Point2& point : out_of_view_.points()) {
      nearest = std::min(nearest, distanceBetween(place, toParentFrame(situation_.pose, point)));
    }
    EXPECT_LT(nearest, 0.02) << "1 cm between what is remembered, and 1 cm between two beams";
  }
}

TEST_F(OutOfViewTest, TheScanCountsWhenThePlaceIsInViewAgain) {
  sense({});
  sense({0.0, 0.0, M_PI});
  world_ = CircleWorld({});  // somebody took it away
  sense({0.0, 0.0, M_PI - 0.1});
  EXPECT_GT(out_of_view_.points().size(), 0u);
  sense({});
  EXPECT_EQ(out_of_view_.points().size(), 0u);
}

TEST_F(OutOfViewTest, ForgetsWhatIsFarAwayAndEverythingAfterAJump) {
  sense({});
  sense({0.0, 0.0, M_PI});
  sense({-1.0, 0.0, M_PI});
  EXPECT_GT(out_of_view_.points().size(), 0u) << "a robot with corners goes back by up to 1.2 m";
  sense({-2.0, 0.0, M_PI});  // 1.86 m around the middle matter
  EXPECT_EQ(out_of_view_.points().size(), 0u);
  sense({});
  out_of_view_.forget();
  sense({0.0, 0.0, M_PI});
  EXPECT_EQ(out_of_view_.points().size(), 0u);
}

}  // namespace
}  // namespace lstm_planner::test_out_of_view
