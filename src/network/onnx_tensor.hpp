#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "onnx_subset.pb.h"

namespace lstm_planner::onnx {

/// Extent of a tensor along each axis, outermost first.
using Shape = std::vector<std::int64_t>;

/// A name out of a file in quotes, made short and printable for a message.
std::string quoted(const std::string& name);

/// For messages: "[1, 32, 11]".
std::string shapeText(const Shape& shape);

/// Number of values in a tensor of that shape. Throws ModelFileError, naming `what`, when an extent is not positive or
/// the number is larger than any network of ours could have.
std::int64_t elementCount(const Shape& shape, const std::string& what);

/// Shape of a stored tensor. Throws ModelFileError as elementCount does.
Shape shapeOf(const onnx_subset::TensorProto& tensor);

/// All values of a float tensor, in row-major order. Throws ModelFileError when it is of another type, its data do not
/// fit its shape, are stored in another file or not finite.
std::vector<float> floatValues(const onnx_subset::TensorProto& tensor);

/// All values of an int64 or int32 tensor (axes, a target shape); the same rules.
std::vector<std::int64_t> integerValues(const onnx_subset::TensorProto& tensor);

/// The first rows * columns values as a matrix.
Eigen::MatrixXf rowMajorMatrix(const std::vector<float>& values, Eigen::Index rows, Eigen::Index columns);

}  // namespace lstm_planner::onnx
