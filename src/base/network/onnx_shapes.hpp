#pragma once

#include <string>

#include "base/network/onnx_node.hpp"

namespace lstm_planner::onnx {

/// Throws ModelFileError, naming `what`, unless at most one extent is larger than 1. One step of one robot is a vector
/// at every place of the graph, and then no operator that only changes the shape can change the order of the values.
void requireVector(const Shape& shape, const std::string& what);

/// What Identity, Squeeze, Unsqueeze, Reshape and Transpose make of a vector's shape. Throw ModelFileError when the
/// operator does not fit the shape or the result is not a vector of the same size.
Shape shapeAfterSqueeze(Node& node, const Shape& shape);
Shape shapeAfterUnsqueeze(Node& node, const Shape& shape);
Shape shapeAfterReshape(Node& node, const Shape& shape);
Shape shapeAfterTranspose(Node& node, const Shape& shape);

/// Throws ModelFileError unless Softmax normalises over all values of that shape.
void requireSoftmaxOverAll(Node& node, const Shape& shape, std::int64_t opset);

}  // namespace lstm_planner::onnx
