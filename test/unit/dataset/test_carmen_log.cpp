#include <Poco/DeflatingStream.h>
#include <gtest/gtest.h>

#include <iomanip>
#include <numeric>
#include <sstream>

#include "lstm_planner/dataset/carmen_log.hpp"
#include "support/real_data.hpp"
#include "support/refusal.hpp"
#include "support/scratch_folder.hpp"
#include "unit/dataset/step_list.hpp"

namespace lstm_planner::test_carmen_log {
namespace {

/// What all tests of this file write, each under the name that it gives.
const test::ScratchFolder& folder() {
  static const test::ScratchFolder folder;
  return folder;
}

std::string written(const std::string& name, const std::string& text) { return folder().write(name, text); }

std::string compressed(const std::string& text) {
  std::ostringstream bytes;
  Poco::DeflatingOutputStream stream(bytes, Poco::DeflatingStreamBuf::STREAM_GZIP);
  stream << text;
  stream.close();
  return bytes.str();
}

CarmenLog parsed(const std::string& text) { return readCarmenLog(written("log", text)); }

std::string refusalOf(const std::string& path) {
  return test::refusalOf<std::invalid_argument>([&] { readCarmenLog(path); });
}

std::string readings(int count, double range) {
  std::ostringstream text;
  for (int i = 0; i < count; ++i) text << " " << range;
  return text.str();
}

std::string frontLaser(double stamp, const std::string& laser, const std::string& robot, int count = 180,
                       double range = 3.0) {
  std::ostringstream text;
  text << std::setprecision(12) << "FLASER " << count << readings(count, range) << " " << laser << " " << robot << " "
       << stamp << " host " << stamp << "\n";
  return text.str();
}

std::string odometry(double stamp, double x) {
  std::ostringstream text;
  text << std::setprecision(12) << "ODOM " << x << " 0 0 0 0 0 " << stamp << " host " << stamp << "\n";
  return text.str();
}

template <typename Event>
std::vector<Event> all(const CarmenLog& log) {
  std::vector<Event> found;
  for (const DriveEvent& event : log.events) {
    if (const auto* one = std::get_if<Event>(&event)) found.push_back(*one);
  }
  return found;
}

TEST(CarmenLogTest, AScanHasTheRobotsPoseAtItsStamp) {
  const CarmenLog log = parsed("# comment\n" + odometry(10.0, 1.0) + frontLaser(10.5, "9 9 9", "1.2 0.1 -0.5"));
  EXPECT_EQ(log.scans, 1);
  EXPECT_EQ(log.odometry, 1);
  EXPECT_DOUBLE_EQ(log.duration, 0.5);
  EXPECT_EQ(log.scan_kind, "FLASER");
  const auto poses = all<OdometryHeard>(log);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_DOUBLE_EQ(poses[1].stamp, 10.5);
  EXPECT_DOUBLE_EQ(poses[1].pose.x, 1.2);
  EXPECT_DOUBLE_EQ(poses[1].pose.y, 0.1);
  EXPECT_DOUBLE_EQ(poses[1].pose.yaw, -0.5);
  EXPECT_NEAR(poses[1].twist.linear, 0.4, 1e-12);  // 0.2 m ahead in half a second
  EXPECT_NEAR(poses[1].twist.angular, -1.0, 1e-12);
  const auto scans = all<ScanHeard>(log);
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_DOUBLE_EQ(scans[0].stamp, 10.5);
  EXPECT_DOUBLE_EQ(scans[0].scan.stamp, 10.5);
}

TEST(CarmenLogTest, AnglesFollowFromTheNumberOfReadings) {
  struct Expected {
    int count;
    double first;      // degrees
    double increment;  // degrees
  };
  for (const Expected& expected : {Expected{180, -90.0, 1.0},
                                   {181, -90.0, 1.0},
                                   {360, -90.0, 0.5},
                                   {361, -90.0, 0.5},
                                   {400, -50.0, 0.25},
                                   {401, -50.0, 0.25},
                                   {91, -90.0, 2.0}}) {
    const CarmenLog log = parsed(frontLaser(1.0, "0 0 0", "0 0 0", expected.count));
    const LaserScan scan = all<ScanHeard>(log).at(0).scan;
    EXPECT_EQ(scan.ranges.size(), static_cast<std::size_t>(expected.count));
    EXPECT_NEAR(scan.angle_min, degreesToRadians(expected.first), 1e-12) << expected.count;
    EXPECT_NEAR(scan.angle_increment, degreesToRadians(expected.increment), 1e-12) << expected.count;
  }
}

bool isMeasured(const LaserScan& scan, std::size_t beam) {
  RangeProfile profile;
  toProfile(scan, {}, {}, &profile);
  return profile.isMeasured(beam);
}

TEST(CarmenLogTest, TheLargestReadingsMeanThatNothingCameBack) {
  for (const double range : {50.0, 81.83, 81.91}) {
    const CarmenLog log = parsed(frontLaser(1.0, "0 0 0", "0 0 0", 180, range));
    const LaserScan scan = all<ScanHeard>(log).at(0).scan;
    EXPECT_FALSE(isMeasured(scan, 0)) << range;
  }
  const CarmenLog log = parsed(frontLaser(1.0, "0 0 0", "0 0 0", 180, 49.99));
  const LaserScan scan = all<ScanHeard>(log).at(0).scan;
  EXPECT_TRUE(isMeasured(scan, 0));
}

/// The laser is 0.2 m ahead of and 0.1 m left of the robot, and looks 0.3 rad to the right.
const char* const kRobotLaser =
    "ROBOTLASER1 0 -1.5 3.0 0.75 30.0 0.1 0 5 1.0 2.0 30.0 29.5 0 2 7 8 "
    "4.9 3.2 1.2707963267949 5 3 1.5707963267949 0.5 0.1 0 0 0 976.5 host 7.5\n";

TEST(CarmenLogTest, RobotLaserSaysAnglesRangeAndMount) {
  const CarmenLog log = parsed(kRobotLaser);
  const auto scans = all<ScanHeard>(log);
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_DOUBLE_EQ(scans[0].stamp, 976.5);
  EXPECT_DOUBLE_EQ(scans[0].scan.angle_min, -1.5);
  EXPECT_DOUBLE_EQ(scans[0].scan.angle_increment, 0.75);
  EXPECT_EQ(scans[0].scan.ranges, (std::vector<float>{1.0f, 2.0f, 30.0f, 29.5f, 0.0f}));
  EXPECT_FALSE(isMeasured(scans[0].scan, 2));
  EXPECT_TRUE(isMeasured(scans[0].scan, 3));
  EXPECT_TRUE(log.mount_known);
  EXPECT_NEAR(scans[0].mount.pose.x, 0.2, 1e-9);
  EXPECT_NEAR(scans[0].mount.pose.y, 0.1, 1e-9);
  EXPECT_NEAR(scans[0].mount.pose.yaw, -0.3, 1e-9);
  EXPECT_DOUBLE_EQ(all<OdometryHeard>(log).at(0).pose.x, 5.0);
}

TEST(CarmenLogTest, RobotLaserMayCountItsReadingsInsteadOfSayingTheirAngle) {
  const auto increment = [](const std::string& resolution) {
    const std::string line =
        "ROBOTLASER1 0 -1.5 3.0 " + resolution + " 30.0 0.1 0 5 1 2 3 4 5 0 0 0 0 0 0 0 0.5 0.1 0 0 0 976.5 host 7.5\n";
    return all<ScanHeard>(parsed(line)).at(0).scan.angle_increment;
  };
  EXPECT_DOUBLE_EQ(increment("0.75"), 0.75);
  EXPECT_DOUBLE_EQ(increment("4.0"), 0.75) << "4 angles between 5 readings share 3 rad";
  EXPECT_DOUBLE_EQ(increment("5"), 0.75) << "5 readings, one at each end";
  EXPECT_DOUBLE_EQ(increment("17"), 17.0) << "no count of these readings: the scan is refused, with this number";
}

TEST(CarmenLogTest, TheMountIsWhatIsGivenOrElseWhatTheLogSays) {
  const std::string scan = frontLaser(1.0, "0 0 0", "0 0 0");
  const std::string offset = "PARAM robot_frontlaser_offset 0.21 nohost 0\n";
  EXPECT_FALSE(parsed(scan).mount_known);
  EXPECT_DOUBLE_EQ(all<ScanHeard>(parsed(scan)).at(0).mount.pose.x, 0.0);
  EXPECT_TRUE(parsed(offset + scan).mount_known);
  EXPECT_DOUBLE_EQ(all<ScanHeard>(parsed(offset + scan)).at(0).mount.pose.x, 0.21);
  const SensorMount given{{-0.1, 0.0, 0.5}, false};
  const CarmenLog log = readCarmenLog(written("log", offset + scan), given);
  EXPECT_DOUBLE_EQ(all<ScanHeard>(log).at(0).mount.pose.x, -0.1);
}

TEST(CarmenLogTest, LateStampsBecomeThoseInBetween) {
  // Of the Intel lab's log: one line was stamped 0.78 s late.
  const CarmenLog log = parsed(odometry(25.3466, 0.0) + odometry(25.5466, 0.1) + odometry(26.5081, 0.2) +
                               odometry(25.9068, 0.3) + frontLaser(26.1077, "0.4 0 0", "0.4 0 0"));
  EXPECT_EQ(log.late, 1);
  const auto poses = all<OdometryHeard>(log);
  EXPECT_NEAR(poses.at(2).stamp, 0.5 * (25.5466 + 25.9068), 1e-9);
  EXPECT_DOUBLE_EQ(poses.at(2).pose.x, 0.2);
  EXPECT_DOUBLE_EQ(poses.at(3).stamp, 25.9068);
}

TEST(CarmenLogTest, StampsAscendUnlessTheClockWasSet) {
  const CarmenLog log = parsed(odometry(300.4, 0.0) + odometry(300.0, 0.1) + odometry(300.0, 0.2) +
                               frontLaser(300.0, "0.3 0 0", "0.3 0 0") + odometry(101.0, 0.4) + odometry(100.5, 0.5) +
                               frontLaser(103.0, "0.6 0 0", "0.6 0 0"));
  const auto poses = all<OdometryHeard>(log);
  ASSERT_EQ(poses.size(), 7u);
  int descents = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_NE(poses[i].stamp, poses[i - 1].stamp);
    if (poses[i].stamp < poses[i - 1].stamp) {
      ++descents;
      EXPECT_NEAR(poses[i].stamp, 100.5, 0.01);
    }
  }
  EXPECT_EQ(descents, 1);
  EXPECT_EQ(log.late, 2);
}

TEST(CarmenLogTest, ScansThatAreStampedNoLaterThanTheScanBeforeAreCounted) {
  std::string text;
  for (const double stamp : {300.0, 300.0, 299.0, 300.0}) {
    text += frontLaser(stamp, "0 0 0", "0 0 0") + odometry(stamp + 1.0, 0.1);
  }
  EXPECT_EQ(parsed(text).standing, 2) << "one is stamped as the scan before it, one earlier; ODOM lines do not count";
}

TEST(CarmenLogTest, OdometryThatRepeatsThePoseOfTheScanBeforeIsLeftOut) {
  const std::string scan = frontLaser(1.0, "0.5 0 0", "0.5 0 0");
  const CarmenLog log = parsed(scan + odometry(0.0, 0.5) + odometry(1.2, 0.6) + odometry(1.4, 0.6));
  EXPECT_EQ(log.repeated, 1);
  EXPECT_EQ(log.odometry, 2);
  EXPECT_EQ(log.late, 0);
}

TEST(CarmenLogTest, LinesThatAreNotUsedAreCounted) {
  const std::string scan = frontLaser(1.0, "0 0 0", "0 0 0");
  const CarmenLog log = parsed("# a\n# b\n\nNEFF 30\nRLASER 1 2\nSYNC x\n" + scan + kRobotLaser + "\x01\x02 3\n");
  EXPECT_EQ(log.ignored, (std::map<std::string, long>{
                             {"#", 2}, {"?", 1}, {"NEFF", 1}, {"RLASER", 1}, {"ROBOTLASER1", 1}, {"SYNC", 1}}));
  EXPECT_EQ(log.scans, 1);
  EXPECT_EQ(log.malformed, 0);
}

TEST(CarmenLogTest, MalformedLinesAreLeftOutAndTheFirstIsNamed) {
  const std::string scan = frontLaser(1.0, "0 0 0", "0 0 0");
  const std::string cut_off = scan.substr(0, 100) + "\n";
  struct Expected {
    std::string line;
    std::string reason;
  };
  for (const Expected& expected :
       {Expected{cut_off, "FLASER has no number where a reading should be"},
        {"ODOM 1 2 nan 0 0 0 5 host 5\n", "ODOM has no number where the pose should be"},
        {"ODOM 1 2 3\n", "ODOM has no number where speed and acceleration should be"},
        {"FLASER 1e9 1 1\n", "FLASER has a number of readings of 1e+09, expected 2 to 10000"},
        {"FLASER 2.5 1 1\n", "FLASER has a number of readings of 2.5, expected 2 to 10000"},
        {"PARAM robot_frontlaser_offset inf\n", "PARAM robot_frontlaser_offset is no number"},
        {"PARAM robot_frontlaser_offset front\n", "PARAM robot_frontlaser_offset is no number"}}) {
    const CarmenLog log = parsed(scan + expected.line + odometry(2.0, 0.1) + expected.line);
    EXPECT_EQ(log.malformed, 2) << expected.line;
    EXPECT_EQ(log.first_malformed, "line 2: " + expected.reason);
    EXPECT_EQ(log.scans + log.odometry, 2);
  }
}

TEST(CarmenLogTest, CompressedLogsAreTheSame) {
  std::string text;
  for (int i = 1; i <= 500; ++i) text += frontLaser(i, std::to_string(i) + " 0 0", std::to_string(i) + " 0 0");
  const CarmenLog plain = readCarmenLog(written("plain.log", text));
  const CarmenLog log = readCarmenLog(written("packed.log.gz", compressed(text)));
  EXPECT_EQ(log.scans, 500);
  ASSERT_EQ(log.events.size(), plain.events.size());
  EXPECT_EQ(all<ScanHeard>(log).back().scan.ranges, all<ScanHeard>(plain).back().scan.ranges);
  EXPECT_DOUBLE_EQ(stampOf(log.events.back()), stampOf(plain.events.back()));
}

TEST(CarmenLogTest, CompressedLogsOneBehindTheOtherAreOne) {
  const std::string first = frontLaser(1.0, "0 0 0", "0 0 0");
  const std::string second = compressed(frontLaser(2.0, "0 0 0", "0.1 0 0") + odometry(3.0, 0.2));
  const CarmenLog log = readCarmenLog(written("joined.log.gz", compressed(first) + second));
  EXPECT_EQ(log.scans, 2);
  EXPECT_EQ(log.odometry, 1);
  const std::string cut = written("cut_joined.log.gz", compressed(first) + second.substr(0, second.size() / 2));
  EXPECT_NE(refusalOf(cut).find("cannot be read on behind line 1"), std::string::npos) << refusalOf(cut);
}

TEST(CarmenLogTest, WhatIsNoLogIsRefusedInASentence) {
  EXPECT_EQ(refusalOf(folder() / ("none")),
            "the log " + folder() / ("none") + " cannot be read: there is no such file");
  const std::string none = written("without_scans.log", odometry(1.0, 0.0) + "NEFF 3\n");
  EXPECT_EQ(refusalOf(none),
            "the log " + none + " holds no scans: expected lines FLASER or ROBOTLASER1 among its 2 lines");
  const std::string malformed = written("malformed.log", "FLASER x\n");
  EXPECT_EQ(refusalOf(malformed),
            "the log " + malformed +
                " holds no scans: expected lines FLASER or ROBOTLASER1 as CARMEN writes them, but "
                "line 1: FLASER has no number where a number of readings should be");
  const std::string long_line = written("long_line.log", std::string(2 << 20, 'x'));
  EXPECT_EQ(refusalOf(long_line),
            "the log " + long_line + " cannot be read on behind line 0: it is damaged, or no log");
  const std::string empty = written("empty.log", "");
  EXPECT_EQ(refusalOf(empty),
            "the log " + empty + " holds no scans: expected lines FLASER or ROBOTLASER1 among its 0 lines");
  EXPECT_EQ(refusalOf(folder().path()),
            "the log " + folder().path().string() + " cannot be read: it is a folder, expected a file");
}

TEST(CarmenLogTest, FilesOfGMappingNameTheProgramThatConvertsThem) {
  const std::string file =
      written("map.gfs", "ODOM 576.537 0.107 -2.255213 1134864629.895182\nLASER_READING 2 1.0 1.0 0 0 0 5\n");
  EXPECT_EQ(refusalOf(file),
            "the log " + file +
                " holds no scans: expected lines FLASER or ROBOTLASER1 as CARMEN writes them, but it has 1 lines "
                "LASER_READING: it is a file of GMapping, whose program gfs2log converts it to a CARMEN log");
}

TEST(CarmenLogTest, ShortLogsThatBecomeLongAreRefused) {
  std::string text;
  for (int i = 0; i < 257; ++i) text += '#' + std::string((1 << 20) - 2, ' ') + '\n';
  const std::string large = written("large.log.gz", compressed(text));
  EXPECT_NE(refusalOf(large).find("is too long: expected at most 268435456 bytes"), std::string::npos)
      << refusalOf(large);
  text.clear();
  for (int i = 0; i < 1000001; ++i) text += "ODOM 0 0 0 0 0 0 " + std::to_string(i) + "\n";
  const std::string many = written("many.log.gz", compressed(text));
  EXPECT_NE(refusalOf(many).find("and 1000000 scans and lines ODOM"), std::string::npos) << refusalOf(many);
}

TEST(CarmenLogTest, CountsABoundedNumberOfKeywords) {
  std::string text = frontLaser(1.0, "0 0 0", "0 0 0");
  for (int i = 0; i < 5000; ++i) text += "WORD" + std::to_string(i) + " 1\n";
  const CarmenLog log = readCarmenLog(written("words.log", text));
  EXPECT_LE(log.ignored.size(), 101u);
  long lines = 0;
  for (const auto& [kind, count] : log.ignored) lines += count;
  EXPECT_EQ(lines, 5000);
}

TEST(CarmenLogTest, DamagedCompressedLogsAreRefused) {
  std::string text;
  for (int i = 0; i < 2000; ++i) text += odometry(i, 0.01 * i * (i % 7));
  const std::string bytes = compressed(frontLaser(0.5, "0 0 0", "0 0 0") + text);
  const std::string cut = written("cut.log.gz", bytes.substr(0, bytes.size() / 2));
  EXPECT_NE(refusalOf(cut).find("cannot be read on behind line"), std::string::npos) << refusalOf(cut);
  std::string broken = bytes;
  for (std::size_t i = broken.size() / 2; i < broken.size() / 2 + 40; ++i) broken[i] = '\xff';
  const std::string damaged = written("damaged.log.gz", broken);
  EXPECT_NE(refusalOf(damaged).find("cannot be read on behind line"), std::string::npos) << refusalOf(damaged);
}

/// A robot that drives 6 m at 0.5 m/s, 12 m of corridor before it, and stands; ODOM at 10 Hz and FLASER at 2 Hz.
std::string corridorLog() {
  std::ostringstream text;
  for (int i = 0; i <= 180; ++i) {
    const double stamp = 50.0 + 0.1 * i;
    const double x = std::min(6.0, 0.05 * i);
    text << odometry(stamp, x);
    const std::string pose = std::to_string(x) + " 0 0";
    if (i % 5 == 0) text << frontLaser(stamp + 0.05, pose, pose);
  }
  return text.str();
}

TEST(CarmenLogTest, RecordedLogsDriveToWhereTheRobotStopped) {
  StepList list;
  recordCarmenLog(parsed(corridorLog()), {}, {}, &list);
  ASSERT_EQ(list.episodes().size(), 1u);
  const RecordedEpisode& drive = list.episodes()[0];
  EXPECT_EQ(drive.episode.end, EpisodeEnd::kArrived);
  EXPECT_NEAR(drive.episode.goal.pose.x, 6.0, 1e-9);
  // A scan every 0.25 m up to 0.3 m before the goal: those at 0, 0.25, ... 5.5 m start steps. The last has no next.
  EXPECT_EQ(drive.steps.size(), 22u);
  for (const DriveStep& step : drive.steps) {
    EXPECT_EQ(step.label, 2);  // straight ahead of -90, -45, 0, 45, 90 degrees
    EXPECT_NEAR(step.next_pose.x - step.pose.x, 0.25, 1e-9);
    EXPECT_NEAR(step.observation.goal_distance, 6.0 - step.pose.x, 1e-9);
    EXPECT_NEAR(step.observation.goal_bearing, 0.0, 1e-9);
    EXPECT_EQ(step.geometry.beams, 180);
  }
}

struct RealLog {
  const char* file;
  long scans;     // lines of this kind, as grep counts them
  long odometry;  // lines ODOM less one behind each FLASER that repeats its pose
};

class RealCarmenLogTest : public testing::TestWithParam<RealLog> {};

TEST_P(RealCarmenLogTest, EveryScanIsAccountedForAndStepsBeginAtTheirPoses) {
  const std::string path = realData(std::string("logs/") + GetParam().file);
  SKIP_WITHOUT_REAL_DATA(path);
  const CarmenLog log = readCarmenLog(path);
  EXPECT_EQ(log.scans, GetParam().scans);
  EXPECT_EQ(log.odometry, GetParam().odometry);
  EXPECT_EQ(log.malformed, 0) << log.first_malformed;

  RecorderParameters parameters;
  parameters.period = 1e-4;   // every scan is a look: no two are nearer to each other
  parameters.max_gap = 40.0;  // the longest pause between scans of these logs, while the odometry goes on: 38 s
  parameters.scan_rules = carmenLogRules();
  StepList list;
  recordCarmenLog(log, {}, parameters, &list);
  long steps = 0;
  std::map<double, Pose2> poses;
  for (const OdometryHeard& heard : all<OdometryHeard>(log)) poses[heard.stamp] = heard.pose;
  for (const RecordedEpisode& drive : list.episodes()) {
    EXPECT_EQ(drive.episode.end, EpisodeEnd::kArrived) << "a place that the robot came to";
    steps += static_cast<long>(drive.steps.size());
    for (const DriveStep& step : drive.steps) {
      ASSERT_LT(distanceBetween(step.pose, poses.at(step.stamp)), 1e-9);
      ASSERT_NEAR(normalizeAngle(step.pose.yaw - poses.at(step.stamp).yaw), 0.0, 1e-9);
    }
  }
  EXPECT_EQ(steps + std::accumulate(list.rejections().begin(), list.rejections().end(), 0L), log.scans)
      << "the odometry at a scan's stamp is worked on before it: it never arrives by a scan";
  EXPECT_EQ(list.rejected(Rejection::kNoOdometry), 0) << "each scan carries its pose";
  EXPECT_EQ(list.rejected(Rejection::kLate), 0) << "the stamps ascend";
  EXPECT_EQ(list.rejected(Rejection::kUnusableScan), 0);
}

std::string nameOf(const testing::TestParamInfo<RealLog>& info) {
  std::string name;
  for (const char c : std::string(info.param.file)) name += std::isalnum(c) ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Logs, RealCarmenLogTest,
                         testing::Values(RealLog{"flirtlib_intel-lab.log.gz", 2672, 0},
                                         RealLog{"ple_aces-corrected.log.gz", 440, 7374},
                                         RealLog{"ple_intel-corrected.log.gz", 910, 13631}),
                         nameOf);

}  // namespace
}  // namespace lstm_planner::test_carmen_log
