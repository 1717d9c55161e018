#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lstm_planner {

/// A diagnostic_msgs/DiagnosticStatus.
struct Report {
  int level = 0;  ///< 0 is good, 1 a warning, more an error
  std::string message;
  std::map<std::string, std::string> values;
};

/// A line of text, and how good it is.
struct ViewLine {
  int level = 0;  ///< as Report's
  std::string text;
};

/// One steering angle.
struct ViewAction {
  std::string name;      ///< such as "45° left"
  double share = 0.0;    ///< of the bar's length: 0 for the least preferred action, 1 for the most preferred one
  bool removed = false;  ///< by the shield
  bool chosen = false;
};

/// What the panel shows of a drive and its recording, made of what plugins and recorder publish. Times are s of any
/// clock that only goes forward. Knows neither Qt nor ROS.
class DriveView {
 public:
  /// What the planner published on `decision`, and the plugins on their `status`; nothing: it is not there (any more).
  void hearDecision(const Report& decision, double now);
  void setPlanner(const std::optional<Report>& status) { planner_ = status; }
  void setController(const std::optional<Report>& status) { controller_ = status; }
  void hearRecorder(const Report& status, double now);

  /// The network's file, without its folder.
  std::string model() const;
  /// Who leads and why, or why there is no plan. Where only decisions are published (bag_replay), by them.
  ViewLine leader(double now) const;
  /// Who decided the present step, and who overruled the leader.
  std::string decided(double now) const;
  /// How far the goal is, and where.
  std::string goal(double now) const;
  /// From left to right; empty where the network is not asked.
  std::vector<ViewAction> actions(double now) const;
  std::string removed(double now) const;
  /// Whether the robot drives, or why it stands.
  ViewLine controller() const;
  ViewLine recorder(double now) const;
  bool hasRecorder(double now) const;
  bool isPaused() const;

 private:
  const Report* freshDecision(double now) const;

  std::optional<Report> decision_;
  double decision_time_ = 0.0;
  std::optional<Report> planner_;
  std::optional<Report> controller_;
  std::optional<Report> recorder_;
  double recorder_time_ = 0.0;
};

}  // namespace lstm_planner
