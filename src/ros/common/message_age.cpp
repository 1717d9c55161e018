#include "ros/common/message_age.hpp"

namespace lstm_planner {

std::string ageProblem(double age, double timeout, const std::string& parameter) {
  const std::string allowed = parameter + " = " + std::to_string(timeout) + " s";
  if (age > timeout) return std::to_string(age) + " s old, allowed are " + allowed;
  if (age < -timeout) {
    return "stamped " + std::to_string(-age) + " s in the future, allowed are " + allowed + ": the clocks differ (NTP)";
  }
  return "";
}

}  // namespace lstm_planner
