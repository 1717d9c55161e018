#include "ros/planner/arrival_publisher.hpp"

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <iomanip>
#include <sstream>

#include "lstm_planner/drive/decision/arrival.hpp"

namespace lstm_planner {

namespace {

using diagnostic_msgs::DiagnosticStatus;

unsigned char levelOf(const DriveEnd& end) {
  if (!end.is_arrival) return DiagnosticStatus::ERROR;
  return end.is_beside ? DiagnosticStatus::WARN : DiagnosticStatus::OK;
}

}  // namespace

std::string DriveEnd::text() const {
  if (is_beside) {
    return besideGoalText(distance) + ": this " + (is_arrival ? "counts" : "does not count") +
           " as arrived (arrive_beside_goal)";
  }
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << "stopped " << distance << " m from the goal";
  return text.str();
}

ArrivalPublisher::ArrivalPublisher(ros::NodeHandle node_handle)
    : publisher_(node_handle.advertise<DiagnosticStatus>("arrival", 1, true)) {}

void ArrivalPublisher::publish(const DriveEnd& end, const std::string& frame) {
  diagnostic_updater::DiagnosticStatusWrapper status;
  status.name = "lstm_planner: arrival";
  status.summary(levelOf(end), end.text());
  status.add("frame", frame);
  status.add("goal", std::to_string(end.goal.x) + ", " + std::to_string(end.goal.y));
  status.add("distance", end.distance);
  status.add("beside_goal", end.is_beside ? "true" : "false");
  status.add("arrived", end.is_arrival ? "true" : "false");
  publisher_.publish(static_cast<const DiagnosticStatus&>(status));
}

}  // namespace lstm_planner
