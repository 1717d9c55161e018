#include "ros/controller/steering_controller.hpp"

#include <ros/console.h>
#include <ros/node_handle.h>

#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>

#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "ros/common/costmap_footprint.hpp"
#include "ros/common/costmap_reader.hpp"
#include "ros/common/guarded.hpp"
#include "ros/common/plugin_diagnostics.hpp"
#include "ros/common/reconfigure_server.hpp"
#include "ros/common/timing.hpp"
#include "ros/controller/plan_follower.hpp"

PLUGINLIB_EXPORT_CLASS(lstm_planner::SteeringController, nav_core::BaseLocalPlanner)

namespace lstm_planner {

namespace {

constexpr double kShortStop = 1.0;          // s: nobody needs to be told of a shorter one
constexpr double kControllerUnasked = 1.0;  // s
constexpr double kBraking = 0.03;           // m/s; slower is standing

}  // namespace

SteeringController::SteeringController() = default;

// The costmap may be gone by now: nothing below may know it.
SteeringController::~SteeringController() = default;

void SteeringController::initialize(std::string name, tf2_ros::Buffer* tf, costmap_2d::Costmap2DROS* costmap_ros) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (plan_follower_) {
      ROS_WARN("%s is already initialised, the second call is ignored", name.c_str());
      return;
    }
    guarded([&] { setUp(name, tf, costmap_ros); }, [&](const std::string& why) { refuse(name, why); });
  }
  startDiagnostics(name);
}

void SteeringController::setUp(const std::string& name, tf2_ros::Buffer* tf, costmap_2d::Costmap2DROS* costmap_ros) {
  if (tf == nullptr || costmap_ros == nullptr) {
    throw std::invalid_argument("it was initialised without tf or a costmap");
  }
  SteeringControllerParameters parameters = loadSteeringControllerParameters(ros::NodeHandle("~/" + name));
  takeSafeFootprint(*costmap_ros, name + "/", &parameters);
  plan_follower_ = std::make_unique<PlanFollower>(parameters, costmap_ros->getBaseFrameID(), *tf, costmap_ros);
  costmap_ = parameters.use_costmap ? costmap_ros : nullptr;
  const auto visit = [](auto& visited, const auto& visitor) { visitSteeringControllerParameters(visited, visitor); };
  reconfigure_ =
      serveReconfiguration(name, plan_follower_.get(), visit, changeableSteeringControllerParameters(), {}, &mutex_);
}

void SteeringController::refuse(const std::string& name, const std::string& reason) {
  why_unusable_ = reason;
  ROS_FATAL("%s cannot be used: %s", name.c_str(), reason.c_str());
}

bool SteeringController::setPlan(const std::vector<geometry_msgs::PoseStamped>& plan) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!plan_follower_) {
    ROS_ERROR_THROTTLE(kLogPeriod, "the plan is not followed: the controller cannot be used: %s",
                       why_unusable_.c_str());
    return false;
  }
  const auto take = [&] {
    plan_follower_->setPlan(plan);
    return true;
  };
  return guarded(take, [](const std::string& why) {
    ROS_WARN_THROTTLE(kLogPeriod, "the plan is not followed: %s", why.c_str());
    return false;
  });
}

bool SteeringController::computeVelocityCommands(geometry_msgs::Twist& cmd_vel) {
  cmd_vel = geometry_msgs::Twist();
  const auto costmap_lock = lockOf(costmap_);
  const std::lock_guard<std::mutex> lock(mutex_);
  answer_.time = ros::SteadyTime::now();
  if (!plan_follower_) {
    ROS_ERROR_THROTTLE(kLogPeriod, "the robot stands: the controller cannot be used: %s", why_unusable_.c_str());
    return false;
  }
  if (!plan_follower_->hasPlan()) return stand(StopReason::kNoPlan, toString(StopReason::kNoPlan));
  return guarded([&] { return follow(&cmd_vel); },
                 [&](const std::string& why) { return stand(StopReason::kUnusableData, why); });
}

