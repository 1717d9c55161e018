#include "network/onnx_folding.hpp"

#include <algorithm>

#include "lstm_planner/network/model_file.hpp"
#include "network/onnx_names.hpp"
#include "network/onnx_shapes.hpp"

namespace lstm_planner::onnx {
namespace {

using onnx_subset::TensorProto;

constexpr std::int64_t kMostValues = 1 << 16;
constexpr std::size_t kMostExtents = 8;

/// Floats that are all the same, whose shape alone tells one from another.
TensorProto uniformTensor(const Node& node, const Shape& shape, float value) {
  const std::int64_t count = elementCount(shape, "the result of " + node.name());
  if (count > kMostValues) {
    throw ModelFileError(node.name() + " makes the shape " + shapeText(shape) + ", expected at most " +
                         std::to_string(kMostValues) + " values");
  }
  TensorProto tensor;
  tensor.set_data_type(kFloat);
  for (const std::int64_t extent : shape) tensor.add_dims(extent);
  for (std::int64_t i = 0; i < count; ++i) tensor.add_float_data(value);
  return tensor;
}

float uniformValue(const Node& node, const TensorProto& tensor) {
  const std::vector<float> values = floatValues(tensor);
  if (values.empty() || std::any_of(values.begin(), values.end(), [&](float value) { return value != values[0]; })) {
    throw ModelFileError(node.name() + " computes with stored values, expected layers to do that");
  }
  return values[0];
}

std::vector<std::int64_t> extents(const Node& node, int index) {
  std::vector<std::int64_t> values = integerValues(node.requiredConstant(index, "shape"));
  if (values.size() > kMostExtents) {
    throw ModelFileError(node.name() + " has " + std::to_string(values.size()) + " extents, expected at most " +
                         std::to_string(kMostExtents));
  }
  return values;
}

TensorProto concatenated(Node& node) {
  node.integer("axis", 0);
  std::vector<std::int64_t> values;
  for (int index = 0; !node.input(index).empty(); ++index) {
    const std::vector<std::int64_t> part = extents(node, index);
    values.insert(values.end(), part.begin(), part.end());
    if (values.size() > kMostExtents) throw ModelFileError(node.name() + " joins too many extents, expected 8 or less");
  }
  return integerTensor(values);
}

TensorProto gathered(Node& node) {
  node.integer("axis", 0);
  const std::vector<std::int64_t> values = extents(node, 0);
  const TensorProto& index_tensor = node.requiredConstant(1, "indices");
  const std::vector<std::int64_t> indices = integerValues(index_tensor);
  const auto count = static_cast<std::int64_t>(values.size());
  if (indices.size() != 1 || indices[0] < -count || indices[0] >= count) {
    throw ModelFileError(node.name() + " picks from " + std::to_string(count) + " extents, expected one of them");
  }
  const std::int64_t at = indices[0] < 0 ? indices[0] + count : indices[0];
  return integerTensor({values[static_cast<std::size_t>(at)]}, index_tensor.dims_size() == 0);
}

TensorProto filled(Node& node) {
  const TensorProto* value = node.tensor("value");
  return uniformTensor(node, extents(node, 0), value == nullptr ? 0.0f : uniformValue(node, *value));
}

/// As NumPy broadcasts: extents of 1, and axes that are not there, are repeated.
TensorProto expanded(Node& node) {
  const TensorProto& tensor = node.requiredConstant(0, "data");
  Shape from = shapeOf(tensor);
  Shape to = extents(node, 1);
  const std::size_t axes = std::max(from.size(), to.size());
  from.insert(from.begin(), axes - from.size(), 1);
  to.insert(to.begin(), axes - to.size(), 1);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    if (to[axis] == 1) to[axis] = from[axis];
    if (from[axis] == 1 || from[axis] == to[axis]) continue;
    throw ModelFileError(node.name() + " makes " + shapeText(to) + " of " + shapeText(from) +
                         ", which do not fit together");
  }
  return uniformTensor(node, to, uniformValue(node, tensor));
}

bool isFloat(const TensorProto& tensor) { return tensor.data_type() == kFloat; }

/// What changes nothing but the number of axes, of a state, a single extent or a list of them.
TensorProto reshaped(Node& node) {
  const TensorProto& tensor = node.requiredConstant(0, "data");
  const bool squeezes = node.operatorName() == "Squeeze";
  if (isFloat(tensor) && node.operatorName() != "Identity") {
    const Shape shape = shapeOf(tensor);
    return uniformTensor(node, squeezes ? shapeAfterSqueeze(node, shape) : shapeAfterUnsqueeze(node, shape),
                         uniformValue(node, tensor));
  }
  node.integers("axes");
  const std::vector<std::int64_t> values = extents(node, 0);
  return integerTensor(values, squeezes && values.size() == 1);
}

/// Extents of another integer type.
TensorProto cast(Node& node) {
  const std::int64_t type = node.integer("to", 0);
  if (type != kInt32 && type != kInt64) {
    throw ModelFileError(node.name() + " casts to the data type " + std::to_string(type) +
                         ", expected an integer type");
  }
  return integerTensor(extents(node, 0), node.requiredConstant(0, "data").dims_size() == 0);
}

TensorProto sliced(Node& node, std::int64_t opset) {
  const TensorProto& tensor = node.requiredConstant(0, "data");
  const Part part = partOfSlice(node, shapeOf(tensor), opset);
  if (isFloat(tensor)) return uniformTensor(node, part.shape, uniformValue(node, tensor));
  const std::vector<std::int64_t> values = extents(node, 0);
  if (part.shape.size() != 1)
    throw ModelFileError(node.name() + " takes a part of a table, expected a list of extents");
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(part.first);
  return integerTensor({first, first + static_cast<std::ptrdiff_t>(part.shape[0])});
}

}  // namespace

bool isFoldable(const std::string& operator_name) {
  static const std::set<std::string> kFoldable = {"Cast",     "Concat", "ConstantOfShape", "Expand",   "Gather",
                                                  "Identity", "Slice",  "Squeeze",         "Unsqueeze"};
  return kFoldable.count(operator_name) > 0;
}

TensorProto folded(Node& node, std::int64_t opset) {
  const std::string& name = node.operatorName();
  if (name == "Concat") return concatenated(node);
  if (name == "Gather") return gathered(node);
  if (name == "ConstantOfShape") return filled(node);
  if (name == "Expand") return expanded(node);
  if (name == "Cast") return cast(node);
  return name == "Slice" ? sliced(node, opset) : reshaped(node);
}

TensorProto integerTensor(const std::vector<std::int64_t>& values, bool is_scalar) {
  TensorProto tensor;
  tensor.set_data_type(kInt64);
  if (!is_scalar) tensor.add_dims(static_cast<std::int64_t>(values.size()));
  for (const std::int64_t value : values) tensor.add_int64_data(value);
  return tensor;
}

}  // namespace lstm_planner::onnx
