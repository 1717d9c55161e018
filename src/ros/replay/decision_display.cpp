#include "lstm_planner/ros/replay/decision_display.hpp"

#include <cstdio>

#include "lstm_planner/ros/planner/marker_shapes.hpp"

namespace lstm_planner {

namespace {

using visualization_msgs::Marker;

constexpr double kTextDistance = 1.2;  // m from the robot
constexpr double kTextHeight = 0.2;    // m above the floor
constexpr double kDrivenLength = 0.3;  // m of the arrows; the driver's is the longer and thicker one, so that it shows
constexpr double kPlannedLength = 0.22;  // beneath a planner's that points the same way

enum Index { kPath, kDriven, kPlanned, kAgreement };

const std_msgs::ColorRGBA kDriverColor = makeColor(0.1, 0.35, 0.85);
const std_msgs::ColorRGBA kSameColor = makeColor(0.0, 0.65, 0.1);
const std_msgs::ColorRGBA kOtherColor = makeColor(0.9, 0.0, 0.0);

Marker markerOfWidth(const std::string& name_space, int type, double width, const std_msgs::ColorRGBA& color) {
  Marker result = makeMarker({}, name_space, 0, type, color);
  result.scale.x = result.scale.z = width;
  return result;
}

}  // namespace

DecisionDisplay::DecisionDisplay(const PolicyDescription& description)
    // The path is the driver's here, and has markers of its own.
    : markers_(ros::NodeHandle("~/LstmGlobalPlanner"), description, 0),
      decisions_(ros::NodeHandle("~/LstmGlobalPlanner"), description.actions),
      // Latched: whoever looks later sees all of the path, too.
      driver_publisher_(ros::NodeHandle("~").advertise<visualization_msgs::MarkerArray>("driver", 1, true)) {
  driver_markers_.markers = {markerOfWidth("path", Marker::LINE_LIST, 0.05, kDriverColor),
                             markerOfWidth("driven", Marker::LINE_LIST, 0.035, kDriverColor),
                             markerOfWidth("planned", Marker::LINE_LIST, 0.025, kSameColor),
                             markerOfWidth("agreement", Marker::TEXT_VIEW_FACING, 0.3, makeColor(0.1, 0.1, 0.1))};
}

void DecisionDisplay::clearPath() {
  for (Marker& each : driver_markers_.markers) {
    each.points.clear();
    each.colors.clear();
  }
}

bool DecisionDisplay::isListenedTo() const {
  return markers_.isListenedTo() || decisions_.isListenedTo() || driver_publisher_.getNumSubscribers() > 0;
}

void DecisionDisplay::showDriver(const ReplayedDecision& replayed, const std::string& frame) {
  std::vector<Marker>& markers = driver_markers_.markers;
  const bool same = replayed.action == replayed.driven_action;
  ++steps_;
  agreed_ += same;
  for (const Pose2& pose : {replayed.pose, replayed.next_pose}) {
    markers[kPath].points.push_back(makePoint({pose.x, pose.y}, kTraceHeight));
  }
  addArrow(replayed.pose, replayed.driven_angle, kDrivenLength, kArrowHeight, kDriverColor, &markers[kDriven]);
  addArrow(replayed.pose, replayed.steering_angle, kPlannedLength, 1.5 * kArrowHeight, same ? kSameColor : kOtherColor,
           &markers[kPlanned]);

  Marker& text = markers[kAgreement];
  char line[80];
  std::snprintf(line, sizeof(line), "same angle at %ld of %ld steps", agreed_, steps_);
  text.text = line;
  text.pose.position = makePoint({replayed.pose.x, replayed.pose.y - kTextDistance}, kTextHeight);

  for (Marker& each : markers) {
    each.header.frame_id = frame;
    each.header.stamp = ros::Time(replayed.stamp);
  }
  driver_publisher_.publish(driver_markers_);
}

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
