#pragma once

#include <nav_core/base_global_planner.h>
#include <nav_core/base_local_planner.h>
#include <ros/package.h>

#include <memory>
#include <pluginlib/class_loader.hpp>
#include <string>

namespace lstm_planner {

using PlannerLoader = pluginlib::ClassLoader<nav_core::BaseGlobalPlanner>;
using ControllerLoader = pluginlib::ClassLoader<nav_core::BaseLocalPlanner>;

/// The package that exports the plugins' interfaces: the navigation stack's, or this one in its place.
inline std::string interfacePackage() {
  return ros::package::getPath("nav_core").empty() ? "lstm_planner" : "nav_core";
}

/// As move_base makes them.
inline std::unique_ptr<PlannerLoader> plannerLoader() {
  return std::make_unique<PlannerLoader>(interfacePackage(), "nav_core::BaseGlobalPlanner");
}
inline std::unique_ptr<ControllerLoader> controllerLoader() {
  return std::make_unique<ControllerLoader>(interfacePackage(), "nav_core::BaseLocalPlanner");
}

}  // namespace lstm_planner
