#pragma once

#include <string>
#include <vector>

#include "network/onnx_node.hpp"

namespace lstm_planner::onnx {

/// Throws ModelFileError, naming `what`, unless at most one extent is larger than 1. One step of one robot is a vector
/// at every place of the graph, and then no operator that only changes the shape can change the order of the values.
void requireVector(const Shape& shape, const std::string& what);

/// Which of `rank` axes a number names, where negative ones count from the end. Throws ModelFileError for another one.
std::size_t axisIndex(const Node& node, std::int64_t axis, std::size_t rank);

/// Which values, in which shape, an operator that computes nothing makes of a tensor: Expand, Flatten, Gather (of one
/// place), Identity, Reshape, Slice (of every value in between), Squeeze, Transpose, Unsqueeze. Throws ModelFileError
/// when the operator does not fit the shape.
View viewAfter(Node& node, const Shape& shape, std::int64_t opset);

/// What Concat makes of tensors of these shapes, one or more. Throws ModelFileError when they do not fit together.
Shape shapeAfterConcat(Node& node, const std::vector<Shape>& shapes);

/// Throws ModelFileError unless Softmax normalises over all values of that shape.
void requireSoftmaxOverAll(Node& node, const Shape& shape, std::int64_t opset);

}  // namespace lstm_planner::onnx
