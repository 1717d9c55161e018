#pragma once

#include <ros/node_handle.h>

#include <optional>
#include <string>
#include <vector>

namespace lstm_planner {

// What the value of a parameter means, whatever type YAML, roslaunch or a program gave it; nothing where it is
// something else. YAML takes 30 for a whole number, 1e-3 for a text, and [1, 2] for a list.

std::optional<double> asNumber(XmlRpc::XmlRpcValue value);
std::optional<int> asWholeNumber(XmlRpc::XmlRpcValue value);  ///< 2.0 is one, too
std::optional<bool> asTruth(XmlRpc::XmlRpcValue value);
std::optional<std::vector<double>> asNumbers(XmlRpc::XmlRpcValue value);  ///< a list, or a text with spaces
/// A text. Numbers, and lists of texts and numbers, as their text in YAML: "30.5", "[[1, 2], [3, 4]]".
std::optional<std::string> asText(XmlRpc::XmlRpcValue value);

}  // namespace lstm_planner
