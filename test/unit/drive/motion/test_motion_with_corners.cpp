#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "unit/drive/motion/motion_fixtures.hpp"
#include "unit/drive/motion/plan_along.hpp"

namespace lstm_planner::test_motion_with_corners {
namespace {

using test::jackal;
using test::planAlong;

constexpr double kPeriod = 0.1;
constexpr double kMargin = 0.03;

MotionParameters jackalMotion() {
  MotionParameters motion = test::limitsOfJackal();
  motion.lookahead = 0.6;
  motion.slow_speed = 0.5;
  motion.slow_gap = 0.2;
  return motion;
}

class MotionWithCorners : public ::testing::Test {
 protected:
  MotionCommand compute(const std::vector<Pose2>& plan, const Twist2& current = {},
                        const MotionHistory& history = {}) const {
    return controller_.compute({plan, {}, current, shield_, kPeriod}, {}, {}, history);
  }

  MotionController controller_{jackalMotion()};
  Shield shield_{jackal(), kMargin, 4.0};
};

TEST_F(MotionWithCorners, TurnsInPlaceWhereThereIsRoom) {
  const MotionCommand command = compute(planAlong({{0.0, 0.0}, {-3.0, 0.5}}));
  EXPECT_EQ(command.linear, 0.0);
  EXPECT_GT(command.angular, 0.5);
}

TEST_F(MotionWithCorners, TurnsTheOtherWayRoundWhereACornerWouldHitSomething) {
  // Behind a Waffle's axle are its farthest corners, 0.251 m away at +-2.53 rad; the post is 0.23 m away at 2.18 rad.
  // To the right one of them is there within 0.35 rad, to the left the other one only after 4.71 rad: both less the
  // width of the post with the margin. The plan lies 2 rad to the right, or 4.28 rad to the left.
  shield_ = Shield(test::waffle(), kMargin, 4.0);
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, pointAlong(Point2{}, -2.0, 3.0)});
  EXPECT_LT(compute(plan).angular, 0.0);
  shield_.show({pointAlong(Point2{}, 2.18, 0.23)});
  ASSERT_LT(shield_.freeTurn({}, -2.0, kMargin), 0.35);
  const MotionCommand command = compute(plan);
  EXPECT_EQ(command.linear, 0.0);
  EXPECT_GT(command.angular, 0.0);
}

/// Posts so near to both sides that no corner gets past them.
std::vector<Point2> corridor(double half_width = 0.26) {
  std::vector<Point2> posts;
  for (double x = -1.0; x <= 1.0; x += 0.02) {
    posts.push_back({x, half_width});
    posts.push_back({x, -half_width});
  }
  return posts;
}

TEST_F(MotionWithCorners, DoesNotTurnInACorridorThatItsCornersDoNotFit) {
  shield_.show(corridor());
  const MotionCommand stands = compute(planAlong({{0.0, 0.0}, {-3.0, 0.1}}));
  EXPECT_LT(std::abs(stands.angular), 0.3);
}

TEST_F(MotionWithCorners, GoesBackTheWayItCameWhereItCannotTurn) {
  std::vector<Point2> posts = corridor();
  posts.push_back({0.3, 0.0});  // and not on
  shield_.show(posts);
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {-3.0, 0.1}});
  const MotionCommand command = compute(plan, {}, {Pose2{-0.06, 0.0, 0.0}, false});
  EXPECT_LT(command.linear, 0.0);
  EXPECT_NEAR(command.angular, 0.0, 1e-9);
  EXPECT_TRUE(command.goes_back);
  // Not farther than it came, braking included.
  EXPECT_LE(-command.linear * 0.25 + command.linear * command.linear / (2.0 * 2.0), 0.08);
  const MotionCommand nowhere = compute(plan);
  EXPECT_GE(nowhere.linear, 0.0) << "where it never was it does not back into";
  EXPECT_FALSE(nowhere.goes_back);
}

TEST_F(MotionWithCorners, GoesOnBackUntilItCanTurn) {
  shield_.show(corridor());
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {-3.0, 0.1}});
  EXPECT_LT(compute(plan, {-0.2, 0.0}, {Pose2{-0.06, 0.0, 0.0}, true}).linear, 0.0);
  shield_.show({});
  const MotionCommand turn = compute(plan, {-0.2, 0.0}, {Pose2{-0.06, 0.0, 0.0}, true});
  EXPECT_FALSE(turn.goes_back);
  EXPECT_NE(turn.angular, 0.0);
}

