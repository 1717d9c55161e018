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

std::string messageProblem(double age, double silence, double timeout, const std::string& topic,
                           const std::string& parameter) {
  const std::string problem = ageProblem(age, timeout, parameter);
  if (problem.empty()) return "";
  if (silence < -timeout) {
    return "the clock was set back by at least " + fixedText(-silence, 3) + " s since the newest message on " + topic +
           " came: there is no new one yet";
  }
  const bool has_just_come = age > timeout && silence <= timeout;
  return "the newest message on " + topic + " is " + problem +
         (has_just_come ? ", although it has just come: the network is slow, or the clocks differ (NTP)" : "");
}

}  // namespace lstm_planner
