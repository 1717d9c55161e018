#include "ros/create2_stub/create2_stub_driver.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float32.h>
#include <std_msgs/Int16.h>
#include <std_msgs/UInt16.h>
#include <std_msgs/UInt8MultiArray.h>

#include <algorithm>
#include <cmath>
#include <utility>
#ifdef LSTM_PLANNER_HAVE_CREATE_MSGS
#include <create_msgs/Bumper.h>
#include <create_msgs/ChargingState.h>
#include <create_msgs/Mode.h>
#endif

#include "lstm_planner/ros/common/conversions.hpp"

namespace lstm_planner {
namespace {

constexpr int kQueue = 30;
constexpr double kVariance = 1e-5;        // m^2 and rad^2, on the diagonal of both covariances
constexpr double kIgnored = 1e3;          // variance of what a planar robot does not measure
constexpr std::uint16_t kNoInfrared = 0;  // character of the omnidirectional receiver that sees no dock

const ros::Duration kDiagnosticsPeriod(1.0);

// A full battery at rest.
constexpr float kVoltage = 16.2F;          // V
constexpr float kCurrent = -0.2F;          // A
constexpr float kCharge = 2.6F;            // Ah
constexpr float kCapacity = 2.696F;        // Ah
constexpr std::int16_t kTemperature = 25;  // degrees Celsius

template <typename Message, typename Value>
void publish(const ros::Publisher& publisher, Value value) {
  Message message;
  message.data = value;
  publisher.publish(message);
}

template <typename Message>
void ignore(const boost::shared_ptr<const Message>&) {}

diagnostic_msgs::DiagnosticStatus status(const std::string& name, const std::string& text) {
  diagnostic_msgs::DiagnosticStatus status;
  status.level = diagnostic_msgs::DiagnosticStatus::OK;
  status.name = ros::this_node::getName().substr(1) + ": " + name;
  status.message = text;
  status.hardware_id = "CREATE_2";
  return status;
}

}  // namespace

Create2StubDriver::Create2StubDriver(const Create2StubParameters& parameters, RobotInWorld* robot,
                                     std::function<ros::Time()> now)
    : parameters_(parameters), robot_(robot), now_(std::move(now)) {
  node_.setCallbackQueue(&queue_);
  // Without it a command can wait 40 ms in the sender, which is a whole loop when simulated time runs faster.
  subscribers_.push_back(
      node_.subscribe("cmd_vel", 1, &Create2StubDriver::onCommand, this, ros::TransportHints().tcpNoDelay()));
  subscribers_.push_back(node_.subscribe<std_msgs::Empty>("dock", 10, [this](const std_msgs::Empty::ConstPtr&) {
    drive({});
    passive_ = true;
  }));
  subscribers_.push_back(
      node_.subscribe<std_msgs::Empty>("undock", 10, [this](const std_msgs::Empty::ConstPtr&) { passive_ = false; }));
  // LEDs and digits have nothing to show here.
  for (const std::string topic : {"debris_led", "spot_led", "dock_led", "check_led"}) {
    subscribers_.push_back(node_.subscribe(topic, 10, &ignore<std_msgs::Bool>));
  }
  for (const std::string topic : {"power_led", "set_ascii"}) {
    subscribers_.push_back(node_.subscribe(topic, 10, &ignore<std_msgs::UInt8MultiArray>));
  }

  odometry_publisher_ = node_.advertise<nav_msgs::Odometry>("odom", kQueue);
  joints_publisher_ = node_.advertise<sensor_msgs::JointState>("joint_states", kQueue);
  diagnostics_publisher_ = node_.advertise<diagnostic_msgs::DiagnosticArray>("diagnostics", 1);
  omni_publisher_ = node_.advertise<std_msgs::UInt16>("ir_omni", kQueue);
  for (const char* name : {"voltage", "current", "charge", "capacity", "charge_ratio"}) {
    battery_publishers_.push_back(node_.advertise<std_msgs::Float32>(std::string("battery/") + name, kQueue));
  }
  battery_publishers_.push_back(node_.advertise<std_msgs::Int16>("battery/temperature", kQueue));
  for (const char* topic :
       {"wheeldrop", "clean_button", "day_button", "hour_button", "minute_button", "dock_button", "spot_button"}) {
    silent_publishers_.push_back(node_.advertise<std_msgs::Empty>(topic, kQueue));
  }
#ifdef LSTM_PLANNER_HAVE_CREATE_MSGS
  mode_publisher_ = node_.advertise<create_msgs::Mode>("mode", kQueue);
  bumper_publisher_ = node_.advertise<create_msgs::Bumper>("bumper", kQueue);
  charging_publisher_ = node_.advertise<create_msgs::ChargingState>("battery/charging_state", kQueue);
#else
  ROS_INFO("create_msgs is not installed: the topics mode, bumper and battery/charging_state are left out");
#endif

  odometry_message_.header.frame_id = parameters_.odom_frame;
  odometry_message_.child_frame_id = parameters_.base_frame;
  for (std::size_t i = 0; i < 6; ++i) {
    const bool planar = i == 0 || i == 1 || i == 5;
    odometry_message_.pose.covariance[i * 7] = planar ? kVariance : kIgnored;
    odometry_message_.twist.covariance[i * 7] = planar ? kVariance : kIgnored;
  }
  joints_message_.name = {"left_wheel_joint", "right_wheel_joint"};
  joints_message_.position.resize(2);
  joints_message_.velocity.resize(2);
  joints_message_.effort.resize(2);
}

void Create2StubDriver::update(const ros::Time& time) {
  time_ = time;
  publishOdometry();
  publishJointStates();
  publishBattery();
  publishSensors();
  publishDiagnostics();
  // Not from zero: ros::Duration ends at 68 years, so in 2038.
  const bool is_old = last_command_.isZero() || time_ - last_command_ >= ros::Duration(parameters_.latch_cmd_duration);
  if (is_old) drive({});
  queue_.callAvailable();
}

void Create2StubDriver::onCommand(const geometry_msgs::Twist::ConstPtr& message) {
  last_command_ = time_;
  if (!passive_) drive({message->linear.x, message->angular.z});
}

void Create2StubDriver::drive(const Twist2& twist) {
  robot_->robot().command(twist);
  const bool usable = std::isfinite(twist.linear) && std::isfinite(twist.angular);
  const double half_axle = parameters_.robot.axle_length / 2.0;
  const double limit = parameters_.robot.max_wheel_speed;
  requested_left_ = usable ? std::clamp(twist.linear - twist.angular * half_axle, -limit, limit) : 0.0;
  requested_right_ = usable ? std::clamp(twist.linear + twist.angular * half_axle, -limit, limit) : 0.0;
}

void Create2StubDriver::readEncoders(double seconds_since_last) {
  const double left = robot_->robot().wheelAngle(true);
  const double right = robot_->robot().wheelAngle(false);
  const double radius = parameters_.robot.wheel_diameter / 2.0;
  const double left_speed = (left - left_angle_) * radius / seconds_since_last;
  const double right_speed = (right - right_angle_) * radius / seconds_since_last;
  measured_ = {(left_speed + right_speed) / 2.0, (right_speed - left_speed) / parameters_.robot.axle_length};
  left_angle_ = left;
  right_angle_ = right;
}

Pose2 Create2StubDriver::odometry() const { return compose(odometry_offset_, robot_->robot().odometry()); }

void Create2StubDriver::jumpOdometry(const Pose2& jump) {
  odometry_offset_ = compose(compose(odometry(), jump), inverse(robot_->robot().odometry()));
}

void Create2StubDriver::publishOdometry() {
  const Pose2 pose = odometry();
  nav_msgs::Odometry& message = odometry_message_;
  message.header.stamp = now_();
  message.pose.pose = toMessage(pose);
  message.twist.twist.linear.x = measured_.linear;
  message.twist.twist.angular.z = measured_.angular;
  if (parameters_.publish_tf) {
    broadcaster_.sendTransform(toMessage(pose, parameters_.odom_frame, parameters_.base_frame, now_()));
  }
  odometry_publisher_.publish(message);
}

void Create2StubDriver::publishJointStates() {
  const double radius = parameters_.robot.wheel_diameter / 2.0;
  joints_message_.header.stamp = now_();
  joints_message_.position[0] = robot_->robot().wheelAngle(true);
  joints_message_.position[1] = robot_->robot().wheelAngle(false);
  joints_message_.velocity[0] = requested_left_ / radius;
  joints_message_.velocity[1] = requested_right_ / radius;
  joints_publisher_.publish(joints_message_);
}

void Create2StubDriver::publishBattery() {
  const float values[] = {kVoltage, kCurrent, kCharge, kCapacity, kCharge / kCapacity};
  for (std::size_t i = 0; i < std::size(values); ++i) {
    publish<std_msgs::Float32>(battery_publishers_[i], values[i]);
  }
  publish<std_msgs::Int16>(battery_publishers_.back(), kTemperature);
}

void Create2StubDriver::publishSensors() {
  publish<std_msgs::UInt16>(omni_publisher_, kNoInfrared);
#ifdef LSTM_PLANNER_HAVE_CREATE_MSGS
  create_msgs::Mode mode;
  mode.header.stamp = now_();
  mode.header.frame_id = parameters_.base_frame;
  mode.mode = passive_ ? create_msgs::Mode::MODE_PASSIVE : create_msgs::Mode::MODE_FULL;
  mode_publisher_.publish(mode);

  create_msgs::Bumper bumper;
  bumper.header = mode.header;
  bumper.is_left_pressed = robot_->pressed(true);
  bumper.is_right_pressed = robot_->pressed(false);
  bumper_publisher_.publish(bumper);

  create_msgs::ChargingState charging;
  charging.header = mode.header;
  charging.state = create_msgs::ChargingState::CHARGE_NONE;
  charging_publisher_.publish(charging);
#endif
}

void Create2StubDriver::publishDiagnostics() {
  if (time_ < next_diagnostics_ && next_diagnostics_ - time_ <= kDiagnosticsPeriod) return;
  next_diagnostics_ = time_ + kDiagnosticsPeriod;
  diagnostic_msgs::DiagnosticArray message;
  message.header.stamp = now_();
  message.status = {status("Battery Status", "Battery is OK"), status("Safety Status", "No safety issues detected"),
                    status("Serial Status", "Serial connection is good"),
                    status("Base Mode", passive_ ? "Mode is set to PASSIVE" : "Mode is set to FULL"),
                    status("Driver Status", "Maintaining loop frequency")};
  diagnostics_publisher_.publish(message);
}

}  // namespace lstm_planner
