#pragma once

#include <cstdint>

#include "network/onnx_node.hpp"

namespace lstm_planner::onnx {

/// Exporters write how large an initial state is, and how weights are to be cut, joined and turned, as nodes that
/// compute nothing new. These run once, when the file is read.

/// Whether an operator can be run on constants.
bool isFoldable(const std::string& operator_name);

/// Many nodes may share one stored tensor, so the size of the file is no limit to that of their results.
constexpr std::int64_t kMostFoldedValues = 1 << 20;

/// What the node makes of its constants, floats or whole numbers. `room` is how many values all results together may
/// still have, and is reduced. Throws ModelFileError where there is no room, and for what does not fit together.
onnx_subset::TensorProto folded(Node& node, std::int64_t opset, std::int64_t* room);

}  // namespace lstm_planner::onnx
