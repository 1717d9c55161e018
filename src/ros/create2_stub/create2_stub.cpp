#include <geometry_msgs/Twist.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/UInt32.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/common/words.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"
#include "lstm_planner/simulation/create2_stub_parameters.hpp"
#include "lstm_planner/simulation/localiser.hpp"
#include "ros/common/node_main.hpp"
#include "ros/create2_stub/create2_stub_driver.hpp"
#include "ros/create2_stub/create2_stub_scanner.hpp"
#include "ros/create2_stub/create2_stub_world.hpp"
#include "ros/create2_stub/schedule.hpp"

namespace lstm_planner {

namespace {

constexpr std::uint64_t kStep = 5'000'000;  // ns of physics at a time
constexpr double kStepSeconds = 1e-9 * kStep;
constexpr double kEncoderRate = 1.0 / 0.015;            // Hz, the base sends its sensors every 15 ms
constexpr double kClockRate = 100.0;                    // Hz
constexpr std::uint64_t kClockStart = 100'000'000'000;  // ns; later than any buffer or time-out reaches back from
constexpr std::uint64_t kLongestGap = 1'000'000'000;    // ns that are made up for when the node was held up
constexpr double kNoSpeed = 1e6;                        // m/s: the robot's true pose does not jump
constexpr double kStaleReport = 10.0;                   // s between two warnings

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
  OdometryHistory true_poses_{kNoSpeed};  ///< of the last second
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

Create2Stub::Create2Stub(const Create2StubParameters& parameters)
    : parameters_(parameters),
      building_(makeWorld(parameters)),
      world_(*building_, footprintOf(parameters.robot).circumscribedRadius()),
      robot_(world_, parameters.robot, parameters.start, parameters.seed),
      scanner_(parameters.laser, parameters.seed + 1, parameters.laser_frame, "scan"),
      driver_(parameters, &robot_, [this] { return driverTime(); }),
      localiser_(parameters.start, parameters.localisation_jump),
      driver_loop_(parameters.loop_hz),
      encoders_(kEncoderRate),
      clock_(kClockRate) {
  const bool sim_time = node_.param("/use_sim_time", false);
  if (parameters_.publish_clock && !sim_time) {
    throw std::invalid_argument(
        "parameter " + private_node_.resolveName("publish_clock") +
        " is true but /use_sim_time is not: set it before any node starts, or the others run on another clock");
  }
  if (parameters_.has_second_laser) {
    second_scanner_.emplace(parameters_.second_laser, parameters_.seed + 2, parameters_.second_laser_frame,
                            "second_scan");
  }
  truth_publisher_ = private_node_.advertise<nav_msgs::Odometry>("ground_truth", 100);
  contacts_publisher_ = private_node_.advertise<std_msgs::UInt32>("contacts", 10, true);
  jump_service_ = private_node_.advertiseService("jump_odometry", &Create2Stub::jumpOdometry, this);
  if (parameters_.publish_clock && parameters_.command_period > 0.0) {
    command_subscriber_ = node_.subscribe("cmd_vel", 10, &Create2Stub::onCommand, this);
  }
  if (parameters_.publish_clock) clock_publisher_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  watchOthers();
  publishContacts();
}

void Create2Stub::watchOthers() {
  for (const std::string& topic : wordsOf(parameters_.others)) {
    const auto move = [this, robot = other_subscribers_.size()](const nav_msgs::Odometry::ConstPtr& truth) {
      world_.moveRobot(robot, {truth->pose.pose.position.x, truth->pose.pose.position.y});
    };
    other_subscribers_.push_back(node_.subscribe<nav_msgs::Odometry>(topic, 1, move));
  }
}

void Create2Stub::run() {
  if (parameters_.publish_clock) {
    runOwnClock();
  } else {
    runGivenClock();
  }
}

void Create2Stub::runOwnClock() {
  const ros::WallDuration step(kStepSeconds / parameters_.real_time_factor);
  const ros::WallDuration longest_delay(0.1);
  time_ = kClockStart;
  restartAt(simulatedTime());
  ros::SteadyTime next = ros::SteadyTime::now();
  while (ros::ok()) {
    ros::spinOnce();
    waitForCommand();
    advance();
    next += step;
    // Time that was lost is not made up for: the others would be flooded.
    if (ros::SteadyTime::now() - next > longest_delay) next = ros::SteadyTime::now();
    ros::SteadyTime::sleepUntil(next);
  }
}

void Create2Stub::waitForCommand() {
  const auto period = static_cast<std::uint64_t>(1e9 * parameters_.command_period);
  const ros::SteadyTime deadline = ros::SteadyTime::now() + ros::WallDuration(parameters_.command_patience);
  while (controlled_ && time_ >= command_time_ + period && ros::ok()) {
    // A controller that has ended its work says nothing any more; it is waited for once.
    controlled_ = ros::SteadyTime::now() < deadline;
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.005));
  }
}

