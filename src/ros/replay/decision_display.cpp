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

/// An arrow as three lines: all arrows of a kind fit into one marker.
void addArrow(const Pose2& pose, double angle, double length, double height, const std_msgs::ColorRGBA& color,
              Marker* lines) {
  constexpr double kHead = 0.4;       // of the length
  constexpr double kHeadAngle = 2.7;  // rad from the arrow's direction
  const double direction = pose.yaw + angle;
  const Point2 tip = pointAlong(pose, direction, length);
  const auto addLine = [&](const Point2& start, const Point2& end) {
    for (const Point2& position : {start, end}) {
      lines->points.push_back(makePoint(position, height));
      lines->colors.push_back(color);
    }
  };
  addLine({pose.x, pose.y}, tip);
  addLine(tip, pointAlong(tip, direction + kHeadAngle, kHead * length));
  addLine(tip, pointAlong(tip, direction - kHeadAngle, kHead * length));
}

}  // namespace

DriverMarkers::DriverMarkers(ros::NodeHandle node_handle)
    // Latched: whoever looks later sees all of the path, too.
    : publisher_(node_handle.advertise<visualization_msgs::MarkerArray>("driver", 1, true)) {
  markers_.markers = {markerOfWidth("path", Marker::LINE_LIST, 0.05, kDriverColor),
                      markerOfWidth("driven", Marker::LINE_LIST, 0.035, kDriverColor),
                      markerOfWidth("planned", Marker::LINE_LIST, 0.025, kSameColor),
                      markerOfWidth("agreement", Marker::TEXT_VIEW_FACING, 0.3, makeColor(0.1, 0.1, 0.1))};
}

void DriverMarkers::clear() {
  for (Marker& each : markers_.markers) {
    each.points.clear();
    each.colors.clear();
  }
}

void DriverMarkers::add(const ReplayedDecision& replayed, const std::string& frame) {
  const bool same = replayed.action == replayed.driven_action;
  ++steps_;
  agreed_ += same;
  for (const Pose2& pose : {replayed.pose, replayed.next_pose}) {
    markers_.markers[kPath].points.push_back(makePoint({pose.x, pose.y}, kTraceHeight));
  }
  addArrow(replayed.pose, replayed.driven_angle, kDrivenLength, kArrowHeight, kDriverColor, &markers_.markers[kDriven]);
  addArrow(replayed.pose, replayed.steering_angle, kPlannedLength, 1.5 * kArrowHeight, same ? kSameColor : kOtherColor,
           &markers_.markers[kPlanned]);

  Marker& text = markers_.markers[kAgreement];
  char line[80];
  std::snprintf(line, sizeof(line), "same angle at %ld of %ld steps", agreed_, steps_);
  text.text = line;
  text.pose.position = makePoint({replayed.pose.x, replayed.pose.y - kTextDistance}, kTextHeight);

  for (Marker& each : markers_.markers) {
    each.header.frame_id = frame;
    each.header.stamp = ros::Time(replayed.stamp);
  }
  publisher_.publish(markers_);
}

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
