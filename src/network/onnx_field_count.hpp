#pragma once

#include <string>

namespace lstm_planner::onnx {

/// Throws ModelFileError when a serialised model has more fields and packed integers than any network of the largest
/// size that is read: an empty node takes two bytes in the file and seventy times as much in the memory. What is no
/// protobuf is left to the parser to refuse.
void checkFieldCount(const std::string& bytes);

}  // namespace lstm_planner::onnx
