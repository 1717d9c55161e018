#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "onnx_subset.pb.h"

namespace lstm_planner::onnx {

/// Extent of a tensor along each axis, outermost first.
using Shape = std::vector<std::int64_t>;

/// Which values of a tensor are those of another one: along an axis, the next value lies `strides` values further on.
struct View {
  Shape shape;
  Shape strides;
  std::int64_t first = 0;
};

/// All values in their order.
View wholeView(const Shape& shape);

/// A name out of a file in quotes, made short and printable for a message.
std::string quoted(const std::string& name);

/// For messages: "[1, 32, 11]".
std::string shapeText(const Shape& shape);

constexpr std::size_t kMaximumRank = 8;  ///< axes of a tensor

/// Number of values in a tensor of that shape. Throws ModelFileError, naming `what`, when an extent is not positive, or
/// the number of axes or values is larger than any network of ours could have.
std::int64_t elementCount(const Shape& shape, const std::string& what);

/// Shape of a stored tensor. Throws ModelFileError as elementCount does.
Shape shapeOf(const onnx_subset::TensorProto& tensor);

/// All values of a float tensor, in row-major order. Throws ModelFileError when it is of another type, its data do not
/// fit its shape, are stored in another file or not finite.
std::vector<float> floatValues(const onnx_subset::TensorProto& tensor);

/// All values of an int64 or int32 tensor (axes, a target shape), which are at most one for each axis that a tensor may
/// have; the same rules.
std::vector<std::int64_t> integerValues(const onnx_subset::TensorProto& tensor);

/// A tensor without values.
onnx_subset::TensorProto emptyTensor(std::int32_t data_type, const Shape& shape);

/// A tensor of those values of a float, int64 or int32 tensor. Throws ModelFileError as floatValues does, but not for
/// values that are not finite.
onnx_subset::TensorProto viewed(const onnx_subset::TensorProto& tensor, const View& view);

/// Such tensors of one type behind each other along an axis, the only one along which their shapes differ; `shape` is
/// that of the result.
onnx_subset::TensorProto joinedTensors(const std::vector<const onnx_subset::TensorProto*>& tensors, const Shape& shape,
                                       std::size_t axis);

/// The first rows * columns values as a matrix.
Eigen::MatrixXf rowMajorMatrix(const std::vector<float>& values, Eigen::Index rows, Eigen::Index columns);

}  // namespace lstm_planner::onnx
