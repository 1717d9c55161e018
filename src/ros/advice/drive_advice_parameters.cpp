#include <utility>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/ros/advice/drive_advice.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"

namespace lstm_planner {

DriveAdviceParameters loadDriveAdviceParameters(const ros::NodeHandle& private_node) {
  DriveAdviceParameters parameters;
  ParameterReader reader(private_node);
  visitDriveAdviceParameters(parameters, reader.visitor());
  // A robot's file (config/robots) is for move_base and the simulation, too.
  for (const char* group :
       {"LstmGlobalPlanner", "SteeringController", "global_costmap", "local_costmap", "create2_stub"}) {
    reader.knowGroup(group);
  }
  reader.warnOfUnknown();
  visitDriveAdviceParameters(std::as_const(parameters), RangeCheck());
  parameters.planner = loadGlobalPlannerParameters(ros::NodeHandle(private_node, "LstmGlobalPlanner"));
  return parameters;
}

}  // namespace lstm_planner
