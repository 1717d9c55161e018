// The global planner plugin on the recordings in test/bags: asked at the stamps of test/bags/NAME.decisions.csv it
// decides as written there, although it hears scan, odometry and goal by way of topics, in threads of its own.
//
// How fast the recording is played cannot matter: the clock is the test's, and a plan counts only when the planner has
// heard all that was published. That is known, not hoped for: the limits on the age of scan and odometry are shorter
// than the time between two of them, so the planner refuses until it has heard the newest ones, and a refusal changes
// nothing. A goal is published before the odometry of the question it is for, and the planner hears topics in that
// order.

#include <rosbag/view.h>

#include <algorithm>

#include "ros/fixtures/bag_golden.hpp"
#include "ros/fixtures/bag_planner.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::bag_plugin_decisions {
namespace {

constexpr double kCallPeriod = 0.5;      // s
constexpr double kOdometryPeriod = 0.1;  // s in these recordings
constexpr double kScanPeriod = 0.125;    // s in these recordings

struct Playing {
  std::string bag;
  double rate;  ///< s of the recording in a second; 0 = as fast as possible
};

void PrintTo(const Playing& playing, std::ostream* out) { *out << playing.bag << " at rate " << playing.rate; }

struct Message {
  ros::Time stamp;
  int rank;  ///< of equal stamps the lower ones come first, as in EventOrder
  sensor_msgs::LaserScan::ConstPtr scan;
  nav_msgs::Odometry::ConstPtr odometry;
  geometry_msgs::PoseStamped::ConstPtr goal;
  tf2_msgs::TFMessage::ConstPtr transforms;
};

/// What a robot hears, in the order of the stamps.
std::vector<Message> messagesOf(const rosbag::Bag& bag) {
  std::vector<Message> messages;
  rosbag::View view(bag);
  for (const rosbag::MessageInstance& recorded : view) {
    Message message;
    message.stamp = recorded.getTime();
    message.rank = 3;
    if ((message.scan = recorded.instantiate<sensor_msgs::LaserScan>())) {
      message.stamp = message.scan->header.stamp;
      message.rank = 2;
    } else if ((message.odometry = recorded.instantiate<nav_msgs::Odometry>())) {
      message.stamp = message.odometry->header.stamp;
      message.rank = 0;
    } else if ((message.goal = recorded.instantiate<geometry_msgs::PoseStamped>())) {
      message.rank = 1;
    } else if (recorded.getTopic() == "/tf_static") {
      message.transforms = recorded.instantiate<tf2_msgs::TFMessage>();
      message.rank = -1;
    } else {
      continue;
    }
    messages.push_back(message);
  }
  std::stable_sort(messages.begin(), messages.end(), [](const Message& a, const Message& b) {
    return std::make_pair(a.stamp, a.rank) < std::make_pair(b.stamp, b.rank);
  });
  return messages;
}

class BagPluginTest : public BagPlannerTest, public testing::WithParamInterface<Playing> {
 protected:
  void SetUp() override {
    rosbag::Bag bag(shippedBag(GetParam().bag + ".bag"));
    messages_ = messagesOf(bag);
    golden_ = goldenDecisions(GetParam().bag);
    ros::Time::setNow(messages_.front().stamp);
    // A scan is asked about when the first odometry after it has come, which is at most an odometry period later.
    ros::param::set("~/LstmGlobalPlanner/scan_timeout", 0.5 * (kOdometryPeriod + kScanPeriod));
    ros::param::set("~/LstmGlobalPlanner/odom_timeout", 0.5 * kOdometryPeriod);
    makePlanner("odom", 1.0, kCallPeriod);
  }

  void play() {
    auto next = golden_.begin();
    const ros::WallTime started = ros::WallTime::now();
    for (const Message& message : messages_) {
      if (next == golden_.end() || HasFailure()) return;
      const double elapsed = (message.stamp - messages_.front().stamp).toSec();
      if (GetParam().rate > 0.0) {
        ros::WallTime::sleepUntil(started + ros::WallDuration(elapsed / GetParam().rate));
      }
      ros::Time::setNow(message.stamp);
      publish(message);
      const bool is_known = scan_stamp_.toSec() >= next->stamp - kRounding && odometry_stamp_ >= scan_stamp_;
      if (is_known && message.rank >= 0) {
        EXPECT_NEAR(scan_stamp_.toSec(), next->stamp, kRounding);
        ask(*next++);
      }
    }
  }

  std::vector<GoldenDecision> golden_;
  std::size_t asked_ = 0;

 private:
  static constexpr double kRounding = 1e-6;  // s, of the stamps in the file

  /// Messages are published as shared pointers: within a process these reach the planner's queue at once, in order.
  void publish(const Message& message) {
    if (message.scan) {
      scan_stamp_ = message.stamp;
      scan_publisher_.publish(message.scan);
    } else if (message.odometry) {
      odometry_stamp_ = message.stamp;
      robot_ = fromMessage(message.odometry->pose.pose);
      odometry_publisher_.publish(message.odometry);
    } else if (message.goal) {
      goal_ = *message.goal;
      goal_publisher_.publish(message.goal);
    } else {
      static_broadcaster_.sendTransform(message.transforms->transforms);
    }
  }

  void ask(const GoldenDecision& golden) {
    const int before = decisions_.count();
    Plan plan;
    ASSERT_TRUE(eventually([&] { return planner()->makePlan(stampedPose("odom", robot_), goal_, plan); }))
        << "no plan at " << golden.stamp << " s";
    ASSERT_TRUE(eventually([&] { return decisions_.count() > before; }));
    expectSameDecision(decisions_.newest(), golden);
    ++asked_;
  }

  std::vector<Message> messages_;
  ros::Time scan_stamp_;
  ros::Time odometry_stamp_;
  Pose2 robot_;  ///< odometry frame
  geometry_msgs::PoseStamped goal_;
};

TEST_P(BagPluginTest, DecidesAsTheReplayDoes) {
  play();
  EXPECT_EQ(asked_, golden_.size());
}

INSTANTIATE_TEST_SUITE_P(Bags, BagPluginTest,
                         testing::Values(Playing{"doors", 0.0}, Playing{"doors", 10.0}, Playing{"dead_end", 0.0},
                                         Playing{"dead_end", 10.0}, Playing{"bad_floor", 0.0},
                                         Playing{"bad_floor", 10.0}),
                         [](const auto& info) {
                           return info.param.bag + "_at_rate_" + std::to_string(static_cast<int>(info.param.rate));
                         });

const RosProgram program("bag_plugin_decisions", &runTestsBesideSpinner);

}  // namespace
}  // namespace lstm_planner::bag_plugin_decisions
