#pragma once

#include <string>
#include <vector>

#include "lstm_planner/drive/decision/agent_parameters.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "lstm_planner/drive/motion/rollout.hpp"
#include "lstm_planner/drive/perception/scan_rules.hpp"

namespace lstm_planner {

/// Where scan and odometry come from, and when they are not believed.
struct SensorParameters {
  std::string scan_topic = "scan";
  std::string second_scan_topic = "";
  std::string odom_topic = "odom";
  double scan_timeout = 0.0;
  double odom_timeout = 0.0;
  double tf_timeout = 0.5;
  double max_speed = 1.0;
  ScanRules scan_rules;  ///< what the scanner's readings mean

  // No parameters: the least timeouts, s, where they follow the sensors' periods.
  double least_scan_timeout = 0.5;
  double least_odom_timeout = 0.5;
};

/// Parameters of LstmGlobalPlanner, in "~/LstmGlobalPlanner"; config/lstm_planner.yaml explains each.
struct GlobalPlannerParameters {
  std::string model = "package://lstm_planner/models/create2_lstm.onnx";
  SensorParameters sensors;
  AgentParameters agent;
  RolloutParameters rollout;
  bool use_costmap = true;
  int trace_length = 2000;
};

/// Parameters of SteeringController, in "~/SteeringController"; config/steering_controller.yaml explains each.
struct SteeringControllerParameters {
  SensorParameters sensors = {"scan", "", "odom", 0.0, 0.0, 0.3, 1.0, {}, 0.2, 0.3};
  MotionParameters motion;
  double plan_timeout = 2.0;
  double footprint_radius = 0.17425;
  std::string footprint = "";
  bool use_costmap = true;
  double controller_frequency = 20.0;  ///< Hz, how often move_base asks for a command
};

// All visit every parameter; see parameter_visitors.hpp.

template <typename Parameters, typename Visitor>
void visitSensorParameters(Parameters& sensors, const Visitor& visit) {
  visit("scan_topic", sensors.scan_topic, {}, "", "sensor_msgs/LaserScan");
  visit("second_scan_topic", sensors.second_scan_topic, {}, "",
        "sensor_msgs/LaserScan of a second scanner, which may look anywhere; the robot stands without it; empty: there "
        "is none");
  visit("odom_topic", sensors.odom_topic, {}, "", "nav_msgs/Odometry");
  visit("scan_timeout", sensors.scan_timeout, {0.0, 60.0}, "s",
        "an older scan is not used; 0: three measured periods, at least 0.5 s (planner) or 0.2 s (controller), at most "
        "1 s; shorter stops sooner when the scanner fails");
  visit("odom_timeout", sensors.odom_timeout, {0.0, 60.0}, "s",
        "an older odometry is not used; 0: three measured periods, at least 0.5 s (planner) or 0.3 s (controller), at "
        "most 1 s");
  visit("tf_timeout", sensors.tf_timeout, {0.0, 60.0}, "s",
        "an older transform between odometry, goal and costmap frames is not used; 0: any age is accepted");
  visit("max_speed", sensors.max_speed, {0.01, 100.0}, "m/s",
        "odometry that moves faster has jumped; well above the robot's own speed");
  visitScanRules(sensors.scan_rules, visit);
}

template <typename Parameters, typename Visitor>
void visitGlobalPlannerParameters(Parameters& planner, const Visitor& visit) {
  visit("model", planner.model, {}, "", "file of the network: a path, or package://NAME/PATH");
  visitSensorParameters(planner.sensors, visit);
  visitAgentParameters(planner.agent, visit);
  visitRolloutParameters(planner.rollout, visit);
  visit("use_costmap", planner.use_costmap, {}, "",
        "use obstacles of move_base's costmap that the scan does not show, too");
  visit("trace_length", planner.trace_length, {0, 100000}, "", "number of poses of the trace in the markers");
}

template <typename Parameters, typename Visitor>
void visitSteeringControllerParameters(Parameters& controller, const Visitor& visit) {
  visitSensorParameters(controller.sensors, visit);
  visitMotionParameters(controller.motion, visit);
  visit("plan_timeout", controller.plan_timeout, {0.0, 3600.0}, "s",
        "the robot stops when the plan is older; several periods of the planner; 0: never");
  visit("footprint_radius", controller.footprint_radius, {0.02, 5.0}, "m",
        "radius of the circle around all parts of the robot; larger keeps more distance and fits through fewer gaps");
  visit("footprint", controller.footprint, {}, "m",
        "corners [[x, y], ...] of a robot that is not round, in place of footprint_radius; empty: it is round");
  visit("use_costmap", controller.use_costmap, {}, "",
        "use obstacles of move_base's costmap that the scan does not show, too");
}

/// Throw std::invalid_argument naming the parameter, its value and what was expected.
void validate(const GlobalPlannerParameters& parameters);
void validate(const SteeringControllerParameters& parameters);

/// Of the controller's shield. Throws std::invalid_argument as footprintOf() for two parameters.
Footprint footprintOf(const SteeringControllerParameters& parameters);

/// Names of those that may change while the robot drives.
std::vector<std::string> changeableGlobalPlannerParameters();
std::vector<std::string> changeableSteeringControllerParameters();

/// The end of a sentence about a parameter that is none of `names`: "; here it is named NAME" where the navigation
/// stack's local planners call one of them so, otherwise as hintAt().
std::string hintAtParameter(const std::string& name, const std::vector<std::string>& names);

}  // namespace lstm_planner