TEST_F(MotionWithCorners, GoesOnBackNoFartherWhereThePlanLeadsStraightOn) {
  shield_.show(corridor());
  const MotionHistory history{Pose2{-0.1, 0.0, 0.0}, true};
  const MotionCommand on = compute(planAlong({{0.0, 0.0}, {3.0, 0.0}}), {}, history);
  EXPECT_FALSE(on.goes_back);
  EXPECT_GT(on.linear, 0.0);
}

TEST_F(MotionWithCorners, FollowsAPlannedWayOutAlsoWhereThePlanLeadsStraightOn) {
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {3.0, 0.0}});
  MotionHistory history{Pose2{-0.1, 0.0, 0.0}};
  EXPECT_FALSE(compute(plan, {}, history).goes_back);
  history.gets_out = true;
  const MotionCommand out = compute(plan, {}, history);
  EXPECT_TRUE(out.goes_back);
  EXPECT_LT(out.linear, 0.0);
  EXPECT_FALSE(controller_.compute({plan, {}, {}, shield_, kPeriod}, {{2.5, 0.0}}, {}, history).goes_back)
      << "not where somebody moves";
}

TEST_F(MotionWithCorners, FollowsAWayOutForwardsToo) {
  shield_.show(corridor(0.25));
  MotionHistory history{Pose2{0.1, 0.0, 0.0}, true};
  history.gets_out = true;
  const MotionCommand on = compute(planAlong({{0.0, 0.0}, {-3.0, 0.1}}), {}, history);
  EXPECT_TRUE(on.goes_back);
  EXPECT_GT(on.linear, 0.0);
}

TEST_F(MotionWithCorners, StandsBeforeItChangesItsWay) {
  shield_.show(corridor(0.25));  // so narrow that it does not turn at all
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {-3.0, 0.1}});
  // It never was behind: it drives on, and back once it has been there.
  const MotionHistory never;
  const MotionHistory was{Pose2{-0.06, 0.0, 0.0}};
  ASSERT_GT(compute(plan, {}, never).linear, 0.0);
  ASSERT_LT(compute(plan, {}, was).linear, 0.0);
  const auto after = [](MotionHistory history, double linear) {
    history.commanded = {{linear, 0.0}};
    return history;
  };
  for (const MotionCommand& command : {compute(plan, {}, after(never, -0.1)), compute(plan, {}, after(was, 0.1))}) {
    EXPECT_EQ(command.linear, 0.0);
    EXPECT_EQ(command.angular, 0.0);
    EXPECT_EQ(command.stop, StopReason::kObstacle);
  }
  EXPECT_GT(compute(plan, {}, after(never, 0.1)).linear, 0.0);
  EXPECT_LT(compute(plan, {}, after(was, -0.1)).linear, 0.0);
}

TEST_F(MotionWithCorners, DoesNotBackNorTurnItsCornersWhereSomebodyMoves) {
  std::vector<Point2> posts = corridor();
  posts.push_back({0.3, 0.0});
  shield_.show(posts);
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {-3.0, 0.1}});
  const std::vector<Point2> far_off{{2.5, 0.0}};
  const MotionHistory came{Pose2{-0.06, 0.0, 0.0}, false};
  const MotionCommand among = controller_.compute({plan, {}, {}, shield_, kPeriod}, far_off, {}, came);
  EXPECT_EQ(among.linear, 0.0);
  EXPECT_EQ(among.stop, StopReason::kPerson);
  // A corner reaches 0.12 m farther than the sides. Somebody who is 1 m off is there before it would stand; who is 2.5
  // m off is not.
  shield_.show({});
  EXPECT_NE(controller_.compute({plan, {}, {}, shield_, kPeriod}, far_off).angular, 0.0);
  const MotionCommand beside = controller_.compute({plan, {}, {}, shield_, kPeriod}, {{0.0, 0.6}});
  EXPECT_EQ(beside.angular, 0.0);
  EXPECT_EQ(beside.stop, StopReason::kPerson);
}

