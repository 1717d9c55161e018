#include "lstm_planner/drive/perception/message_age.hpp"

#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {

std::string ageProblem(double age, double timeout, const std::string& parameter) {
  const std::string allowed = parameter + " = " + numberText(timeout) + " s";
  if (age > timeout) return fixedText(age, 3) + " s old, allowed are " + allowed;
  if (age < -timeout) {
    return "stamped " + fixedText(-age, 3) + " s in the future, allowed are " + allowed + ": the clocks differ (NTP)";
  }
  return "";
}

void checkAge(double age, double silence, double timeout, const std::string& topic, const std::string& parameter) {
  std::string problem = ageProblem(age, timeout, parameter);
  if (problem.empty()) return;
  if (age > timeout && silence <= timeout) {
    problem += ", although it has just come: the network is slow, or the clocks differ (NTP)";
  }
  throw SensorError("the newest message on " + topic + " is " + problem);
}

}  // namespace lstm_planner
