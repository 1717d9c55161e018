#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "drive/collision/footprint_sweep.hpp"
#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/common/random.hpp"
#include "unit/drive/motion/motion_fixtures.hpp"

namespace lstm_planner::test_footprint_sweep {
namespace {

using test::jackal;
using test::waffle;

const Footprint& wedge() {
  static const Footprint footprint({{0.4, 0.0}, {0.1, 0.25}, {-0.3, 0.2}, {-0.2, -0.3}, {0.2, -0.2}});
  return footprint;
}

/// A motion by small steps, which the sweep has to agree with.
struct Motion {
  double curvature;  ///< 1/m
  bool back;
  bool turns;
  bool left;

  FootprintSweep sweepOf(const Footprint& footprint) const {
    if (turns) return FootprintSweep::turn(footprint, left);
    return FootprintSweep::arc(footprint, curvature, back);
  }
  Pose2 poseAfter(double length) const {
    if (turns) return {0.0, 0.0, left ? length : -length};
    return alongArc({}, curvature, back ? -length : length);
  }
};

Motion randomMotion(Random& random) {
  const std::size_t kind = uniformIndex(random, 4);
  if (kind == 0) return {0.0, false, true, uniformIndex(random, 2) == 0};
  if (kind == 1) return {0.0, uniformIndex(random, 2) == 0, false, false};
  return {uniform(random, -6.0, 6.0), uniformIndex(random, 2) == 0, false, false};
}

const Footprint& randomFootprint(Random& random) {
  const std::size_t kind = uniformIndex(random, 3);
  return kind == 0 ? jackal() : kind == 1 ? waffle() : wedge();
}

constexpr double kStep = 1e-3;     // m or rad
constexpr double kLongest = 1.5;   // m or rad
constexpr double kPerStep = 4e-3;  // m: no point of these footprints moves farther in a step

TEST(FootprintSweep, EndsWhereSmallStepsMeetThePoint) {
  Random random(1);
  int met = 0;
  for (int i = 0; i < 4000; ++i) {
    const Footprint& footprint = randomFootprint(random);
    const Motion motion = randomMotion(random);
    const Point2 point{uniform(random, -1.2, 1.2), uniform(random, -1.2, 1.2)};
    const double distance = uniform(random, 0.0, 0.1);
    if (footprint.distanceTo(point) <= distance + 1e-6) continue;
    const double free = motion.sweepOf(footprint).freeBefore(point, distance, kLongest);
    for (double length = 0.0; length < free; length += kStep) {
      ASSERT_GT(footprint.distanceTo(toLocalFrame(motion.poseAfter(length), point)), distance - 1e-6)
          << i << ": " << length << " of " << free;
    }
    if (free >= kLongest) continue;
    ++met;
    EXPECT_NEAR(footprint.distanceTo(toLocalFrame(motion.poseAfter(free), point)), distance, 1e-6) << i;
  }
  EXPECT_GT(met, 200);
}

TEST(FootprintSweep, TheLeastDistanceIsThatOfSmallSteps) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Footprint& footprint = randomFootprint(random);
    const Motion motion = randomMotion(random);
    const Point2 point{uniform(random, -1.2, 1.2), uniform(random, -1.2, 1.2)};
    const double length = uniform(random, 0.0, kLongest);
    double least = footprint.distanceTo(point);
    for (double at = 0.0; at <= length; at += kStep) {
      least = std::min(least, footprint.distanceTo(toLocalFrame(motion.poseAfter(at), point)));
    }
    const double found = motion.sweepOf(footprint).leastDistance(point, length);
    EXPECT_LE(found, std::max(0.0, least) + 1e-9) << i;
    EXPECT_GE(found, std::max(0.0, least) - kPerStep) << i;
  }
}

TEST(FootprintSweep, KnowsWhetherAPointComesNearer) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Footprint& footprint = randomFootprint(random);
    const Motion motion = randomMotion(random);
    const Point2 point{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)};
    const double now = footprint.distanceTo(point);
    const double then = footprint.distanceTo(toLocalFrame(motion.poseAfter(1e-3), point));
    if (std::abs(then - now) < 1e-5) continue;  // it is passed
    EXPECT_EQ(motion.sweepOf(footprint).comesNearer(point), then < now) << i;
  }
}

TEST(FootprintSweep, ATurnInPlaceSweepsTheCorners) {
  // Of what is 0.3 m away from the middle, the end of the left side before the front corner meets the point first.
  const double free = FootprintSweep::turn(jackal(), true).freeBefore({0.0, 0.3}, 0.0, M_PI);
  EXPECT_NEAR(free, M_PI_2 - std::asin(0.215 / 0.3), 1e-9);
  const double reaches = std::hypot(0.254, 0.215);
  // Farther away than a corner reaches it turns for ever.
  EXPECT_EQ(FootprintSweep::turn(jackal(), true).freeBefore({0.0, reaches + 1e-3}, 0.0, 2.0 * M_PI), 2.0 * M_PI);
}

TEST(FootprintSweep, AWideArcIsNearlyAStraightLine) {
  for (const double y : {-0.2, 0.0, 0.1, 0.2149}) {
    const Point2 ahead{2.0, y};
    const double straight = FootprintSweep::straight(jackal(), false).freeBefore(ahead, 0.03, 5.0);
    EXPECT_NEAR(straight, 2.0 - 0.254 - 0.03, 1e-9);
    EXPECT_NEAR(FootprintSweep::arc(jackal(), 2e-5, false).freeBefore(ahead, 0.03, 5.0), straight, 1e-4);
  }
}

}  // namespace
}  // namespace lstm_planner::test_footprint_sweep
