#pragma once

#include <stdexcept>
#include <string>

namespace lstm_planner {

/// There is no usable reading of a sensor; what() says of which one, and why.
class SensorError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What is wrong with a message that is `age` s old, by its stamp, where at most `timeout` s are allowed: the rest of a
/// sentence that starts with "... is"; empty when nothing is. Stamps further than `timeout` in the future are refused,
/// too. `parameter`: the name of the parameter that holds the timeout.
std::string ageProblem(double age, double timeout, const std::string& parameter);

/// The same as a sentence about the newest message on `topic`. `silence`: s since it was received, negative where the
/// clock was set back since.
std::string messageProblem(double age, double silence, double timeout, const std::string& topic,
                           const std::string& parameter);

}  // namespace lstm_planner
