#include "lstm_planner/ros/planner/lstm_global_planner.hpp"

#include <ros/console.h>
#include <ros/node_handle.h>

#include <exception>
#include <pluginlib/class_list_macros.hpp>

#include "lstm_planner/ros/common/costmap_footprint.hpp"
#include "lstm_planner/ros/common/costmap_reader.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/planner/plan_maker.hpp"

PLUGINLIB_EXPORT_CLASS(lstm_planner::LstmGlobalPlanner, nav_core::BaseGlobalPlanner)

namespace lstm_planner {

namespace {

constexpr double kLogPeriod = 2.0;  // s

void warnOfPlanningOnce() {
  const double frequency = ros::NodeHandle("~").param("planner_frequency", 0.0);
  if (frequency <= 0.0) {
    ROS_WARN(
        "%s/planner_frequency is 0: one plan a goal. This planner sees no farther than its scanner and needs to "
        "plan again while it drives; set it to 5",
        ros::this_node::getName().c_str());
  }
}

}  // namespace

LstmGlobalPlanner::LstmGlobalPlanner() = default;

// The costmap may be gone by now: nothing below may know it.
LstmGlobalPlanner::~LstmGlobalPlanner() = default;

void LstmGlobalPlanner::initialize(std::string name, costmap_2d::Costmap2DROS* costmap_ros) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (plan_maker_) {
    ROS_WARN("%s is already initialised, the second call is ignored", name.c_str());
    return;
  }
  if (costmap_ros == nullptr) {
    refuse(name, "it was initialised without a costmap");
    return;
  }
  try {
    GlobalPlannerParameters parameters = loadGlobalPlannerParameters(ros::NodeHandle("~/" + name));
    double& radius = parameters.agent.shield.footprint_radius;
    radius = safeFootprintRadius(*costmap_ros, radius, name + "/shield/footprint_radius");
    parameters.agent = fittedToFootprint(parameters.agent);
    warnOfPlanningOnce();
    plan_maker_ = std::make_unique<PlanMaker>(name, parameters, costmap_ros->getGlobalFrameID(),
                                              costmap_ros->getBaseFrameID(), costmap_ros);
    costmap_ = parameters.use_costmap ? costmap_ros : nullptr;
    ROS_INFO("%s plans in %s with the model %s", name.c_str(), costmap_ros->getGlobalFrameID().c_str(),
             parameters.model.c_str());
  } catch (const std::exception& error) {
    refuse(name, error.what());
  } catch (...) {
    refuse(name, "the reason is not known");
  }
}

void LstmGlobalPlanner::refuse(const std::string& name, const std::string& reason) {
  why_unusable_ = reason;
  ROS_FATAL("%s cannot be used: %s", name.c_str(), reason.c_str());
}

bool LstmGlobalPlanner::makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                                 std::vector<geometry_msgs::PoseStamped>& plan) {
  plan.clear();
  const CostmapLock costmap_lock(costmap_);
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    if (plan_maker_) {
      plan_maker_->makePlan(start, goal, &plan);
      return true;
    }
    ROS_ERROR_THROTTLE(kLogPeriod, "no plan: the planner cannot be used: %s", why_unusable_.c_str());
  } catch (const std::exception& error) {
    ROS_WARN_THROTTLE(kLogPeriod, "no plan: %s", error.what());
  } catch (...) {
    ROS_ERROR_THROTTLE(kLogPeriod, "no plan, for an unknown reason");
  }
  plan.clear();
  return false;
}

}  // namespace lstm_planner
