#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "lstm_planner/drive/perception/scanner_watch.hpp"
#include "support/refusal.hpp"
#include "unit/drive/perception/scan_builder.hpp"

namespace lstm_planner::test_scanner_watch {
namespace {

class ScannerWatchTest : public ::testing::Test {
 protected:
  void hear(double time, float range = 2.0f) { watch_.hear(makeHokuyoScan(range), urgNodeRules(), time, time, {}); }
  std::string refusal(double now) const {
    return test::refusalOf<SensorError>([&] { watch_.check(now); });
  }
  ScannerWatch watch_{"/rear/scan", 0.0, 0.2};
};

TEST_F(ScannerWatchTest, OneThatIsSilentIsNamed) {
  EXPECT_EQ(refusal(100.0), "no scan has been received on /rear/scan");
}

TEST_F(ScannerWatchTest, OneThatFallsSilentIsNamedAfterThreeOfItsOwnPeriods) {
  for (int i = 0; i <= 8; ++i) hear(100.0 + 0.1 * i);
  EXPECT_NEAR(watch_.timeout(), 0.3, 1e-6);
  EXPECT_NO_THROW(watch_.check(101.05));
  const std::string said = refusal(101.15);
  EXPECT_EQ(said.rfind("the newest message on /rear/scan is 0.35", 0), 0u) << said;
  EXPECT_NE(said.find("allowed are scan_timeout = 0.3"), std::string::npos) << said;
}

TEST_F(ScannerWatchTest, OneThatIsCoveredIsNamed) {
  hear(100.0);
  hear(100.1, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(refusal(100.1).rfind("the scanner counts as covered: on /rear/scan no beam", 0), 0u) << refusal(100.1);
}

}  // namespace
}  // namespace lstm_planner::test_scanner_watch
