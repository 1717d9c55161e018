#include "lstm_planner/ros/planner/decision_publisher.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <sstream>

#include "lstm_planner/drive/decision/decision_text.hpp"

namespace lstm_planner {

namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr int kDecisionQueue = 1000;  // a recording that is replayed as fast as possible has many decisions at a time

template <typename T>
std::string listText(const std::vector<T>& values) {
  std::ostringstream stream;
  for (std::size_t i = 0; i < values.size(); ++i) {
    stream << (i == 0 ? "" : ", ") << +values[i];
  }
  return stream.str();
}

unsigned char levelOf(const Decision& decision) {
  using Move = Decision::Move;
  if (decision.choice == Move::kNoPath) return DiagnosticStatus::ERROR;
  const bool is_odd = decision.choice == Move::kLookAround || decision.choice == Leader::kEscape;
  return is_odd ? DiagnosticStatus::WARN : DiagnosticStatus::OK;
}

}  // namespace

DecisionPublisher::DecisionPublisher(ros::NodeHandle node_handle, const ActionSet& actions)
    : action_angles_(listText(actions.angles())),
      publisher_(node_handle.advertise<diagnostic_msgs::DiagnosticArray>("decision", kDecisionQueue)) {}

void DecisionPublisher::publish(const std_msgs::Header& header, const Situation& situation, const Decision& decision,
                                const Pose2& goal) {
  if (publisher_.getNumSubscribers() == 0) {
    return;
  }
  diagnostic_updater::DiagnosticStatusWrapper status;
  status.name = "lstm_planner: decision";
  status.summary(levelOf(decision), toString(decision.choice));
  status.add("what", describe(decision));
  status.add("leader", toString(decision.leader));
  status.add("why", decision.why);
  status.add("step", decision.step);
  status.add("goal_distance", distanceBetween(situation.pose, goal));
  status.add("goal_bearing", normalizeAngle(directionTo(situation.pose, goal) - situation.pose.yaw));
  status.add("action", decision.action);
  status.add("preferred", decision.preferred);
  status.add("overruled", toString(decision.overruled));
  status.add("on_remembered_path", decision.on_route ? "yes" : "no");
  status.add("regret", decision.regret);
  status.add("regret_used", decision.regret_used);
  status.add("regret_allowed", decision.regret_allowed);
  status.add("steering_angle", normalizeAngle(decision.direction - situation.pose.yaw));
  status.add("route_points", decision.path_on.size());
  status.add("destination", listText(std::vector<double>{decision.destination.x, decision.destination.y}));
  status.add("goal_seems", toString(decision.goal_seems));
  status.add("preferences", listText(decision.preferences));
  status.add("allowed", listText(decision.allowed));
  status.add("action_angles", action_angles_);
  diagnostic_msgs::DiagnosticArray message;
  message.header = header;
  message.status.push_back(status);
  publisher_.publish(message);
}

}  // namespace lstm_planner
