#pragma once

#include <string>

#include "network/onnx_node.hpp"

namespace lstm_planner::onnx {

/// Throws ModelFileError, naming `what`, unless at most one extent is larger than 1. One step of one robot is a vector
/// at every place of the graph, and then no operator that only changes the shape can change the order of the values.
void requireVector(const Shape& shape, const std::string& what);

/// Which of `rank` axes a number names, where negative ones count from the end. Throws ModelFileError for another one.
std::size_t axisIndex(const Node& node, std::int64_t axis, std::size_t rank);

/// What Squeeze, Unsqueeze, Reshape, Flatten and Transpose make of a vector's shape. Throw ModelFileError when the
/// operator does not fit the shape or the result is not a vector of the same size.
Shape shapeAfterSqueeze(Node& node, const Shape& shape);
Shape shapeAfterUnsqueeze(Node& node, const Shape& shape);
Shape shapeAfterReshape(Node& node, const Shape& shape);
Shape shapeAfterFlatten(Node& node, const Shape& shape);
Shape shapeAfterTranspose(Node& node, const Shape& shape);
/// Gather may only pick the one step that there is.
Shape shapeAfterGather(Node& node, const Shape& shape);

/// What a Slice takes of a value.
struct Part {
  Shape shape;
  std::int64_t first = 0;  ///< along the first axis
};
/// Throws ModelFileError when the slice is empty or takes not every value in between.
Part partOfSlice(Node& node, const Shape& shape, std::int64_t opset);

/// Throws ModelFileError unless Softmax normalises over all values of that shape.
void requireSoftmaxOverAll(Node& node, const Shape& shape, std::int64_t opset);

}  // namespace lstm_planner::onnx