/// Whatever is around: neither the command at once nor after the reaction time touches anything before it stands.
TEST_F(MotionWithCorners, NoCommandEndsInWhatIsSeen) {
  Random random(5);
  const MotionParameters& motion = controller_.parameters();
  int drove = 0;
  for (int i = 0; i < 400; ++i) {
    std::vector<Point2> posts;
    for (int k = 0; k < 30; ++k) {
      const Point2 post{uniform(random, -1.5, 1.5), uniform(random, -1.5, 1.5)};
      if (jackal().distanceTo(post) > kMargin + 1e-3) posts.push_back(post);
    }
    shield_.show(posts);
    const double far = uniform(random, -M_PI, M_PI);
    const MotionCommand command = compute(planAlong({{0.0, 0.0}, pointAlong(Point2{}, far, 3.0)}));
    drove += command.linear > 0.1;
    // From standing: the reaction time at the commanded twist, then both wheels brake.
    const double rim = std::abs(command.linear) + 0.5 * motion.axle_length * std::abs(command.angular);
    const double time = motion.reaction_time + 0.5 * rim / motion.linear_acceleration;
    for (double share = 0.0; share <= 1.0; share += 0.02) {
      const Pose2 pose = alongTurn({}, share * time * command.linear, share * time * command.angular);
      for (const Point2& post : posts) {
        ASSERT_GE(jackal().distanceTo(toLocalFrame(pose, post)), kMargin - 2e-3) << i;
      }
    }
  }
  EXPECT_GT(drove, 50) << "it does not only stand";
}

/// A small robot that may creep, amid returns from touching on: whatever it is told, no return within the margin comes
/// nearer, and no other one comes into the margin, until it stands.
class MotionAmidNearReturns : public ::testing::TestWithParam<Footprint> {};

TEST_P(MotionAmidNearReturns, NoCommandComesNearerThanTheMarginOrThanItIs) {
  const Footprint& footprint = GetParam();
  MotionParameters motion;
  motion.slow_speed = 0.15;
  motion.safety_margin = kMargin;
  const MotionController controller(motion);
  Shield shield(footprint, kMargin, 4.0);
  Random random(7);
  int moved = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<Point2> posts;
    const int count = 1 + static_cast<int>(uniform(random, 0.0, 12.0));
    while (static_cast<int>(posts.size()) < count) {
      const Point2 post{uniform(random, -0.8, 0.8), uniform(random, -0.8, 0.8)};
      if (footprint.distanceTo(post) > 1e-3) posts.push_back(post);
    }
    shield.show(posts);
    const double far = uniform(random, -M_PI, M_PI);
    MotionHistory history;
    history.has_stood = i % 4 == 0;
    const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, pointAlong(Point2{}, far, 3.0)});
    const MotionCommand command = controller.compute({plan, {}, {}, shield, kPeriod}, {}, {}, history);
    const double margin = history.has_stood ? 0.5 * kMargin : kMargin;
    moved += command.linear != 0.0 || command.angular != 0.0;
    const double rim = std::abs(command.linear) + 0.5 * motion.axle_length * std::abs(command.angular);
    const double time = motion.reaction_time + 0.5 * rim / motion.linear_acceleration;
    // Between two samples no point moves farther than a hundredth of the way; sweeps are exact to a millimetre.
    for (double share = 0.0; share <= 1.0; share += 0.01) {
      const Pose2 pose = alongTurn({}, share * time * command.linear, share * time * command.angular);
      for (const Point2& post : posts) {
        const double kept = std::min(margin, footprint.distanceTo(post));
        ASSERT_GE(footprint.distanceTo(toLocalFrame(pose, post)), kept - 2e-3)
            << i << ": " << command.linear << ", " << command.angular;
      }
    }
  }
  EXPECT_GT(moved, 300) << "it does not only stand";
}

INSTANTIATE_TEST_SUITE_P(
    Footprints, MotionAmidNearReturns,
    ::testing::Values(test::jackal(), test::waffle(),
                      Footprint({{-0.22, -0.175}, {0.13, -0.175}, {0.13, 0.175}, {-0.22, 0.175}})));

}  // namespace
}  // namespace lstm_planner::test_motion_with_corners
