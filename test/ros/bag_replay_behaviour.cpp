// The node bag_replay on the recordings in test/bags, at several rates at once, each in a name space of its own: the
// decisions are those of test/bags/NAME.decisions.csv.
//
// They cannot depend on the rate or on the computer's load, because the node decides about all of a recording before it
// plays any of it, and looks at nothing but the recording's stamps. What is tested here is that this is so.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/LaserScan.h>

#include <memory>
#include <mutex>

#include "ros/fixtures/bag_golden.hpp"
#include "ros/fixtures/callback_thread.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::bag_replay_behaviour {
namespace {

constexpr double kPatience = 60.0;  // s; the slowest of the replays plays for 8 s

struct PublishedDecision {
  double stamp = 0.0;
  ros::WallTime received;
  std::map<std::string, std::string> values;
};

/// What one of the nodes publishes.
class ReplayListener {
 public:
  explicit ReplayListener(const std::string& name_space) {
    ros::NodeHandle node_handle = callbacks_.nodeHandle(name_space);
    clock_ = node_handle.subscribe("clock", kQueue, &ReplayListener::onClock, this);
    scans_ = node_handle.subscribe("scan", kQueue, &ReplayListener::onScan, this);
    // Last, since the node starts when somebody listens to its decisions.
    decisions_ =
        node_handle.subscribe("bag_replay/LstmGlobalPlanner/decision", kQueue, &ReplayListener::onDecision, this);
  }

  ros::WallTime since() const { return since_; }
  std::vector<PublishedDecision> decisions() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return received_;
  }
  bool clockWentBack() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return clock_went_back_;
  }
  int scanCount() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return scan_count_;
  }

 private:
  static constexpr int kQueue = 10000;

  void onDecision(const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
    PublishedDecision decision{message->header.stamp.toSec(), ros::WallTime::now(), {}};
    decision.values["source"] = message->status.at(0).message;
    for (const auto& entry : message->status.at(0).values) decision.values[entry.key] = entry.value;
    const std::lock_guard<std::mutex> lock(mutex_);
    received_.push_back(decision);
  }
  void onClock(const rosgraph_msgs::Clock::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    clock_went_back_ = clock_went_back_ || message->clock < time_;
    time_ = message->clock;
  }
  void onScan(const sensor_msgs::LaserScan::ConstPtr&) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++scan_count_;
  }

  const ros::WallTime since_ = ros::WallTime::now();
  std::mutex mutex_;
  std::vector<PublishedDecision> received_;
  ros::Time time_;
  bool clock_went_back_ = false;
  int scan_count_ = 0;
  CallbackThread callbacks_;
  ros::Subscriber clock_, scans_, decisions_;
};

struct Replay {
  std::string bag;
  double rate;  ///< 0 = as fast as possible
  std::string nameSpace() const { return bag + "_at_rate_" + std::to_string(static_cast<int>(rate)); }
};

void PrintTo(const Replay& replay, std::ostream* out) { *out << replay.nameSpace(); }

const std::vector<Replay>& replays() {
  static const std::vector<Replay> kReplays = {{"doors", 0.0},     {"doors", 5.0},     {"doors", 20.0},
                                               {"dead_end", 0.0},  {"dead_end", 20.0}, {"bad_floor", 0.0},
                                               {"bad_floor", 20.0}};
  return kReplays;
}

/// All nodes play at the same time; each test looks at one of them.
class BagReplayTest : public testing::TestWithParam<Replay> {
 protected:
  static void SetUpTestSuite() {
    for (const Replay& replay : replays()) {
      listeners()[replay.nameSpace()] = std::make_unique<ReplayListener>("/" + replay.nameSpace());
    }
  }
  static void TearDownTestSuite() { listeners().clear(); }

  static std::map<std::string, std::unique_ptr<ReplayListener>>& listeners() {
    static std::map<std::string, std::unique_ptr<ReplayListener>> all;
    return all;
  }

  ReplayListener& listener() { return *listeners().at(GetParam().nameSpace()); }

  /// Waits until there are as many as that, or for long enough.
  std::vector<PublishedDecision> decisions(std::size_t count) {
    const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(kPatience);
    while (listener().decisions().size() < count && ros::WallTime::now() < deadline) ros::WallDuration(0.01).sleep();
    return listener().decisions();
  }
};

TEST_P(BagReplayTest, DecidesAsEverywhere) {
  const std::vector<GoldenDecision> golden = goldenDecisions(GetParam().bag);
  const std::vector<PublishedDecision> decided = decisions(golden.size());
  ASSERT_EQ(decided.size(), golden.size());
  for (std::size_t i = 0; i < golden.size(); ++i) {
    EXPECT_NEAR(decided[i].stamp, golden[i].stamp, 1e-6);
    expectSameDecision(decided[i].values, golden[i]);
  }
}

TEST_P(BagReplayTest, PlaysNoFasterThanItIsTold) {
  const std::vector<GoldenDecision> golden = goldenDecisions(GetParam().bag);
  const std::vector<PublishedDecision> decided = decisions(golden.size());
  ASSERT_EQ(decided.size(), golden.size());
  EXPECT_FALSE(listener().clockWentBack());
  EXPECT_GT(listener().scanCount(), 0);
  if (GetParam().rate > 0.0) {
    // It waits for a listener, and what arrives late on a busy computer makes it slower only.
    const double least = (golden.back().stamp - golden.front().stamp) / GetParam().rate;
    EXPECT_GE((decided.back().received - listener().since()).toSec(), least);
  }
}

INSTANTIATE_TEST_SUITE_P(Bags, BagReplayTest, testing::ValuesIn(replays()),
                         [](const auto& info) { return info.param.nameSpace(); });

const RosProgram program("bag_replay_behaviour", &runTests);

}  // namespace
}  // namespace lstm_planner::bag_replay_behaviour
