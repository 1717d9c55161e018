#include "ros/panel/drive_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <locale>
#include <sstream>

namespace lstm_planner {
namespace {

constexpr double kDecisionLasts = 2.0;  // s; the planner is asked several times a second
constexpr double kRecorderLasts = 3.0;  // s; it says something every second

std::string valueOf(const std::string& key, const Report& report) {
  const auto found = report.values.find(key);
  return found == report.values.end() ? "" : found->second;
}

/// 0 where there is none. With a decimal point in every locale: rviz takes the user's, which may have a comma.
double numberIn(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double number = 0.0;
  stream >> number;
  return number;
}

double numberOf(const std::string& key, const Report& report) { return numberIn(valueOf(key, report)); }

std::vector<double> numbersOf(const std::string& key, const Report& report) {
  std::istringstream list(valueOf(key, report));
  std::vector<double> numbers;
  for (std::string text; std::getline(list, text, ',');) numbers.push_back(numberIn(text));
  return numbers;
}

std::string direction(double angle) {
  const long degrees = std::lround(angle * 180.0 / M_PI);
  if (degrees == 0) return "ahead";
  return std::to_string(std::abs(degrees)) + (degrees > 0 ? "° left" : "° right");
}

/// The message, with the reason where there is one.
ViewLine lineOf(const Report& report) {
  const std::string why = valueOf("why", report);
  return {report.level, report.message + (why.empty() ? "" : ": " + why)};
}

}  // namespace

void DriveView::hearDecision(const Report& decision, double now) {
  decision_ = decision;
  decision_time_ = now;
}

void DriveView::hearRecorder(const Report& status, double now) {
  recorder_ = status;
  recorder_time_ = now;
}

const Report* DriveView::freshDecision(double now) const {
  return decision_ && now - decision_time_ <= kDecisionLasts ? &*decision_ : nullptr;
}

std::string DriveView::model() const {
  const std::string path = planner_ ? valueOf("model", *planner_) : "";
  return path.substr(path.rfind('/') + 1);
}

ViewLine DriveView::leader(double now) const {
  if (planner_) return lineOf(*planner_);
  const Report* decision = freshDecision(now);
  if (decision == nullptr) return {0, "there is no planner"};
  return {decision->level, "the " + valueOf("leader", *decision) + " leads: " + valueOf("why", *decision)};
}

std::string DriveView::decided(double now) const {
  const Report* decision = freshDecision(now);
  return decision == nullptr ? "" : valueOf("what", *decision);
}

std::string DriveView::goal(double now) const {
  const Report* decision = freshDecision(now);
  if (decision == nullptr) return "";
  char distance[32];
  std::snprintf(distance, sizeof(distance), "%.2f m, ", numberOf("goal_distance", *decision));
  return distance + direction(numberOf("goal_bearing", *decision));
}

std::vector<ViewAction> DriveView::actions(double now) const {
  const Report* decision = freshDecision(now);
  // Preferences and the shield's word are of this moment only where the network chose, even if it was overruled.
  if (decision == nullptr || valueOf("leader", *decision) != "network") return {};
  if (decision->message != "network" && valueOf("overruled", *decision) != "by the bound") return {};
  const std::vector<double> angles = numbersOf("action_angles", *decision);
  const std::vector<double> preferences = numbersOf("preferences", *decision);
  const std::vector<double> allowed = numbersOf("allowed", *decision);
  if (angles.empty() || preferences.size() != angles.size() || allowed.size() != angles.size()) return {};
  const auto [least, most] = std::minmax_element(preferences.begin(), preferences.end());
  std::vector<ViewAction> actions;
  for (std::size_t i = angles.size(); i-- > 0;) {
    const double share = *most > *least ? (preferences[i] - *least) / (*most - *least) : 1.0;
    actions.push_back(
        {direction(angles[i]), share, allowed[i] == 0.0, numberOf("action", *decision) == static_cast<double>(i)});
  }
  return actions;
}

std::string DriveView::removed(double now) const {
  if (freshDecision(now) == nullptr) return "";
  const std::vector<ViewAction> all = actions(now);
  if (all.empty()) return "the network is not asked";
  std::string names;
  for (const ViewAction& action : all) {
    if (action.removed) names += (names.empty() ? "" : ", ") + action.name;
  }
  return names.empty() ? "nothing" : names;
}

ViewLine DriveView::controller() const {
  return controller_ ? lineOf(*controller_) : ViewLine{0, "there is no controller"};
}

bool DriveView::hasRecorder(double now) const { return recorder_ && now - recorder_time_ <= kRecorderLasts; }

bool DriveView::isPaused() const { return recorder_ && valueOf("paused", *recorder_) == "yes"; }

ViewLine DriveView::recorder(double now) const {
  if (!hasRecorder(now)) return {0, "nothing is recorded"};
  return {recorder_->level, recorder_->message + " (steps: " + valueOf("steps", *recorder_) +
                                ", episodes: " + valueOf("episodes", *recorder_) + ")"};
}

}  // namespace lstm_planner
