#include <actionlib_msgs/GoalID.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <ostream>

#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/ros/recorder/bag_drive.hpp"
#include "ros/fixtures/drive_bag.hpp"
#include "ros/fixtures/ros_program.hpp"
#include "support/real_data.hpp"
#include "support/scratch_folder.hpp"
#include "support/shell.hpp"

namespace lstm_planner::recorded_bags {
namespace {

std::string pathOf(const std::string& name) {
  static const test::ScratchFolder folder;
  return folder / name;
}

std::string written(const std::string& name, const DriveBagContent& content = {}) {
  DriveBag::write(pathOf(name), content);
  return pathOf(name);
}

struct Outcome {
  BagDriveResult result;
  Recording recording;

  long rejected(Rejection rejection) const { return recording.rejections[static_cast<std::size_t>(rejection)]; }
  long steps() const {
    Dataset dataset;
    dataset.recordings = {recording};
    return stepCount(dataset);
  }
};

Outcome recordedParts(const BagParts& parts, const BagDriveOptions& options = {},
                      const RecorderParameters& parameters = {}) {
  RecordingSink sink({});
  Outcome outcome;
  outcome.result = recordBags(parts, options, parameters, &sink);
  outcome.recording = std::move(sink.recording());
  return outcome;
}

Outcome recorded(const std::string& path, const BagDriveOptions& options = {},
                 const RecorderParameters& parameters = {}) {
  return recordedParts({path}, options, parameters);
}

std::string refusalOf(const std::string& path, const BagDriveOptions& options = {}) {
  RecordingSink sink({});
  try {
    recordBags({path}, options, {}, &sink);
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(sink.recording().episodes.empty());
    const std::string named = "the bag " + path + ": ";
    EXPECT_EQ(std::string(error.what()).find(named), 0u) << error.what();
    return std::string(error.what()).substr(named.size());
  }
  return "";
}

std::string bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void writeBytes(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

/// The poses of a bag's odometry, and the one at a time between two of them.
class BagOdometry {
 public:
  explicit BagOdometry(const std::string& path, const std::string& topic) {
    rosbag::Bag bag(path);
    rosbag::View view(bag, rosbag::TopicQuery(topic));
    for (const rosbag::MessageInstance& message : view) {
      const auto odometry = message.instantiate<nav_msgs::Odometry>();
      poses_[odometry->header.stamp.toSec()] = fromMessage(odometry->pose.pose);
    }
  }

  Pose2 at(double stamp) const {
    const auto after = poses_.lower_bound(stamp);
    if (after->first == stamp) return after->second;
    const auto before = std::prev(after);
    const double share = (stamp - before->first) / (after->first - before->first);
    const Pose2& a = before->second;
    const Pose2& b = after->second;
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.yaw + share * normalizeAngle(b.yaw - a.yaw)};
  }

 private:
  std::map<double, Pose2> poses_;
};

void expectPosesOf(const Recording& recording, const BagOdometry& odometry) {
  for (const RecordedEpisode& drive : recording.episodes) {
    for (const DriveStep& step : drive.steps) {
      const Pose2 expected = odometry.at(step.stamp);
      ASSERT_LT(distanceBetween(step.pose, expected), 1e-9) << "at " << step.stamp;
      ASSERT_NEAR(normalizeAngle(step.pose.yaw - expected.yaw), 0.0, 1e-9);
    }
  }
}

TEST(RecordedBagTest, GoalsAndTheirEndsAreThoseOfTheBag) {
  const std::string path = written("goals.bag");
  const Outcome outcome = recorded(path);
  EXPECT_EQ(outcome.result.scan_topic, "/scan");
  EXPECT_EQ(outcome.result.odometry_source, "/odom");
  EXPECT_EQ(outcome.result.odometry_frame, "odom");
  EXPECT_EQ(outcome.result.base_frame, "base_footprint");
  EXPECT_EQ(outcome.result.goals, 6);    // one of the five was passed on
  EXPECT_EQ(outcome.result.scans, 320);  // 32 s at 10 Hz
  EXPECT_EQ(outcome.result.odometry, 320);
  EXPECT_NEAR(outcome.result.start, DriveBag::kStart, 0.2);
  EXPECT_NEAR(outcome.result.duration, 32.0, 0.2);

  const auto& episodes = outcome.recording.episodes;
  ASSERT_EQ(episodes.size(), 5u);
  const EpisodeEnd ends[] = {EpisodeEnd::kArrived, EpisodeEnd::kArrived, EpisodeEnd::kAborted, EpisodeEnd::kAborted,
                             EpisodeEnd::kFinished};
  const char* const sources[] = {"move_base_simple/goal", "move_base/goal", "move_base_simple/goal", "move_base/goal",
                                 "move_base_simple/goal"};
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    EXPECT_EQ(episodes[i].episode.end, ends[i]) << i;
    EXPECT_EQ(episodes[i].episode.goal_source, sources[i]) << i;
  }
  EXPECT_NEAR(episodes[2].episode.ended, DriveBag::kStart + 27.0, 0.1);
  EXPECT_NEAR(episodes[3].episode.ended, DriveBag::kStart + 30.0, 0.1);
  EXPECT_EQ(episodes[0].steps.front().geometry.mount.pose.x, DriveBag::kMount);
  expectPosesOf(outcome.recording, BagOdometry(path, "/odom"));
}

TEST(RecordedBagTest, EveryLookIsAStepOrHasAReason) {
  RecorderParameters parameters;
  parameters.period = 0.05;  // every scan is a look
  const Outcome outcome = recorded(written("looks.bag"), {}, parameters);
  const RejectionCounts& rejections = outcome.recording.rejections;
  EXPECT_EQ(outcome.rejected(Rejection::kLate), 0);  // none comes 0.3 s late
  const long counted = outcome.steps() + std::accumulate(rejections.begin(), rejections.end(), 0L);
  // Arriving takes a look that is neither, unless odometry tells of it before.
  EXPECT_LE(counted, outcome.result.scans);
  EXPECT_GE(counted, outcome.result.scans - 2);
}

TEST(RecordedBagTest, TransformsAreOdometryWhereThereIsNoOther) {
  const std::string path = written("both.bag");
  DriveBagContent content;
  content.odometry = false;
  BagDriveOptions options;
  options.base_frame = "base_footprint";
  for (const bool is_old : {false, true}) {
    content.old_transforms = is_old;
    const Outcome outcome = recorded(written("transforms.bag", content), options);
    EXPECT_EQ(outcome.result.odometry_source, "tf");
    EXPECT_EQ(outcome.result.odometry, 320);
    EXPECT_EQ(outcome.steps(), recorded(path).steps());
    expectPosesOf(outcome.recording, BagOdometry(path, "/odom"));
    const DriveStep& step = outcome.recording.episodes[1].steps.at(8);
    EXPECT_NEAR(step.twist.linear, 0.4, 1e-6);  // as it was driven there
    EXPECT_NEAR(step.twist.angular, 0.0, 1e-6);
  }
}

TEST(RecordedBagTest, TransformsLeadToTheBaseAlsoInMessagesOfTheirOwn) {
  DriveBagContent content;
  content.odometry = false;
  content.base_link = true;
  const Outcome outcome = recorded(written("base_link.bag", content));
  EXPECT_GE(outcome.result.odometry, 310);  // of 320: one is lost where the next one comes before the base's
  EXPECT_NEAR(outcome.steps(), recorded(written("both.bag")).steps(), 2);
}

TEST(RecordedBagTest, TransformsAreThoseOfTheClockThatWasSetBack) {
  BagDriveOptions options;
  options.base_frame = "base_footprint";
  DriveBagContent content;
  for (const double set_back : {5.0, 60.0}) {
    content.set_back = set_back;
    content.odometry = true;
    const Outcome expected = recorded(written("set_back.bag", content), options);
    content.odometry = false;
    const Outcome outcome = recorded(written("set_back_transforms.bag", content), options);
    EXPECT_EQ(outcome.result.odometry, 320);
    ASSERT_EQ(outcome.recording.episodes.size(), expected.recording.episodes.size()) << set_back;
    for (std::size_t i = 0; i < expected.recording.episodes.size(); ++i) {
      const RecordedEpisode& drive = outcome.recording.episodes[i];
      const RecordedEpisode& other = expected.recording.episodes[i];
      EXPECT_EQ(drive.episode.end, other.episode.end) << set_back << ", " << i;
      ASSERT_EQ(drive.steps.size(), other.steps.size()) << set_back << ", " << i;
      for (std::size_t k = 0; k < drive.steps.size(); ++k) {
        EXPECT_LT(distanceBetween(drive.steps[k].pose, other.steps[k].pose), 1e-9);
      }
    }
  }
}

TEST(RecordedBagTest, TopicsMayLackTheSlashInFront) {
  DriveBagContent content;
  content.root = "";
  const std::string path = written("no_slash.bag", content);
  const Outcome outcome = recorded(path);
  EXPECT_EQ(outcome.result.scan_topic, "scan");
  EXPECT_EQ(outcome.result.goals, 6);
  EXPECT_EQ(outcome.steps(), recorded(written("slash.bag")).steps());
  BagDriveOptions options;
  options.scan_topic = "/scan";
  EXPECT_EQ(recorded(path, options).result.scans, 320);
}

TEST(RecordedBagTest, ARobotsTransformsAndGoalsAreThoseOfTheScansNamespace) {
  DriveBagContent content;
  content.root = "/robot1/";
  const std::string path = written("namespace.bag", content);
  tf2_msgs::TFMessage elsewhere;
  elsewhere.transforms = {toMessage({5.0, 5.0, 0.0}, "base_footprint", "base_scan", ros::Time(DriveBag::kStart))};
  {
    rosbag::Bag bag(path, rosbag::bagmode::Append);
    bag.write("/tf_static", ros::Time(DriveBag::kStart), elsewhere);
    bag.write("/move_base/cancel", ros::Time(DriveBag::kStart + 5.0), actionlib_msgs::GoalID());
  }
  const Outcome outcome = recorded(path);
  EXPECT_EQ(outcome.result.goals, 6);
  const Outcome without = recorded(written("no_namespace.bag"));
  EXPECT_EQ(outcome.steps(), without.steps());
  ASSERT_EQ(outcome.recording.episodes.size(), without.recording.episodes.size());
  EXPECT_EQ(outcome.recording.episodes[0].steps.at(0).geometry.mount.pose.x, DriveBag::kMount);
}

TEST(RecordedBagTest, TheMountIsTheTransformsOrTheGivenOneAndNeverGuessed) {
  DriveBagContent content;
  content.mount = false;
  const std::string path = written("mount.bag", content);
  BagDriveOptions options;
  for (const bool hindsight : {false, true}) {
    options.hindsight = hindsight;
    EXPECT_EQ(refusalOf(path, options),
              "has no transform from base_footprint to the scanner's frame base_scan: expected it on /tf_static or "
              "/tf, in this "
              "part or, if the recording was split, in one that is given with it, or the scanner's pose as --mount");
  }
  options = {};
  options.mount = SensorMount{{-0.3, 0.1, 0.0}, false};
  const Outcome given = recorded(path, options);
  EXPECT_EQ(given.recording.episodes.at(0).steps.at(0).geometry.mount.pose.x, -0.3);
  EXPECT_EQ(given.rejected(Rejection::kNoTransform), 0);
}

TEST(RecordedBagTest, ARobotFrameThatIsNotInTheTransformsIsReplaced) {
  DriveBagContent content;
  content.robot_frame = "base";
  const std::string path = written("robot_frame.bag", content);
  BagDriveOptions options;
  options.base_frame = "base_footprint";
  const Outcome outcome = recorded(path, options);
  EXPECT_EQ(outcome.result.base_frame, "base_footprint");
  EXPECT_DOUBLE_EQ(outcome.recording.episodes.at(0).steps.at(0).geometry.mount.pose.x, DriveBag::kMount);
  options.base_frame = "base_link";
  EXPECT_NE(refusalOf(path, options).find("has no transform from base to the scanner's frame"), std::string::npos);
}

/// What `rosbag record --split` makes of a recording: everything up to `seconds` after its begin, and the rest.
BagParts split(const std::string& path, double seconds) {
  const std::string name = path.substr(0, path.rfind('.'));
  BagParts parts = {name + "_0.bag", name + "_1.bag"};
  rosbag::Bag whole(path);
  rosbag::Bag first(parts[0], rosbag::bagmode::Write);
  rosbag::Bag second(parts[1], rosbag::bagmode::Write);
  rosbag::View view(whole);
  const ros::Time end = view.getBeginTime() + ros::Duration(seconds);
  for (const rosbag::MessageInstance& message : view) {
    (message.getTime() < end ? first : second).write(message.getTopic(), message.getTime(), message);
  }
  return parts;
}

TEST(RecordedBagTest, PartsAreOneTimeline) {
  const std::string path = written("split.bag");
  const BagParts parts = split(path, 4.0);  // while the robot drives to its first goal
  const Outcome whole = recorded(path);
  const Outcome joined = recordedParts(parts);
  ASSERT_EQ(joined.recording.episodes.size(), whole.recording.episodes.size());
  for (std::size_t i = 0; i < whole.recording.episodes.size(); ++i) {
    const auto& expected = whole.recording.episodes[i].steps;
    const auto& steps = joined.recording.episodes[i].steps;
    ASSERT_EQ(steps.size(), expected.size()) << i;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      EXPECT_EQ(steps[k].stamp, expected[k].stamp);
      EXPECT_EQ(steps[k].label, expected[k].label);
      EXPECT_EQ(steps[k].geometry.mount.pose.x, DriveBag::kMount);
    }
  }
  EXPECT_EQ(joined.recording.rejections, whole.recording.rejections);
  BagDriveOptions options;
  options.hindsight = true;
  EXPECT_EQ(refusalOf(parts[1], options).find("has no transform from base_footprint to the scanner's frame base_scan"),
            0u)
      << "part 0 has the static transforms";
}

