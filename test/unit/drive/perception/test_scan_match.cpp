#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lstm_planner/drive/perception/scan_match.hpp"
#include "unit/drive/perception/room_scans.hpp"

namespace lstm_planner::test_scan_match {
namespace {

const PoseError kError{0.05, 0.05};

KeyScan keyScan(const World& world, const Pose2& pose, std::uint64_t seed = 1) {
  KeyScan key{pose, {}};
  key.surfaces.show(test::RoomScanner(world, seed).seenFrom(pose).profile);
  return key;
}

ScanMatch match(const World& world, const KeyScan& key, const Pose2& from, const Pose2& predicted,
                const PoseError& error = kError, std::uint64_t seed = 2) {
  std::vector<SurfacePiece> pieces;
  ScanSurfaces surfaces;
  surfaces.show(test::RoomScanner(world, seed).seenFrom(from).profile);
  surfaces.sample(0.08, 200, &pieces);
  return matchScan(pieces, {&key}, predicted, error);
}

const GridWorld kRoom = test::room(6.0, 4.0, {{{4.0, 0.0}, {5.0, 1.0}}});
const Pose2 kKey{3.0, 2.0, 0.3};
const Pose2 kTrue{3.3, 2.2, 0.5};

TEST(ScanMatch, FindsThePoseFromAPredictionThatIsWrong) {
  const ScanMatch found = match(kRoom, keyScan(kRoom, kKey), kTrue, {3.36, 2.13, 0.56});
  EXPECT_TRUE(found.is_sure);
  EXPECT_GT(found.share, 0.8);
  // 0.03 m of 150 pieces, which is more than their noise: 0.0025 m, and that over 2 m: 0.0012 rad. Four times that.
  EXPECT_LT(distanceBetween(found.pose, kTrue), 0.01);
  EXPECT_NEAR(found.pose.yaw, kTrue.yaw, 0.005);
}

TEST(ScanMatch, LeansToNeitherSide) {
  const int trials = 200;
  double sum = 0.0;
  double squares = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    const double wrong =
        match(kRoom, keyScan(kRoom, kKey, 1000 + trial), kTrue, kTrue, kError, trial + 1).pose.yaw - kTrue.yaw;
    sum += wrong;
    squares += wrong * wrong;
  }
  const double mean = sum / trials;
  const double deviation = std::sqrt(squares / trials - mean * mean);
  EXPECT_LT(std::abs(mean), 4.0 * deviation / std::sqrt(trials)) << "rad: adds up from match to match";
}

TEST(ScanMatch, BelievesThePredictionAlongACorridor) {
  const GridWorld corridor = test::room(80.0, 1.6);
  const Pose2 from{40.3, 0.8, 0.0};
  const Pose2 predicted{40.36, 0.83, 0.03};
  const ScanMatch found = match(corridor, keyScan(corridor, {40.0, 0.8, 0.0}), from, predicted);
  EXPECT_TRUE(found.is_sure);
  EXPECT_NEAR(found.pose.y, from.y, 0.01);
  EXPECT_NEAR(found.pose.yaw, from.yaw, 0.005);
  EXPECT_NEAR(found.pose.x, predicted.x, 0.01) << "the walls say nothing of it";
}

TEST(ScanMatch, DoesNotMindPeopleWhoWalkAbout) {
  const CircleWorld before({{{4.0, 2.5}, 0.25}, {{2.0, 3.0}, 0.25}, {{3.5, 1.2}, 0.25}}, &kRoom);
  const CircleWorld now({{{4.2, 2.8}, 0.25}, {{1.8, 2.8}, 0.25}, {{3.8, 1.2}, 0.25}}, &kRoom);
  const ScanMatch found = match(now, keyScan(before, kKey), kTrue, {3.34, 2.16, 0.53});
  EXPECT_TRUE(found.is_sure);
  EXPECT_LT(distanceBetween(found.pose, kTrue), 0.015);
  EXPECT_NEAR(found.pose.yaw, kTrue.yaw, 0.01);
}

TEST(ScanMatch, IsNotSureWhereThereIsNothing) {
  const CircleWorld poles({{{8.0, 2.0}, 0.03}, {{3.0, 7.0}, 0.03}});
  EXPECT_FALSE(match(poles, keyScan(poles, kKey), kTrue, kTrue).is_sure);
  EXPECT_FALSE(matchScan({}, {}, kTrue, kError).is_sure);
}

TEST(ScanMatch, IsNotSureInAnotherRoom) {
  const GridWorld other = test::room(12.0, 9.0);
  EXPECT_FALSE(match(other, keyScan(kRoom, kKey), {6.0, 4.0, 0.5}, kTrue).is_sure);
}

TEST(ScanMatch, IsNotSureWhenItIsFartherOffThanOdometryCanBe) {
  const PoseError small{0.005, 0.005};
  EXPECT_FALSE(match(kRoom, keyScan(kRoom, kKey), kTrue, {3.4, 2.2, 0.5}, small).is_sure) << "0.1 m: 20 deviations";
  EXPECT_TRUE(match(kRoom, keyScan(kRoom, kKey), kTrue, {3.31, 2.2, 0.5}, small).is_sure) << "0.01 m: two";
}

}  // namespace
}  // namespace lstm_planner::test_scan_match
