#pragma once

#include <rosbag/view.h>

#include <string>
#include <vector>

#include "lstm_planner/ros/recorder/bag_drive.hpp"

namespace lstm_planner {

/// Only rosbag record always writes the slash in front: programs that write bags may leave it out.
std::string absoluteTopic(const std::string& name);

/// Which of a bag's topics are listened to, as the bag calls them.
struct BagTopics {
  std::string scan;
  std::string odometry;           ///< empty: from tf
  std::string transforms;         ///< empty: there are none
  std::string static_transforms;  ///< empty: there are none
  std::vector<std::string> goals;
  std::vector<std::string> ends;  ///< cancels and results

  std::vector<std::string> all() const;
};

/// `view`: of all messages. Throws std::invalid_argument, without the bag's name, where there is none or several to
/// choose from.
BagTopics chooseTopics(rosbag::View* view, const BagDriveOptions& options);

}  // namespace lstm_planner
