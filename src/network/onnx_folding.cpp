#include "network/onnx_folding.hpp"

#include "lstm_planner/network/model_file.hpp"
#include "network/onnx_names.hpp"
#include "network/onnx_shapes.hpp"

namespace lstm_planner::onnx {
namespace {

using onnx_subset::TensorProto;

void takeRoom(const Node& node, const Shape& shape, std::int64_t* room) {
  *room -= elementCount(shape, "the result of " + node.name());
  if (*room < 0) {
    throw ModelFileError(node.name() + " makes more than " + std::to_string(kMostFoldedValues) +
                         " values of constants together with those before it");
  }
}

TensorProto concatenated(Node& node, std::int64_t* room) {
  std::vector<const TensorProto*> tensors = {&node.requiredConstant(0, "data")};
  std::vector<Shape> shapes = {shapeOf(*tensors.front())};
  for (int index = 1; !node.input(index).empty(); ++index) {
    tensors.push_back(&node.requiredConstant(index, "data"));
    shapes.push_back(shapeOf(*tensors.back()));
    if (tensors.back()->data_type() != tensors.front()->data_type()) {
      throw ModelFileError(node.name() + " joins values of different types, expected one type");
    }
  }
  const Shape shape = shapeAfterConcat(node, shapes);
  takeRoom(node, shape, room);
  return joinedTensors(tensors, shape, axisIndex(node, node.integer("axis", 0), shape.size()));
}

TensorProto filled(Node& node, std::int64_t* room) {
  TensorProto zero = emptyTensor(kFloat, {});
  zero.add_float_data(0.0f);
  const TensorProto* value = node.tensor("value");
  if (value == nullptr) value = &zero;
  if (elementCount(shapeOf(*value), "the value of " + node.name()) != 1) {
    throw ModelFileError(node.name() + " fills with several values, expected one");
  }
  const Shape shape = integerValues(node.requiredConstant(0, "shape"));
  takeRoom(node, shape, room);
  return viewed(*value, {shape, Shape(shape.size(), 0)});
}

/// Extents of another integer type.
TensorProto cast(Node& node) {
  const std::int64_t type = node.integer("to", 0);
  if (type != kInt32 && type != kInt64) {
    throw ModelFileError(node.name() + " casts to the data type " + std::to_string(type) +
                         ", expected an integer type");
  }
  const TensorProto& tensor = node.requiredConstant(0, "data");
  TensorProto result = emptyTensor(static_cast<std::int32_t>(type), shapeOf(tensor));
  for (const std::int64_t value : integerValues(tensor)) {
    if (type == kInt32) {
      result.add_int32_data(static_cast<std::int32_t>(value));
    } else {
      result.add_int64_data(value);
    }
  }
  return result;
}

}  // namespace

bool isFoldable(const std::string& operator_name) {
  static const std::set<std::string> kFoldable = {"Cast",    "Concat",  "ConstantOfShape", "Expand",
                                                  "Flatten", "Gather",  "Identity",        "Reshape",
                                                  "Slice",   "Squeeze", "Transpose",       "Unsqueeze"};
  return kFoldable.count(operator_name) > 0;
}

TensorProto folded(Node& node, std::int64_t opset, std::int64_t* room) {
  const std::string& name = node.operatorName();
  if (name == "Concat") return concatenated(node, room);
  if (name == "ConstantOfShape") return filled(node, room);
  if (name == "Cast") return cast(node);
  const TensorProto& tensor = node.requiredConstant(0, "data");
  const View view = viewAfter(node, shapeOf(tensor), opset);
  takeRoom(node, view.shape, room);
  return viewed(tensor, view);
}

}  // namespace lstm_planner::onnx
