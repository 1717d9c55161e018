#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/simulation/drive.hpp"

namespace lstm_planner {

/// What went on in the network during a drive.
class DriveStates {
 public:
  /// Notes each step of the agent from now on; both must outlive the drive.
  void watch(NavigationAgent* agent);

  /// Below the picture in the file `path`, which is replaced: a column a step, with the preferences among the steering
  /// angles as probabilities and the outputs of all recurrent cells. Throws std::runtime_error when the file cannot be
  /// read or written, std::invalid_argument when nothing was noted.
  void drawBelow(const std::string& path) const;

 private:
  struct Step {
    std::vector<float> preferences;
    Eigen::VectorXf hidden;
  };
  std::vector<Step> steps_;
};

}  // namespace lstm_planner
