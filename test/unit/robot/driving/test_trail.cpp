#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/base/common/arc.hpp"
#include "lstm_planner/robot/driving/trail.hpp"

namespace lstm_planner {
namespace {

TEST(Trail, LeadsBackAlongTheArcThatTheRobotCame) {
  Trail trail;
  const double curvature = 2.0;
  for (int i = 0; i <= 100; ++i) trail.note(alongArc({1.0, 2.0, 0.5}, curvature, 0.005 * i), false);
  Pose2 pose = alongArc({1.0, 2.0, 0.5}, curvature, 0.5);
  int steps = 0;
  while (const auto back = trail.back(pose)) {
    EXPECT_LT(back->x, 0.0);
    EXPECT_NEAR(2.0 * back->y / (back->x * back->x + back->y * back->y), curvature, 1e-6) << "an arc of that curvature";
    pose = alongArc(pose, curvature, -0.02);
    trail.note(pose, true);
    ASSERT_LT(++steps, 40);
  }
  EXPECT_NEAR(distanceBetween(pose, Pose2{1.0, 2.0, 0.5}), 0.0, 0.07) << "to within three spacings";
}

TEST(Trail, RemembersTurnsInPlace) {
  Trail trail;
  for (int i = 0; i <= 20; ++i) trail.note({0.0, 0.0, 0.1 * i}, false);
  const auto back = trail.back({0.0, 0.0, 2.0});
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->x, 0.0, 1e-12);
  EXPECT_LT(back->yaw, -0.1);
}

TEST(Trail, HoldsALittleMoreThanAMetre) {
  Trail trail;
  for (int i = 0; i <= 500; ++i) trail.note({0.01 * i, 0.0, 0.0}, false);
  Pose2 pose{5.0, 0.0, 0.0};
  while (trail.back(pose)) {
    pose.x -= 0.01;
    trail.note(pose, true);
  }
  EXPECT_NEAR(pose.x, 5.0 - 60 * 0.02, 0.08);
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
}  // namespace lstm_planner