TEST(RecordedBagTest, WhatFollowsInTimeIsOneRecordingAlsoInAFolder) {
  const test::ScratchFolder folder;
  const auto write = [&](const std::string& name, double begin, double end) {
    rosbag::Bag bag(folder / name, rosbag::bagmode::Write);
    for (const double time : {begin, end}) bag.write("/odom", ros::Time(time), nav_msgs::Odometry());
    return folder / name;
  };
  const std::string later = write("a_later_day.bag", 90000.0, 90010.0);
  const std::string second = write("b_1.bag", 110.1, 120.0);
  const std::string first = write("c_0.bag", 100.0, 110.0);
  const std::string third = write("d_2.bag", 119.9, 130.0);
  const std::string beside = write("e_other_robot.bag", 104.0, 115.0);
  const std::string broken = folder / "f_broken.bag";
  writeBytes(broken, "this is no bag");
  const std::vector<BagParts> expected = {{first, second, third}, {beside}, {later}, {broken}};
  EXPECT_EQ(bagRecordings({folder.path().string()}, 2.0), expected);
  EXPECT_EQ(bagRecordings({broken, later, third, beside, first, second}, 2.0), expected);
  EXPECT_EQ(bagRecordings({folder.path().string(), folder / "./c_0.bag"}, 2.0), expected) << "each file once";
  EXPECT_EQ(bagRecordings({first, second}, 0.05).size(), 2u) << "a longer pause is the end of a recording";
}

