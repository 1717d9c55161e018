#include "lstm_planner/ros/replay/decision_display.hpp"

namespace lstm_planner {

DecisionDisplay::DecisionDisplay(const PolicyDescription& description)
    // The path is the driver's here, and DriverMarkers shows it.
    : markers_(ros::NodeHandle("~/LstmGlobalPlanner"), description, 0),
      decisions_(ros::NodeHandle("~/LstmGlobalPlanner"), description.actions),
      driver_(ros::NodeHandle("~")) {}

void DecisionDisplay::showAdvice(const ReplayedDecision& replayed, const std::string& frame) {
  std_msgs::Header header;
  header.frame_id = frame;
  header.stamp = ros::Time(replayed.stamp);
  Situation situation;
  situation.time = replayed.stamp;
  situation.pose = replayed.pose;
  situation.sectors = replayed.sectors;
  markers_.publish(header, situation, replayed.decision, replayed.goal);
  decisions_.publish(header, situation, replayed.decision, replayed.goal);
}

}  // namespace lstm_planner
