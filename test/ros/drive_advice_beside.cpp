// The node drive_advice beside scripted_teleoperator, which drives create2_stub.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/fixtures/callback_thread.hpp"
#include "ros/fixtures/fake_robot.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::drive_advice_beside {
namespace {

constexpr std::size_t kPointsOfAnArrow = 6;

class DriveAdvice : public testing::Test {
 protected:
  DriveAdvice()
      : goals_(callbacks_.nodeHandle().advertise<geometry_msgs::PoseStamped>("dataset_recorder/goal", 1, true)),
        agreement_(callbacks_.nodeHandle().subscribe("drive_advice/agreement", 100, &DriveAdvice::onAgreement, this)),
        decisions_(callbacks_.nodeHandle().subscribe("drive_advice/LstmGlobalPlanner/decision", 1000,
                                                     &DriveAdvice::onDecision, this)),
        markers_(callbacks_.nodeHandle().subscribe("drive_advice/LstmGlobalPlanner/markers", 10,
                                                   &DriveAdvice::onMarkers, this)),
        driver_(callbacks_.nodeHandle().subscribe("drive_advice/driver", 10, &DriveAdvice::onDriver, this)),
        commands_(callbacks_.nodeHandle().subscribe("cmd_vel", 100, &DriveAdvice::onCommand, this)) {}

  void onAgreement(const diagnostic_msgs::DiagnosticStatus::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& entry : message->values) values_[entry.key] = std::stod(entry.value);
  }
  void onDecision(const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    stamps_.push_back(message->header.stamp.toSec());
  }
  void onMarkers(const visualization_msgs::MarkerArray::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& marker : message->markers) {
      if (marker.action == visualization_msgs::Marker::ADD) shown_.insert(marker.ns);
    }
  }
  void onDriver(const visualization_msgs::MarkerArray::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& marker : message->markers) arrows_[marker.ns] = marker;
  }
  void onCommand(const ros::MessageEvent<const geometry_msgs::Twist>& event) {
    const std::lock_guard<std::mutex> lock(mutex_);
    drivers_.insert(event.getPublisherName());
  }

  double value(const std::string& key) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return values_[key];
  }

  std::mutex mutex_;
  std::map<std::string, double> values_;
  std::vector<double> stamps_;
  std::set<std::string> shown_;
  std::map<std::string, visualization_msgs::Marker> arrows_;
  std::set<std::string> drivers_;
  CallbackThread callbacks_;
  ros::Publisher goals_;
  ros::Subscriber agreement_, decisions_, markers_, driver_, commands_;
};

TEST_F(DriveAdvice, SaysAtEveryStepWhatThePlannerWouldDoAndHowOftenTheDriverDidTheSame) {
  ASSERT_TRUE(eventually([&] { return goals_.getNumSubscribers() == 2 && decisions_.getNumPublishers() > 0; }));
  goals_.publish(toMessage({2.0, 8.25, 0.0}, "map"));
  // 6 m at 0.3 m/s are 40 steps of half a second.
  const auto driven = [&] { return value("decisions") >= 20.0; };
  ASSERT_TRUE(eventually(driven) || eventually(driven));
  // Which of two topics comes first is not certain.
  const auto advised = [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    return static_cast<double>(stamps_.size()) > values_["decisions"];
  };
  EXPECT_TRUE(eventually(advised)) << "the step that is being driven is advised about, too";

  const std::lock_guard<std::mutex> lock(mutex_);
  const double decisions = values_["decisions"];
  for (std::size_t i = 1; i < stamps_.size(); ++i) {
    EXPECT_GE(stamps_[i] - stamps_[i - 1], 0.5 - 0.025 - 1e-6) << "of scans at 40 Hz";
  }
  EXPECT_EQ(values_["accuracy"], std::round(1e6 * values_["same"] / decisions) / 1e6);
  for (const char* share : {"accuracy", "balanced", "majority", "majority_balanced", "network"}) {
    EXPECT_GE(values_[share], 0.0) << share;
    EXPECT_LE(values_[share], 1.0) << share;
  }
  EXPECT_GE(values_["majority"], 1.0 / 5.0) << "of five angles";
  for (const char* name : {"sectors", "preferences", "waypoint", "goal"}) EXPECT_TRUE(shown_.count(name)) << name;
  EXPECT_EQ(drivers_, std::set<std::string>{"/scripted_teleoperator"}) << "who advises does not drive";

  // An arrow a step, green where both agree.
  const visualization_msgs::Marker& planned = arrows_["planned"];
  std::size_t green = 0;
  for (const auto& color : planned.colors) green += color.g > color.r;
  EXPECT_EQ(arrows_["driven"].points.size(), planned.points.size());
  const std::size_t steps = planned.points.size() / kPointsOfAnArrow;
  EXPECT_EQ(arrows_["agreement"].text,
            "same angle at " + std::to_string(green / kPointsOfAnArrow) + " of " + std::to_string(steps) + " steps");
}

const RosProgram program("drive_advice_beside", &runTests);

}  // namespace
}  // namespace lstm_planner::drive_advice_beside
