#include "lstm_planner/ros/planner/marker_publisher.hpp"

#include <algorithm>
#include <cmath>

#include "lstm_planner/ros/planner/marker_shapes.hpp"

namespace lstm_planner {

namespace {

using visualization_msgs::Marker;

constexpr double kTraceSpacing = 0.05;  // m

/// Preferences are the network's last layer, whatever that is: only their order and distances mean something.
double shareOf(const std::vector<float>& preferences, std::size_t i) {
  const auto [least, most] = std::minmax_element(preferences.begin(), preferences.end());
  return *most > *least ? (preferences[i] - *least) / (*most - *least) : 1.0;
}

}  // namespace

MarkerPublisher::MarkerPublisher(ros::NodeHandle node_handle, const PolicyDescription& description, int trace_length)
    : description_(description),
      trace_length_(static_cast<std::size_t>(trace_length)),
      publisher_(node_handle.advertise<visualization_msgs::MarkerArray>("markers", 1)) {}

void MarkerPublisher::publish(const std_msgs::Header& header, const Situation& situation, const Decision& decision,
                              const Pose2& goal) {
  extendTrace(situation.pose);
  if (publisher_.getNumSubscribers() == 0) {
    return;
  }
  markers_.markers.clear();
  markers_.markers.push_back(
      makeSectorMarker(header, situation.pose, situation.sectors, description_.encoder.angle_span));
  addPreferences(header, situation, decision);
  addWaypoint(header, decision);
  markers_.markers.push_back(makeTraceMarker(header, "trace", trace_));
  addGoalMarkers(header, goal, &markers_);
  publisher_.publish(markers_);
}

void MarkerPublisher::extendTrace(const Pose2& pose) {
  if (trace_.empty() || distanceBetween(trace_.back(), pose) >= kTraceSpacing) {
    trace_.push_back({pose.x, pose.y});
  }
  while (trace_.size() > trace_length_) {
    trace_.pop_front();
  }
}

void MarkerPublisher::addPreferences(const std_msgs::Header& header, const Situation& situation,
                                     const Decision& decision) {
  constexpr double kShortest = 0.25;  // m
  constexpr double kLongest = 0.8;    // m
  for (std::size_t i = 0; i < decision.preferences.size(); ++i) {
    const int action = static_cast<int>(i);
    const bool chosen = action == decision.action;
    const auto shade = !decision.allowed[i] ? makeColor(0.5, 0.5, 0.5)
                                            : (chosen ? makeColor(1.0, 0.55, 0.0) : makeColor(0.1, 0.4, 0.9));
    Marker arrow = makeMarker(header, "preferences", action, Marker::ARROW, shade);
    const double length = kShortest + (kLongest - kShortest) * shareOf(decision.preferences, i);
    const double direction = situation.pose.yaw + description_.actions.angle(action);
    arrow.points = {makePoint({situation.pose.x, situation.pose.y}, kArrowHeight),
                    makePoint(pointAlong(situation.pose, direction, length), kArrowHeight)};
    arrow.scale.x = 0.03;
    arrow.scale.y = 0.08;
    arrow.scale.z = 0.1;
    markers_.markers.push_back(arrow);
  }
}

void MarkerPublisher::addWaypoint(const std_msgs::Header& header, const Decision& decision) {
  Marker sphere = makeMarker(header, "waypoint", 0, Marker::SPHERE, makeColor(1.0, 0.55, 0.0));
  sphere.pose.position = makePoint(decision.waypoint, kArrowHeight);
  sphere.scale.x = sphere.scale.y = sphere.scale.z = 0.14;
  markers_.markers.push_back(sphere);
}

}  // namespace lstm_planner
