#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/drive/motion/trail.hpp"

namespace lstm_planner::test_trail {
namespace {

TEST(Trail, LeadsBackAlongTheArcThatTheRobotCame) {
  Trail trail;
  const double curvature = 2.0;
  for (int i = 0; i <= 100; ++i) trail.note(alongArc({1.0, 2.0, 0.5}, curvature, 0.005 * i), false);
  Pose2 pose = alongArc({1.0, 2.0, 0.5}, curvature, 0.5);
  int steps = 0;
  bool goes_back = true;
  while (distanceBetween(pose, Pose2{1.0, 2.0, 0.5}) > 0.11) {  // five spacings
    const auto back = trail.back(pose);
    if (back) {
      EXPECT_LT(back->x, 0.0);
      EXPECT_NEAR(2.0 * back->y / (back->x * back->x + back->y * back->y), curvature, 1e-6)
          << "an arc of that curvature";
      pose = alongArc(pose, curvature, -0.02);
    }
    ASSERT_TRUE(back || goes_back) << "where it has stopped it may go on";
    goes_back = back.has_value();
    trail.note(pose, goes_back);
    ASSERT_LT(++steps, 80);
  }
}

TEST(Trail, RemembersTurnsInPlace) {
  Trail trail;
  for (int i = 0; i <= 20; ++i) trail.note({0.0, 0.0, 0.1 * i}, false);
  const auto back = trail.back({0.0, 0.0, 2.0});
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->x, 0.0, 1e-12);
  EXPECT_LT(back->yaw, -0.1);
}

TEST(Trail, HoldsAMetreAndAHalf) {
  Trail trail;
  for (int i = 0; i <= 500; ++i) trail.note({0.01 * i, 0.0, 0.0}, false);
  Pose2 pose{5.0, 0.0, 0.0};
  bool goes_back = false;
  for (int i = 0; i < 400; ++i) {
    goes_back = trail.back(pose, goes_back).has_value();
    if (goes_back) pose.x -= 0.01;
    trail.note(pose, goes_back);
  }
  EXPECT_NEAR(pose.x, 5.0 - (75 - 5) * 0.02, 0.05) << "to within five spacings of its end";
}

TEST(Trail, LeadsPastWhatTheRobotDidInBetween) {
  Trail trail;
  for (int i = 0; i <= 50; ++i) trail.note({0.02 * i, 0.0, 0.0}, false);
  // At the end it tries to turn, for longer than the trail is long.
  for (int i = 0; i < 1000; ++i) trail.note({1.0, 0.0, 0.3 * std::sin(0.2 * i)}, false);
  trail.note({1.0, 0.0, 0.0}, false);
  const auto back = trail.back({1.0, 0.0, 0.0});
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->x, -0.11, 0.011) << "five spacings, or six";
  EXPECT_NEAR(back->yaw, 0.0, 1e-9);
}

TEST(Trail, LeadsNowhereFromBesideIt) {
  Trail trail;
  for (int i = 0; i <= 50; ++i) trail.note({0.02 * i, 0.0, 0.0}, false);
  const Pose2 last{1.0, 0.0, 0.0};
  EXPECT_TRUE(trail.back(last));
  EXPECT_FALSE(trail.back({last.x, 0.03, 0.0})) << "two centimetres are its spacing";
  EXPECT_FALSE(trail.back({last.x, 0.0, 0.06})) << "and 0.05 rad";
  EXPECT_TRUE(trail.back({last.x, 0.03, 0.0}, true)) << "whoever goes back cuts corners";
  EXPECT_FALSE(trail.back({last.x, 0.06, 0.0}, true));
}

TEST(Trail, HasNothingAtTheStartAndAfterAJump) {
  Trail trail;
  EXPECT_FALSE(trail.back({}));
  trail.note({}, false);
  EXPECT_FALSE(trail.back({})) << "there is nothing behind its first pose";
  trail.note({0.5, 0.0, 0.0}, false);
  EXPECT_TRUE(trail.back({0.5, 0.0, 0.0}));
  trail.clear();
  EXPECT_FALSE(trail.back({0.5, 0.0, 0.0}));
}

}  // namespace
}  // namespace lstm_planner::test_trail