bool SteeringController::follow(geometry_msgs::Twist* cmd_vel) {
  try {
    const MotionCommand command = plan_follower_->compute();
    if (command.stop == StopReason::kStuck) {
      const std::string idle = plan_follower_->whyIdle();
      return stand(StopReason::kStuck,
                   plan_follower_->whatBlocks(toString(StopReason::kStuck)) + (idle.empty() ? "" : "; " + idle));
    }
    noteStop(command);
    cmd_vel->linear.x = command.linear;
    cmd_vel->angular.z = command.angular;
    return true;
  } catch (const OutdatedPlan& error) {
    return stand(StopReason::kOldPlan, error.what());
  }
}

bool SteeringController::stand(StopReason reason, const std::string& why) {
  answer_.command = {{}, reason};
  answer_.why = why;
  answer_.stopped_since = ros::SteadyTime();
  ROS_WARN_THROTTLE(kLogPeriod, "the robot stands: %s", why.c_str());
  return false;
}

void SteeringController::noteStop(const MotionCommand& command) {
  answer_.command = command;
  answer_.why.clear();
  if (command.stop == StopReason::kNone || command.stop == StopReason::kArrived) {
    answer_.stopped_since = ros::SteadyTime();
  } else if (answer_.stopped_since.isZero()) {
    answer_.stopped_since = answer_.time;
  } else if ((answer_.time - answer_.stopped_since).toSec() > kShortStop) {
    answer_.why = command.stop == StopReason::kIdle ? plan_follower_->whyIdle() : plan_follower_->whatBlocks("");
    const std::string reason = toString(command.stop) + (answer_.why.empty() ? "" : ": " + answer_.why);
    ROS_WARN_THROTTLE(kLogPeriod, "the robot stands: %s", reason.c_str());
  }
}

bool SteeringController::isGoalReached() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return guarded([&] { return plan_follower_ && plan_follower_->goalReached(); },
                 [](const std::string& why) {
                   ROS_WARN_THROTTLE(kLogPeriod, "it is not known whether the goal is reached: %s", why.c_str());
                   return false;
                 });
}

void SteeringController::startDiagnostics(const std::string& name) {
  if (diagnostics_) return;
  using Status = PluginDiagnostics::Status;
  diagnostics_ = std::make_unique<PluginDiagnostics>(
      name, &mutex_, [this](Status& status) { describeStop(&status); },
      [this](Status& status) { describeCommand(&status); });
  diagnostics_->addSensors([this] { return plan_follower_ ? &plan_follower_->sensors() : nullptr; });
  diagnostics_->start();
}

bool SteeringController::isAsked() const {
  return (ros::SteadyTime::now() - answer_.time).toSec() <= kControllerUnasked;
}

void SteeringController::describeStop(PluginDiagnostics::Status* status) const {
  using diagnostic_msgs::DiagnosticStatus;
  const MotionCommand& command = answer_.command;
  if (!plan_follower_) {
    status->summary(DiagnosticStatus::ERROR, "the controller cannot be used: " + why_unusable_);
  } else if (!isAsked()) {
    status->summary(DiagnosticStatus::OK,
                    "nobody asks for commands: there is no goal, or no plan to it, or move_base waits (see its log)");
  } else if (command.stop == StopReason::kNone || command.stop == StopReason::kArrived) {
    status->summary(DiagnosticStatus::OK, toString(command.stop));
  } else {
    const bool brakes = plan_follower_->speed() > kBraking;
    status->summary(DiagnosticStatus::WARN,
                    std::string(brakes ? "the robot brakes: " : "the robot stands: ") + toString(command.stop));
    if (!answer_.why.empty()) status->add("why", answer_.why);
  }
}

void SteeringController::describeCommand(PluginDiagnostics::Status* status) const {
  status->add("linear (m/s)", isAsked() ? answer_.command.linear : 0.0);
  status->add("angular (rad/s)", isAsked() ? answer_.command.angular : 0.0);
}

}  // namespace lstm_planner