void Create2Stub::onCommand(const geometry_msgs::Twist::ConstPtr& command) {
  // To stand still is the last thing that most say before they fall silent.
  controlled_ = command->linear.x != 0.0 || command->angular.z != 0.0;
  command_time_ = time_;
}

void Create2Stub::runGivenClock() {
  bool started = false;
  while (ros::ok()) {
    ros::spinOnce();
    const std::uint64_t now = ros::Time::now().toNSec();
    if (now == 0) {
      // The first message of a simulator's clock has not come yet.
    } else if (!started || now + kStep < time_) {
      if (started) ROS_WARN("time went back to %.3f s: the stub goes on from there", 1e-9 * static_cast<double>(now));
      restartAt(ros::Time::now());
      started = true;
    } else if (now > time_ + kLongestGap) {
      ROS_WARN_THROTTLE(kStaleReport, "the simulation was interrupted for %.2f s: the robot did not move in this time",
                        1e-9 * static_cast<double>(now - time_));
      time_ = now;
    }
    while (started && time_ + kStep <= now) advance();
    ros::WallDuration(0.002).sleep();
  }
}

void Create2Stub::restartAt(const ros::Time& time) {
  time_ = time.toNSec();
  true_poses_.restart();
  for (Schedule* schedule : {&driver_loop_, &encoders_, &clock_}) schedule->restart(time_);
  scanner_.restart(time_);
  if (second_scanner_) second_scanner_->restart(time_);
  publishStaticTransforms();
  if (parameters_.publish_map) publishMap();
}

ros::Time Create2Stub::simulatedTime() const { return ros::Time().fromNSec(time_); }

ros::Time Create2Stub::driverTime() const {
  return parameters_.publish_clock ? simulatedTime() : std::max(simulatedTime(), ros::Time::now());
}

void Create2Stub::advance() {
  time_ += kStep;
  robot_.step(kStepSeconds);
  true_poses_.add({1e-9 * static_cast<double>(time_), robot_.robot().truePose(), {}});
  if (parameters_.publish_clock && clock_.due(time_)) {
    rosgraph_msgs::Clock message;
    message.clock = simulatedTime();
    clock_publisher_.publish(message);
  }
  if (robot_.contacts() != contacts_published_) publishContacts();
  if (encoders_.due(time_)) driver_.readEncoders(1.0 / kEncoderRate);
  publishScans();
  if (driver_loop_.due(time_)) {
    driver_.update(simulatedTime());
    if (isLocalised()) publishLocalisation();
  }
}

void Create2Stub::publishScans() {
  if (second_scanner_) second_scanner_->publishIfDue(world_, true_poses_, time_);
  if (scanner_.publishIfDue(world_, true_poses_, time_)) publishGroundTruth();
}

void Create2Stub::publishGroundTruth() {
  nav_msgs::Odometry message;
  message.header.stamp = simulatedTime();
  message.header.frame_id = parameters_.map_frame;
  message.child_frame_id = parameters_.base_frame;
  message.pose.pose = toMessage(robot_.robot().truePose());
  message.twist.twist.linear.x = robot_.robot().measuredTwist().linear;
  message.twist.twist.angular.z = robot_.robot().measuredTwist().angular;
  truth_publisher_.publish(message);
}

