#pragma once

#include <cstddef>
#include <string>
#include <type_traits>

#include "lstm_planner/dataset/drive_step.hpp"

namespace lstm_planner {

/// Calls visit(name, unit, quantity) for everything that a step consists of, except its number, scan and geometry. A
/// quantity is a double, an int, a Point2, a Pose2, a Twist2 or an array of eight; `Step` is DriveStep, const or not.
template <typename Step, typename Visit>
void visitQuantities(Step& step, Visit&& visit) {
  visit("stamp", "s", step.stamp);
  visit("next_stamp", "s", step.next_stamp);
  visit("pose", "m", step.pose);
  visit("next_pose", "m", step.next_pose);
  visit("twist", "m/s", step.twist);
  visit("goal", "m", step.goal);
  visit("sector_range", "m", step.observation.sector_ranges);
  visit("minimum_range", "m", step.minimum_ranges);
  visit("beams", "", step.beams);
  visit("measured", "", step.measured);
  visit("goal_distance", "m", step.observation.goal_distance);
  visit("goal_bearing", "rad", step.observation.goal_bearing);
  visit("heading", "rad", step.observation.heading);
  visit("previous_action", "rad", step.observation.previous_action);
  visit("route_bearing", "rad", step.observation.route_bearing);
  visit("route_length", "m", step.observation.route_length);
  visit("visits", "", step.observation.visits);
  visit("driven_angle", "rad", step.driven_angle);
  visit("label", "", step.label);
}

/// Calls visit(column, unit, number) for each number of a quantity: the columns of table steps and of CSV files.
template <typename Quantity, typename Visit>
void visitNumbers(const std::string& name, [[maybe_unused]] const char* unit, Quantity& quantity, Visit&& visit) {
  using Plain = std::remove_const_t<Quantity>;
  if constexpr (std::is_arithmetic_v<Plain>) {
    visit(name, unit, quantity);
  } else if constexpr (std::is_same_v<Plain, Twist2>) {
    visit(name + "_linear", "m/s", quantity.linear);
    visit(name + "_angular", "rad/s", quantity.angular);
  } else if constexpr (std::is_same_v<Plain, Point2> || std::is_same_v<Plain, Pose2>) {
    visit(name + "_x", unit, quantity.x);
    visit(name + "_y", unit, quantity.y);
    if constexpr (std::is_same_v<Plain, Pose2>) visit(name + "_yaw", "rad", quantity.yaw);
  } else {
    for (std::size_t i = 0; i < quantity.size(); ++i) visit(name + "_" + std::to_string(i), unit, quantity[i]);
  }
}

template <typename Step, typename Visit>
void visitColumns(Step& step, Visit&& visit) {
  visitQuantities(step, [&](const std::string& name, const char* unit, auto& quantity) {
    visitNumbers(name, unit, quantity, visit);
  });
}

}  // namespace lstm_planner
