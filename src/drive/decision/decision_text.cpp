#include "lstm_planner/drive/decision/decision_text.hpp"

#include <cmath>

#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {

namespace {

std::string metres(double value) { return fixedText(value, 2) + " m"; }

std::string describeAction(const Decision& decision, const std::string& leader) {
  std::string text = leader + " decided";
  if (decision.on_route) text += ", along the remembered path";
  if (!decision.on_route && decision.regret > 0.0) text += ", a detour of " + metres(decision.regret);
  if (decision.overruled == Overruled::kByShield) text += "; the shield removed what it preferred";
  return text;
}

std::string describeRoute(const Decision& decision) {
  const std::string text = "the remembered path decided";
  switch (decision.overruled) {
    case Overruled::kByShield:
      return text + ": the shield removed all steering angles";
    case Overruled::kByBound:
      if (!std::isfinite(decision.regret)) return text + ": no path leads on from where the leader would go";
      return text + ": the leader's detour of " + metres(decision.regret) + " would exceed the bound (" +
             metres(decision.regret_used) + " of " + metres(decision.regret_allowed) + " used)";
    case Overruled::kNo:
      break;
  }
  return text;
}

std::string describeStep(const Decision& decision) {
  switch (decision.choice.by) {
    case Leader::kNetwork:
      return describeAction(decision, "the network");
    case Leader::kGreedy:
      return describeAction(decision, "the bearing of the goal");
    case Leader::kRoute:
      return describeRoute(decision);
    case Leader::kEscape:
      return "the robot follows a boundary";
  }
  return "";
}

}  // namespace

std::string describe(const Decision& decision) {
  switch (decision.choice.move) {
    case Decision::Move::kStep:
      return describeStep(decision);
    case Decision::Move::kGoalInSight:
      return "the goal is in sight";
    case Decision::Move::kLookAround:
      return "the robot looks around";
    case Decision::Move::kArrived:
      return "the robot has arrived";
    case Decision::Move::kNoPath:
      return "there is no path to the goal";
  }
  return "";
}

}  // namespace lstm_planner