void Create2Stub::publishContacts() {
  contacts_published_ = robot_.contacts();
  const Pose2& pose = robot_.robot().truePose();
  if (contacts_published_ > 0) ROS_WARN("contact %u at (%.2f, %.2f)", contacts_published_, pose.x, pose.y);
  std_msgs::UInt32 message;
  message.data = contacts_published_;
  contacts_publisher_.publish(message);
}

void Create2Stub::publishStaticTransforms() {
  const ros::Time now = simulatedTime();
  std::vector<geometry_msgs::TransformStamped> transforms;
  // Where several robots share tf, their frames begin with their names.
  const std::string base_link = parameters_.base_frame.substr(0, parameters_.base_frame.rfind('/') + 1) + "base_link";
  if (parameters_.publish_static_tf) {
    transforms.push_back(toMessage(Pose2{}, parameters_.base_frame, base_link, now));
    transforms.back().transform.translation.z = parameters_.base_link_height;
    transforms.push_back(mountToMessage(parameters_.laser.mount, base_link, parameters_.laser_frame, now));
    transforms.back().transform.translation.z = parameters_.laser_height;
    if (second_scanner_) {
      const SensorMount& mount = parameters_.second_laser.mount;
      transforms.push_back(mountToMessage(mount, base_link, parameters_.second_laser_frame, now));
      transforms.back().transform.translation.z = parameters_.second_laser_height;
    }
  }
  if (parameters_.publish_map && !isLocalised()) {
    transforms.push_back(toMessage(parameters_.start, parameters_.map_frame, parameters_.odom_frame, now));
  }
  static_broadcaster_.sendTransform(transforms);
}

void Create2Stub::publishLocalisation() {
  localiser_.localise(robot_.robot().truePose(), driver_.odometry());
  const Pose2 map_from_odometry = compose(parameters_.start, localiser_.correction());
  broadcaster_.sendTransform(toMessage(map_from_odometry, parameters_.map_frame, parameters_.odom_frame, driverTime()));
}

void Create2Stub::publishMap() {
  const auto* grid_world = dynamic_cast<const GridWorld*>(building_.get());
  if (grid_world == nullptr) return;
  const OccupancyGrid& grid = grid_world->grid();
  nav_msgs::OccupancyGrid message;
  message.header.stamp = simulatedTime();
  message.header.frame_id = parameters_.map_frame;
  message.info.resolution = static_cast<float>(grid.resolution());
  message.info.width = static_cast<std::uint32_t>(grid.columns());
  message.info.height = static_cast<std::uint32_t>(grid.rows());
  message.info.origin = toMessage(grid.origin());
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const Cell cell = grid.at({column, row});
      message.data.push_back(cell == Cell::kUnknown ? -1 : cell == Cell::kOccupied ? 100 : 0);
    }
  }
  if (!map_publisher_) map_publisher_ = node_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
  map_publisher_.publish(message);
}

bool Create2Stub::jumpOdometry(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  driver_.jumpOdometry(parameters_.odometry_jump);
  response.success = true;
  return true;
}

/// Reads all parameters from the node's private namespace; what is not set keeps its default. Throws
/// std::invalid_argument naming the parameter, its value and what was expected.
Create2StubParameters loadCreate2StubParameters(const ros::NodeHandle& private_node) {
  ParameterReader reader(private_node);
  Create2StubParameters parameters;
  reader.read("scenario/start", &parameters.start);
  visitCreate2StubParameters(parameters, reader.visitor(private_node.getNamespace() + "/"));
  validate(parameters.robot);
  validate(parameters.laser);
  validate(parameters.second_laser);
  if (parameters.robot_model != "CREATE_2") {
    throw std::invalid_argument("parameter " + private_node.resolveName("robot_model") + " is '" +
                                parameters.robot_model + "', expected CREATE_2, the only model that is simulated");
  }
  reader.knowGroup("scenario");  // the demo runner's
  reader.warnOfUnknown();
  return parameters;
}

}  // namespace

}  // namespace lstm_planner

int main(int argc, char** argv) {
  using namespace lstm_planner;
  return runNode(argc, argv, "create2_stub", [](const ros::NodeHandle& node) {
    Create2Stub(loadCreate2StubParameters(node)).run();
    return 0;
  });
}