TEST(RecordedBagTest, AFolderGivesEachDriveOnceAndWhatWasCutOff) {
  const test::ScratchFolder folder;
  for (const char* name : {"a.bag", "a.orig.bag", "b.orig.bag", "c.bag.active", "c.bag.orig.active", "notes.txt"}) {
    writeBytes(folder / name, "of no interest here");
  }
  const std::vector<BagParts> expected = {{folder / "a.bag"}, {folder / "b.orig.bag"}, {folder / "c.bag.active"}};
  EXPECT_EQ(bagRecordings({folder.path().string()}, 2.0), expected);
}

TEST(RecordedBagTest, AFolderWithoutBagsIsRefused) {
  const test::ScratchFolder folder;
  const auto refusal = [&]() -> std::string {
    try {
      bagRecordings({folder.path().string()}, 2.0);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const std::string none = "the folder " + folder.path().string() + " holds no bags, expected files *.bag";
  EXPECT_EQ(refusal(), none);
  writeBytes(folder / "metadata.yaml", "rosbag2_bagfile_information: {}");
  EXPECT_EQ(refusal(), none + ": it is a recording of ROS 2, rosbags-convert makes a bag of it");
}

TEST(RecordedBagTest, HindsightTakesThePlacesThatWereDrivenTo) {
  DriveBagContent content;
  content.goals = false;
  BagDriveOptions options;
  options.hindsight = true;
  options.hindsight_parameters.longest = 5.0;
  const Outcome outcome = recorded(written("hindsight.bag", content), options);
  // 7 m up to where it stood for 3 s, in two parts, and 3.4 m on.
  ASSERT_EQ(outcome.recording.episodes.size(), 3u);
  EXPECT_EQ(outcome.result.goals, 3);
  for (const RecordedEpisode& drive : outcome.recording.episodes) {
    EXPECT_EQ(drive.episode.end, EpisodeEnd::kArrived);
    EXPECT_EQ(drive.episode.goal_source, "hindsight");
  }
  EXPECT_NEAR(outcome.recording.episodes[1].episode.goal.pose.x, 4.0, 0.05);
  EXPECT_NEAR(outcome.recording.episodes[1].episode.goal.pose.y, 3.0, 0.05);
}

TEST(RecordedBagTest, WhatIsMissingOrAmbiguousIsRefusedInASentence) {
  DriveBagContent content;
  content.goals = false;
  EXPECT_EQ(refusalOf(written("no_goals.bag", content)),
            "has no goals: expected some on move_base/goal, move_base_simple/goal or another --goal-topic; with "
            "--hindsight places that the robot reached are the goals");
  content.odometry = false;
  content.transforms = false;
  content.mount = false;
  EXPECT_EQ(refusalOf(written("no_odometry.bag", content)),
            "has no odometry: expected a topic of nav_msgs/Odometry, or /tf, among /scan (sensor_msgs/LaserScan)");
  content.transforms = true;
  EXPECT_EQ(refusalOf(written("no_base_link.bag", content)),
            "has no odometry: expected a topic of nav_msgs/Odometry, or the transforms from odom to base_link "
            "(--odometry-frame, --base-frame)");

  const std::string path = written("two_scanners.bag");
  {
    rosbag::Bag bag(path, rosbag::bagmode::Append);
    bag.write("/rear", ros::Time(DriveBag::kStart), sensor_msgs::LaserScan());
  }
  EXPECT_EQ(refusalOf(path),
            "has several topics of sensor_msgs/LaserScan, expected one of /rear, /scan for --scan-topic");
  BagDriveOptions options;
  options.scan_topic = "scan";
  EXPECT_EQ(recorded(path, options).result.scans, 320);
  options.scan_topic = "/odom";
  EXPECT_EQ(refusalOf(path, options).find("has no topic /odom of sensor_msgs/LaserScan, but /move_base/cancel"), 0u);
  options = {};
  options.scan_topic = "scan";
  options.goal_topics = {"path/goal"};
  EXPECT_EQ(refusalOf(path, options)
                .find("has no topic /path/goal of geometry_msgs/PoseStamped or move_base_msgs/MoveBaseActionGoal, but"),
            0u);
}

TEST(RecordedBagTest, MessagesWithoutAFrameAreRefusedWhereItIsNeeded) {
  DriveBagContent content;
  content.scan_frame = "";
  BagDriveOptions options;
  const std::string scans = written("no_scan_frame.bag", content);
  EXPECT_EQ(refusalOf(scans).find("has scans without a frame"), 0u);
  options.mount = SensorMount{{DriveBag::kMount, 0.0, 0.0}, false};
  EXPECT_GT(recorded(scans, options).steps(), 0);
  content = {};
  content.odometry_frame = "";
  const std::string odometry = written("no_odometry_frame.bag", content);
  EXPECT_EQ(refusalOf(odometry).find("has odometry without a frame, expected one in header.frame_id on /odom"), 0u);
  options = {};
  options.hindsight = true;
  EXPECT_GT(recorded(odometry, options).steps(), 0);
}

/// With the first ten seconds of another run at the same times, 4 m away.
std::string withSecondRun(const std::string& name) {
  const std::string path = written(name);
  rosbag::Bag first(written("one_run.bag"));
  rosbag::Bag both(path, rosbag::bagmode::Append);
  rosbag::View view(first, rosbag::TopicQuery("/odom"));
  for (const rosbag::MessageInstance& message : view) {
    nav_msgs::Odometry odometry = *message.instantiate<nav_msgs::Odometry>();
    if (odometry.header.stamp > ros::Time(DriveBag::kStart + 10.0)) continue;
    odometry.header.stamp += ros::Duration(0.02);
    odometry.pose.pose.position.y -= 4.0;
    both.write("/odom", message.getTime(), odometry);
  }
  return path;
}

TEST(RecordedBagTest, TwoRunsWithTheSameTimesAreRefusedInASentence) {
  const std::string path = withSecondRun("two_runs.bag");
  BagDriveOptions options;
  for (const bool hindsight : {false, true}) {
    options.hindsight = hindsight;
    EXPECT_EQ(refusalOf(path, options),
              "has two runs with the same times: its odometry jumps to and fro between two paths from 1000.100 s to "
              "1010.100 s. The clock was set back while it was recorded, as when a simulator starts again: record one "
              "bag a run");
  }
}

TEST(RecordedBagTest, FilesThatAreNoBagsAreRefusedInASentence) {
  EXPECT_EQ(refusalOf(pathOf("none.bag")).find("cannot be read: "), 0u);
  EXPECT_EQ(refusalOf(testing::TempDir()).find("cannot be read: "), 0u) << refusalOf(testing::TempDir());
  ASSERT_EQ(::mkfifo(pathOf("pipe.bag").c_str(), 0600), 0);
  EXPECT_EQ(refusalOf(pathOf("pipe.bag")), "cannot be read: it is a pipe or a device, expected a regular file");
  std::remove(pathOf("pipe.bag").c_str());
  writeBytes(pathOf("text.bag"), "this is no bag\n");
  EXPECT_EQ(refusalOf(pathOf("text.bag")), "cannot be read: it does not begin with #ROSBAG, expected a bag of ROS 1");
  for (const char* begin : {"SQLite format 3", "\x89MCAP0\r\n"}) {
    writeBytes(pathOf("of_ros2.bag"), begin);
    EXPECT_EQ(refusalOf(pathOf("of_ros2.bag")),
              "cannot be read: it is a recording of ROS 2, expected a bag of ROS 1: rosbags-convert makes one of it");
  }
  writeBytes(pathOf("empty.bag"), "");
  EXPECT_EQ(refusalOf(pathOf("empty.bag")),
            "cannot be read: it is empty, as when recording was cut off before anything was written");
  { rosbag::Bag bag(pathOf("nothing.bag"), rosbag::bagmode::Write); }
  EXPECT_EQ(refusalOf(pathOf("nothing.bag")), "has no scans: expected a topic of sensor_msgs/LaserScan among none");
}

/// The bag of goals.bag with one more message, in the middle.
template <typename Message>
std::string withMessage(const std::string& name, const std::string& topic, const Message& message) {
  const std::string path = written(name);
  rosbag::Bag bag(path, rosbag::bagmode::Append);
  bag.write(topic, ros::Time(DriveBag::kStart + 10.0), message);
  return path;
}

TEST(RecordedBagTest, AStampFarAheadOfTheOthersIsLeftOutAndSaid) {
  const Outcome whole = recorded(written("whole.bag"));
  ASSERT_EQ(whole.result.skipped, 0);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.resize(1);
  transforms.transforms[0].header.frame_id = "odom";
  transforms.transforms[0].child_frame_id = "base_link";
  transforms.transforms[0].transform.rotation.w = 1.0;
  for (const std::uint32_t seconds : {4294967295U, 4000000000U}) {
    transforms.transforms[0].header.stamp = ros::Time(seconds, 0);
    const Outcome outcome = recorded(withMessage("tf_ahead.bag", "/tf", transforms));
    EXPECT_EQ(outcome.result.skipped, 1);
    EXPECT_NE(outcome.result.first_skipped.find("/tf at "), std::string::npos) << outcome.result.first_skipped;
    EXPECT_NE(outcome.result.first_skipped.find("far ahead of the others"), std::string::npos);
    EXPECT_EQ(outcome.recording.episodes.size(), whole.recording.episodes.size());
    EXPECT_EQ(outcome.recording.episodes[0].steps.size(), whole.recording.episodes[0].steps.size());
  }
}

TEST(RecordedBagTest, AGoalIsTakenWhateverItsStampUnlessItIsTooFarAway) {
  geometry_msgs::PoseStamped goal;
  goal.header.frame_id = "odom";
  goal.header.stamp = ros::Time(4294967295U, 0);
  goal.pose.orientation.w = 1.0;
  goal.pose.position.x = 50.0;
  EXPECT_EQ(recorded(withMessage("goal_ahead.bag", "/move_base_simple/goal", goal)).recording.episodes.size(), 6u);
  goal.pose.position.x = 1.7e308;
  const Outcome outcome = recorded(withMessage("goal_far.bag", "/move_base_simple/goal", goal));
  EXPECT_EQ(outcome.recording.episodes.size(), 5u);
  EXPECT_EQ(outcome.recording.rejections[static_cast<std::size_t>(Rejection::kNotFinite)], 1);
}

/// With a scan that says it is longer than its message.
std::string withBrokenScan(const std::string& name) {
  sensor_msgs::LaserScan scan;
  const std::string frame = "the_broken_frame";
  scan.header.frame_id = frame;
  const std::string path = withMessage(name, "/scan", scan);
  std::string bytes = bytesOf(path);
  constexpr std::size_t kLimits = 7 * sizeof(float);
  const std::size_t count = bytes.rfind(frame) + frame.size() + kLimits;
  bytes.replace(count, 4, std::string("\0\0\0\x40", 4));  // 2^30 ranges
  writeBytes(path, bytes);
  return path;
}

TEST(RecordedBagTest, AScanThatSaysItIsLongerThanItsMessageIsLeftOut) {
  const Outcome outcome = recorded(withBrokenScan("broken_scan.bag"));
  EXPECT_EQ(outcome.result.skipped, 1);
  EXPECT_NE(outcome.result.first_skipped.find("/scan at "), std::string::npos) << outcome.result.first_skipped;
  EXPECT_EQ(outcome.recording.episodes.size(), 5u);
}

TEST(RecordedBagTest, TheClockIsThatOfTheMessagesThatCount) {
  nav_msgs::Odometry odometry;
  odometry.header.frame_id = "odom";
  odometry.header.stamp = ros::Time(4294967295U, 0);
  odometry.pose.pose.orientation.w = 1.0;
  const auto difference = recorded(written("whole.bag")).result.clock_difference;
  ASSERT_TRUE(difference.has_value());
  EXPECT_EQ(recorded(withMessage("odometry_ahead.bag", "/odom", odometry)).result.clock_difference, difference);
  DriveBagContent other_clock;
  other_clock.clock_ahead = 100.0;
  const auto ahead = recorded(written("other_clock.bag", other_clock)).result.clock_difference;
  EXPECT_NEAR(static_cast<double>(ahead.value() - *difference), 100e9, 1e3);
}

TEST(RecordedBagTest, WhatCannotBeUsedDoesNotEndAReplay) {
  nav_msgs::Odometry ahead;
  ahead.header.stamp = ros::Time(4294967295U, 0);
  for (const std::string& path :
       {withMessage("odometry_ahead.bag", "/odom", ahead), withBrokenScan("broken_scan.bag")}) {
    const test::Outcome replay = test::runShell("rosrun lstm_planner bag_replay _rate:=0 _patience:=0 _bag:=" + path);
    EXPECT_EQ(replay.status, 0) << replay.output;
    EXPECT_NE(replay.output.find(" decisions in "), std::string::npos) << replay.output;
  }
}

TEST(RecordedBagTest, BagsThatWereCutOffAreRefusedInASentence) {
  const std::string bytes = bytesOf(written("whole.bag"));
  Random random(3);
  for (int i = 0; i < 40; ++i) {
    writeBytes(pathOf("cut_off.bag"), bytes.substr(0, uniformIndex(random, bytes.size())));
    const std::string refusal = refusalOf(pathOf("cut_off.bag"));
    EXPECT_TRUE(refusal.find("cannot be read: ") == 0 || refusal.find("has no index") == 0) << refusal;
  }
}

TEST(RecordedBagTest, BagsWhoseRecordingWasCutOffHaveNoIndex) {
  rosbag::Bag bag(pathOf("unfinished.bag"), rosbag::bagmode::Write);
  bag.setChunkThreshold(1000);
  for (int i = 0; i < 100; ++i) bag.write("/odom", ros::Time(1.0 + i), nav_msgs::Odometry());
  writeBytes(pathOf("unindexed.bag"), bytesOf(pathOf("unfinished.bag")));
  EXPECT_EQ(refusalOf(pathOf("unindexed.bag")),
            "has no index, as when recording was cut off: rosbag reindex makes one");
}

struct RealBag {
  const char* file;
  const char* odometry;  ///< topic
  long scans;            ///< as rosbag info counts them
  double max_speed;      ///< m/s
  bool mount_known;
  long least_steps;  ///< of two a second where it moves; less where sensors are silent
};

void PrintTo(const RealBag& bag, std::ostream* out) { *out << bag.file; }

class RealRecordedBagTest : public testing::TestWithParam<RealBag> {};

TEST_P(RealRecordedBagTest, ConvertsWithHindsight) {
  const RealBag& bag = GetParam();
  const std::string path = realData(std::string("bags/") + bag.file);
  SKIP_WITHOUT_REAL_DATA(path);
  EXPECT_EQ(refusalOf(path).find("has no goals"), 0u);
  BagDriveOptions options;
  options.hindsight = true;
  EXPECT_EQ(refusalOf(path, options).find("has no transform from ") == 0, !bag.mount_known);
  if (!bag.mount_known) options.mount = SensorMount();
  RecorderParameters parameters;
  parameters.max_speed = bag.max_speed;
  parameters.scan_rules = urgNodeRules();
  parameters.scan_rules.below_is_no_return = true;  // a URG-04LX sends its error codes as millimetres
  const Outcome outcome = recorded(path, options, parameters);
  EXPECT_EQ(outcome.result.scans, bag.scans);
  EXPECT_EQ(outcome.result.odometry_source, bag.odometry);
  EXPECT_GE(outcome.steps(), bag.least_steps);
  expectPosesOf(outcome.recording, BagOdometry(path, bag.odometry));

  // A look every half second, or a reason: messages that come late and scans without odometry do not wait for a look.
  long looks = outcome.steps();
  for (const Rejection rejection : {Rejection::kNoGoal, Rejection::kStanding, Rejection::kUnusableScan,
                                    Rejection::kNoAllowedAngle, Rejection::kNoNextStep}) {
    looks += outcome.rejected(rejection);
  }
  EXPECT_LE(static_cast<double>(looks), outcome.result.duration / parameters.period + 2.0);
}

std::string nameOf(const testing::TestParamInfo<RealBag>& info) {
  const std::string file = info.param.file;
  return file.substr(0, file.find('.'));
}

INSTANTIATE_TEST_SUITE_P(Bags, RealRecordedBagTest,
                         testing::Values(RealBag{"racecar_ust10lx_loc1.bag", "/vesc/odom", 281, 5.0, false, 7},
                                         RealBag{"racecar_ust10lx_loc2.bag", "/vesc/odom", 348, 5.0, false, 8},
                                         RealBag{"racecar_ust10lx_loc3.bag", "/vesc/odom", 218, 5.0, false, 5},
                                         RealBag{"rplidar_odom_hrp.bag", "/odom", 102, 1.0, false, 14},
                                         RealBag{"urg04lx_odom_2018dec13_before.bag", "/odom", 857, 1.0, true, 100},
                                         RealBag{"urg04lx_odom_2018feb13_col.bag", "/odom", 920, 1.0, true, 120},
                                         RealBag{"urg04lx_odom_2018may9_before1.bag", "/odom", 770, 1.0, true, 120},
                                         RealBag{"urg04lx_odom_2019jan17_expt04.bag", "/odom", 962, 1.0, true, 100}),
                         nameOf);

const RosProgram program("recorded_bags", &runTests);

}  // namespace
}  // namespace lstm_planner::recorded_bags
