#pragma once

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <memory>
#include <string>
#include <vector>

#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/planner_fixture.hpp"
#include "ros/plugin_loader.hpp"
#include "ros/recording.hpp"
#include "support/real_data.hpp"

namespace lstm_planner {

/// Path of a recording that comes with the package.
inline std::string shippedBag(const std::string& file) {
  return std::string(LSTM_PLANNER_SOURCE_DIR) + "/test/bags/" + file;
}

/// The global planner, loaded and made as move_base does, and the topics on which a recording is played to it.
class BagPlannerTest : public testing::Test {
 protected:
  ~BagPlannerTest() override {
    ros::param::del("~/LstmGlobalPlanner");
    ros::param::del("~/planner_frequency");
  }

  /// `global_frame`: of the costmap; `call_period`: s between questions.
  void makePlanner(const std::string& global_frame, double max_speed, double call_period) {
    ros::param::set("~/LstmGlobalPlanner/model", shippedModel());
    ros::param::set("~/LstmGlobalPlanner/leader", "network");
    ros::param::set("~/LstmGlobalPlanner/max_speed", max_speed);
    ros::param::set("~/LstmGlobalPlanner/no_return", no_return_);
    ros::param::set("~/planner_frequency", 1.0 / call_period);
    ros::param::set("~/costmap/global_frame", global_frame);
    ros::param::set("~/costmap/robot_base_frame", "base_link");
    ros::param::set("~/costmap/rolling_window", true);
    ros::param::set("~/costmap/update_frequency", 0.0);
    ros::param::set("~/costmap/plugins", std::vector<std::string>());
    // A costmap wants to know where the robot is before it can be made. The planner listens to tf itself.
    costmap_tf_.setUsingDedicatedThread(true);
    costmap_tf_.setTransform(toMessage(Pose2{}, global_frame, "base_link", ros::Time::now()), "test", true);
    costmap_ = std::make_unique<costmap_2d::Costmap2DROS>("costmap", costmap_tf_);
    planner_ = loader_->createInstance("lstm_planner/LstmGlobalPlanner");
    planner_->initialize("LstmGlobalPlanner", costmap_.get());
    ASSERT_TRUE(eventually([&] {
      return scan_publisher_.getNumSubscribers() > 0 && odometry_publisher_.getNumSubscribers() > 0 &&
             tf_publisher_.getNumSubscribers() > 0 && goal_publisher_.getNumSubscribers() > 0 && decisions_.connected();
    }));
  }

  ros::NodeHandle node_handle_;
  ros::Publisher scan_publisher_ = node_handle_.advertise<sensor_msgs::LaserScan>("scan", 10);
  ros::Publisher odometry_publisher_ = node_handle_.advertise<nav_msgs::Odometry>("odom", 10);
  ros::Publisher tf_publisher_ = node_handle_.advertise<tf2_msgs::TFMessage>("/tf", 10);
  ros::Publisher goal_publisher_ = ros::NodeHandle("~").advertise<geometry_msgs::PoseStamped>("current_goal", 1);
  tf2_ros::StaticTransformBroadcaster static_broadcaster_;
  std::string no_return_ = noReturnText(urgNodeRules());  ///< what the drivers of the recordings send
  DecisionListener decisions_{"LstmGlobalPlanner"};
  boost::shared_ptr<nav_core::BaseGlobalPlanner> planner() { return planner_; }

 private:
  tf2_ros::Buffer costmap_tf_;
  std::unique_ptr<costmap_2d::Costmap2DROS> costmap_;
  std::unique_ptr<PlannerLoader> loader_ = plannerLoader();
  boost::shared_ptr<nav_core::BaseGlobalPlanner> planner_;
};

}  // namespace lstm_planner
