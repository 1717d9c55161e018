#pragma once

#include <cstdint>

#include "network/onnx_node.hpp"

namespace lstm_planner::onnx {

/// Exporters write how large an initial state is as nodes that compute on shapes. These run once, when the file is
/// read.

/// Whether an operator can be run on constants: Concat, ConstantOfShape, Expand, Gather, Identity, Slice, Squeeze,
/// Unsqueeze.
bool isFoldable(const std::string& operator_name);

/// What the node makes of its constants: whole numbers (a shape, at most 8), or floats that are all the same. Throws
/// ModelFileError for anything else, and for results of more than 65,536 values.
onnx_subset::TensorProto folded(Node& node, std::int64_t opset);

/// Whole numbers as a constant.
onnx_subset::TensorProto integerTensor(const std::vector<std::int64_t>& values, bool is_scalar = false);

}  // namespace lstm_planner::onnx
