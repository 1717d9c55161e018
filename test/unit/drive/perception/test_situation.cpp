#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lstm_planner/drive/perception/situation.hpp"
#include "unit/drive/perception/scan_builder.hpp"

namespace lstm_planner::test_situation {
namespace {

TEST(Perceive, FillsSectorsAndPointsFromOneScan) {
  Situation situation;
  perceive(makeHokuyoScan(2.0f), {}, {}, 6.0, &situation);
  EXPECT_EQ(situation.obstacles.size(), 1081u);
  for (int sector = 0; sector < kSectorCount; ++sector) {
    EXPECT_DOUBLE_EQ(situation.sectors.range[static_cast<std::size_t>(sector)], 2.0);
  }
}

TEST(Perceive, LeavesNanBeamsOutOfThePointsAndTheAverages) {
  LaserScan scan = makeHokuyoScan(2.0f);
  scan.ranges[560] = std::numeric_limits<float>::quiet_NaN();  // 5 degrees to the left: sector 4, one of its 90 beams
  Situation situation;
  perceive(scan, {}, {}, 6.0, &situation);
  ASSERT_EQ(situation.obstacles.size(), 1080u);
  for (const Point2& point : situation.obstacles) {
    EXPECT_NEAR(std::hypot(point.x, point.y), 2.0, 1e-6);
  }
  EXPECT_DOUBLE_EQ(situation.sectors.range[4], 2.0);
  EXPECT_DOUBLE_EQ(situation.sectors.range[3], 2.0);
}

TEST(Perceive, ForgetsWhatWasSeenBefore) {
  Situation situation;
  perceive(makeHokuyoScan(2.0f), {}, {}, 6.0, &situation);
  perceive(makeHokuyoScan(std::numeric_limits<float>::infinity()), {}, {}, 6.0, &situation);
  EXPECT_TRUE(situation.obstacles.empty());
  EXPECT_DOUBLE_EQ(situation.sectors.range[0], 6.0);
}

TEST(Perceive, RefusesAScannerThatDoesNotSeeAside) {
  Situation situation;
  EXPECT_THROW(perceive(makeScan(-0.5, 0.01, 100), {}, {}, 6.0, &situation), UnusableScan);
}

}  // namespace
}  // namespace lstm_planner::test_situation
