// The scans of a real robot (a SICK LMS in the Intel Research Lab, 360 m), at poses that a mapping program has
// corrected; the odometry is made of these poses, with an error.

#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "lstm_planner/dataset/carmen_log.hpp"
#include "lstm_planner/drive/perception/drift_correction.hpp"
#include "support/real_data.hpp"

namespace lstm_planner::test_drift_correction_on_log {
namespace {

TEST(DriftCorrectionOnLog, IsRightToAHundredthOfTheWay) {
  const std::string path = realData("logs/flirtlib_intel-lab.log.gz");
  SKIP_WITHOUT_REAL_DATA(path);
  const double wrong = 1.02;  // m a metre, and rad a radian
  DriftCorrection correction;
  Situation situation;
  Pose2 start, at, odometry;
  double time = 0.0;
  double length = 0.0;
  double odometry_error = 0.0;  // sums of squares
  double error = 0.0;
  long scans = 0;
  for (const DriveEvent& event : readCarmenLog(path).events) {
    if (const auto* heard = std::get_if<OdometryHeard>(&event)) {
      if (scans == 0) start = at = heard->pose;
      const Pose2 step = compose(inverse(at), heard->pose);
      odometry = compose(odometry, {wrong * step.x, wrong * step.y, wrong * step.yaw});
      length += distanceBetween(at, heard->pose);
      at = heard->pose;
      time += 0.2 + std::abs(step.yaw) / 0.3;  // the log has no stamps
    } else if (const auto* seen = std::get_if<ScanHeard>(&event)) {
      perceive(seen->scan, seen->mount, carmenLogRules(), 6.0, &situation);
      situation.pose = odometry;
      situation.time = time;
      correction.correct(&situation);
      ++scans;
      odometry_error += square(distanceBetween(compose(start, odometry), at));
      error += square(distanceBetween(compose(start, situation.pose), at));
    }
  }
  ASSERT_EQ(scans, 2672);
  const double all = static_cast<double>(scans);
  RecordProperty("odometry_error", std::to_string(std::sqrt(odometry_error / all)));
  RecordProperty("error", std::to_string(std::sqrt(error / all)));
  EXPECT_GT(std::sqrt(odometry_error / all), 0.02 * length) << "m, root mean square";
  EXPECT_LT(std::sqrt(error / all), 0.01 * length);
}

class DriftCorrectionOnLogs : public testing::TestWithParam<const char*> {};

/// In corridors two scans that are 0.3 m apart look much the same.
TEST_P(DriftCorrectionOnLogs, NeverTakesARobotThatDrivesForOneThatStands) {
  const std::string path = realData(GetParam());
  SKIP_WITHOUT_REAL_DATA(path);
  DriftCorrection correction;
  Situation situation;
  for (const DriveEvent& event : readCarmenLog(path).events) {
    if (const auto* heard = std::get_if<OdometryHeard>(&event)) {
      situation.pose = heard->pose;
    } else if (const auto* seen = std::get_if<ScanHeard>(&event)) {
      const Pose2 odometry = situation.pose;
      perceive(seen->scan, seen->mount, carmenLogRules(), 6.0, &situation);
      situation.pose = odometry;
      correction.correct(&situation);
      situation.pose = odometry;
      ASSERT_EQ(correction.slip().slipped(), 0.0) << "at (" << odometry.x << ", " << odometry.y << ")";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(RealData, DriftCorrectionOnLogs,
                         testing::Values("logs/flirtlib_intel-lab.log.gz", "logs/ple_aces-corrected.log.gz",
                                         "logs/ple_intel-corrected.log.gz"));

}  // namespace
}  // namespace lstm_planner::test_drift_correction_on_log
