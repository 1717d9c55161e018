#include <stdexcept>

#include "tools/command.hpp"

// What the files of src/tools/with_ros do in a build that has ROS.

namespace lstm_planner {
namespace {

[[noreturn]] void refuse(const std::string& instead) {
  throw std::invalid_argument("this lstm_planner was built without ROS (LSTM_PLANNER_WITH_ROS=OFF); " + instead);
}

}  // namespace

int datasetFromBag(const std::vector<std::string>&) { refuse("a build with ROS reads bags"); }

int runParameters(const std::vector<std::string>&) {
  refuse("config/parameters.md lists the parameters of plugins and nodes");
}

}  // namespace lstm_planner
