#pragma once

#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lstm_planner/ros/create2_stub/create2_stub_parameters.hpp"
#include "lstm_planner/simulation/localiser.hpp"
#include "ros/create2_stub/create2_stub_driver.hpp"
#include "ros/create2_stub/create2_stub_scanner.hpp"
#include "ros/create2_stub/create2_stub_world.hpp"
#include "ros/create2_stub/schedule.hpp"

namespace lstm_planner {

/// The node `create2_stub`: a simulated Create 2 with a Hokuyo, or two, in a map, seen through the topics of
/// create_driver and urg_node. The physics runs in fixed steps of 5 ms in lock step with scans and driver loop, on one
/// of three clocks: the computer's, a /clock that someone else publishes, or a /clock of its own (parameter
/// publish_clock).
///
/// Publishes beside the driver's topics (Create2StubDriver): `scan`; `second_scan` if it has a second scanner;
/// `~contacts` (std_msgs/UInt32, latched) and
/// `~ground_truth` (nav_msgs/Odometry in the map frame, 40 Hz), for judging only. Services: `~pause_scan`
/// and `~pause_second_scan` (std_srvs/SetBool, true = no scans), `~jump_odometry` (std_srvs/Trigger).
class Create2Stub {
 public:
  /// Throws std::invalid_argument naming what does not fit.
  explicit Create2Stub(const Create2StubParameters& parameters);

  /// Returns when ROS shuts down.
  void run();

 private:
  void runOwnClock();
  void waitForCommand();
  void onCommand(const geometry_msgs::Twist::ConstPtr& message);
  void runGivenClock();
  void restartAt(const ros::Time& time);
  void advance();
  void watchOthers();
  void publishStaticTransforms();
  bool isLocalised() const { return parameters_.publish_map && parameters_.localisation_jump > 0.0; }
  void publishLocalisation();
  void publishMap();
  void publishScans();
  void publishGroundTruth();
  void publishContacts();
  bool jumpOdometry(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  ros::Time simulatedTime() const;
  ros::Time driverTime() const;  ///< on a clock that runs by itself no two messages of the driver have the same stamp

  Create2StubParameters parameters_;
  std::unique_ptr<World> building_;
  WorldWithRobots world_;
  RobotInWorld robot_;
  Create2StubScanner scanner_;
  std::optional<Create2StubScanner> second_scanner_;
  Create2StubDriver driver_;
  Localiser localiser_;
  std::uint64_t time_ = 0;  ///< ns, end of the last physics step
  Schedule driver_loop_;
  Schedule encoders_;
  Schedule clock_;
  unsigned contacts_published_ = 0;
  bool controlled_ = false;         ///< by a controller that sends command after command
  std::uint64_t command_time_ = 0;  ///< ns, when the last command came

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  tf2_ros::TransformBroadcaster broadcaster_;
  tf2_ros::StaticTransformBroadcaster static_broadcaster_;
  ros::Subscriber command_subscriber_;
  std::vector<ros::Subscriber> other_subscribers_;
  ros::Publisher truth_publisher_;
  ros::Publisher contacts_publisher_;
  ros::Publisher map_publisher_;
  ros::Publisher clock_publisher_;
  ros::ServiceServer jump_service_;
};

}  // namespace lstm_planner
