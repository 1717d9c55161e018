#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <std_msgs/Header.h>

#include <string>

#include "lstm_planner/drive/decision/action_set.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"

namespace lstm_planner {

/// Publishes each decision and where it came from as diagnostic_msgs/DiagnosticArray on `decision`.
///
/// One status, whose message is the decision's source; a warning while the robot looks around or follows a
/// boundary, an error when there is no path. Values: what (a sentence: describe()), leader, why (it leads), step,
/// goal_distance (m), goal_bearing (rad from the heading), action (its index, -1 for none), preferred (the network's
/// favourite, -1 when none is asked), overruled (no, by the shield, by the bound), on_remembered_path (yes or no),
/// regret, regret_used and regret_allowed (m: DetourBound), steering_angle (rad from the heading), route_points (how
/// many), destination (x, y in m), goal_seems, preferences, allowed, action_angles (rad, those of the actions).
class DecisionPublisher {
 public:
  DecisionPublisher(ros::NodeHandle node_handle, const ActionSet& actions);

  /// `header`: time, and the frame of poses and goal. Cheap while nobody listens.
  void publish(const std_msgs::Header& header, const Situation& situation, const Decision& decision, const Pose2& goal);

  bool isListenedTo() const { return publisher_.getNumSubscribers() > 0; }

 private:
  std::string action_angles_;
  ros::Publisher publisher_;
};

}  // namespace lstm_planner
