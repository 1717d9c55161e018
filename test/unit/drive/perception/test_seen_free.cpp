#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "drive/perception/seen_free.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"
#include "unit/drive/perception/scan_builder.hpp"

namespace lstm_planner::test_seen_free {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr double kMargin = 0.05;

/// A round robot of 0.2 m; its scanner sees all around, a degree apart.
Situation seeing(float range) {
  Situation situation;
  perceive(makeScan(-M_PI, M_PI / 180.0, 360, range), {}, urgNodeRules(), 6.0, &situation);
  return situation;
}

double behind(const Situation& situation) { return seenFreeBehind(situation, Footprint(0.2), kMargin, 3.0); }

TEST(SeenFree, IsWhatLiesBeforeAReturnOrNothingWithinRange) {
  EXPECT_TRUE(isSeenFree(seeing(2.0f), {-1.9, 0.0}));
  EXPECT_FALSE(isSeenFree(seeing(2.0f), {-1.97, 0.0})) << "5 cm of air are needed behind it";
  EXPECT_TRUE(isSeenFree(seeing(kInf), {-10.0, 0.0}));
  EXPECT_FALSE(isSeenFree(seeing(kInf), {-61.0, 0.0})) << "beyond the scanner's range";
}

TEST(SeenFree, IsNotWhatASilentReadingMayHide) {
  EXPECT_FALSE(isSeenFree(seeing(std::numeric_limits<float>::quiet_NaN()), {-1.0, 0.0}));
  EXPECT_FALSE(isSeenFree(seeing(61.0f), {-1.0, 0.0})) << "a filter may have taken the beam out";
}

TEST(SeenFree, OneBeamThatIsLostBetweenTwoThatSeeDoesNotMatter) {
  Situation situation = seeing(2.0f);
  const long beam = situation.profile.beamTowards(M_PI_2);
  situation.profile.ranges[static_cast<std::size_t>(beam)] = RangeProfile::kSilent;
  EXPECT_TRUE(isSeenFree(situation, {0.0, 1.0}));
  situation.profile.ranges[static_cast<std::size_t>(beam) + 1] = 0.5f;
  EXPECT_FALSE(isSeenFree(situation, {0.0, 1.0})) << "something is beside it";
}

TEST(SeenFree, TheLastBeamIsBesideTheFirst) {
  Situation situation = seeing(2.0f);
  ASSERT_TRUE(isSeenFree(situation, {-1.0, 0.0}));
  situation.profile.ranges.back() = 0.5f;
  EXPECT_FALSE(isSeenFree(situation, {-1.0, 0.0})) << "straight behind, where the scan begins";
}

TEST(SeenFree, ARobotMayBackToWhatStandsBehindLessItsRadiusAndTheMargin) {
  EXPECT_DOUBLE_EQ(behind(seeing(kInf)), 3.0);
  // 5 cm of air, and places 5 cm apart.
  EXPECT_NEAR(behind(seeing(2.0f)), 2.0 - 0.2 - kMargin - 0.05, 0.06);
}

TEST(SeenFree, ARobotThatDoesNotSeeBehindDoesNotBack) {
  Situation situation;
  perceive(makeHokuyoScan(kInf), {}, {}, 6.0, &situation);
  EXPECT_EQ(behind(situation), 0.0) << "the 90 degrees behind are not seen";
  const LaserScan rear = makeHokuyoScan(kInf);
  const SensorMount mount{{-0.1, 0.0, M_PI}, false};
  perceiveSecond({rear, mount, {}, 0.0}, {}, &situation);
  EXPECT_DOUBLE_EQ(behind(situation), 3.0);
}

}  // namespace
}  // namespace lstm_planner::test_seen_free
