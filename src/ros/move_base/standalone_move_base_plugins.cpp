#include "ros/move_base/standalone_move_base_plugins.hpp"

#include <ros/ros.h>

#include <stdexcept>

#include "ros/common/arrival_teller.hpp"
#include "ros/common/guarded.hpp"

namespace lstm_planner {
namespace {

// There is no package nav_core that plugins could be exported to; package.xml exports them to this one as well.
constexpr char kExportingPackage[] = "lstm_planner";
constexpr double kErrorPeriod = 1.0;  // s

template <typename Base>
pluginlib::UniquePtr<Base> load(pluginlib::ClassLoader<Base>& loader, const std::string& name,
                                const std::string& parameter) {
  try {
    return loader.createUniqueInstance(name);
  } catch (const pluginlib::PluginlibException& exception) {
    std::string declared;
    for (const std::string& other : loader.getDeclaredClasses()) declared += " " + other;
    throw std::runtime_error("parameter " + parameter + ": cannot load plugin '" + name + "' (declared:" + declared +
                             "): " + exception.what());
  }
}

/// What a plugin answers; false where it throws.
template <typename Call>
bool answerOf(const char* plugin, const Call& call) {
  return guarded(call, [plugin](const std::string& why) {
    ROS_ERROR_THROTTLE(kErrorPeriod, "%s has thrown: %s", plugin, why.c_str());
    return false;
  });
}

}  // namespace

HostedPlugins::HostedPlugins(const std::string& global_planner, const std::string& local_planner, tf2_ros::Buffer& tf)
    : planner_loader_(kExportingPackage, "nav_core::BaseGlobalPlanner"),
      controller_loader_(kExportingPackage, "nav_core::BaseLocalPlanner"),
      planner_costmap_("global_costmap", tf),
      controller_costmap_("local_costmap", tf),
      planner_(load(planner_loader_, global_planner, "base_global_planner")),
      controller_(load(controller_loader_, local_planner, "base_local_planner")) {
  planner_->initialize(planner_loader_.getName(global_planner), &planner_costmap_);
  controller_->initialize(controller_loader_.getName(local_planner), &tf, &controller_costmap_);
}

bool HostedPlugins::makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                             Plan& plan) {
  const std::lock_guard<std::mutex> lock(planner_mutex_);
  plan.clear();
  return answerOf("The global planner", [&] { return planner_->makePlan(start, goal, plan) && !plan.empty(); });
}

std::string HostedPlugins::besideGoal() {
  auto* teller = dynamic_cast<ArrivalTeller*>(planner_.get());
  return teller != nullptr ? teller->besideGoal() : "";
}

bool HostedPlugins::setPlan(const Plan& plan) {
  return answerOf("The controller", [&] { return controller_->setPlan(plan); });
}

bool HostedPlugins::computeVelocity(geometry_msgs::Twist& velocity) {
  return answerOf("The controller", [&] { return controller_->computeVelocityCommands(velocity); });
}

bool HostedPlugins::isGoalReached() {
  return answerOf("The controller", [&] { return controller_->isGoalReached(); });
}

}  // namespace lstm_planner
