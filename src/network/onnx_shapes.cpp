#include "network/onnx_shapes.hpp"

#include <algorithm>
#include <set>

#include "lstm_planner/network/model_file.hpp"

namespace lstm_planner::onnx {
namespace {

/// An input since operator set 13, an attribute before.
std::vector<std::int64_t> axesOf(Node& node) {
  std::vector<std::int64_t> axes = node.integers("axes");
  const onnx_subset::TensorProto* tensor = node.constant(1, "axes");
  if (tensor != nullptr) axes = integerValues(*tensor);
  return axes;
}

std::set<std::size_t> axisSet(const Node& node, const std::vector<std::int64_t>& axes, std::size_t rank) {
  std::set<std::size_t> indices;
  for (const std::int64_t axis : axes) indices.insert(axisIndex(node, axis, rank));
  if (indices.size() != axes.size()) throw ModelFileError(node.name() + " names an axis twice, expected once");
  return indices;
}

Shape shapeAfterSqueeze(Node& node, const Shape& shape) {
  const std::vector<std::int64_t> axes = axesOf(node);
  const std::set<std::size_t> removed = axisSet(node, axes, shape.size());
  Shape result;
  for (std::size_t axis = 0; axis < shape.size(); ++axis) {
    const bool remove = axes.empty() ? shape[axis] == 1 : removed.count(axis) > 0;
    if (remove && shape[axis] != 1) {
      throw ModelFileError(node.name() + " removes the axis " + std::to_string(axis) + " of " + shapeText(shape) +
                           ", expected an extent of 1 there");
    }
    if (!remove) result.push_back(shape[axis]);
  }
  return result;
}

Shape shapeAfterUnsqueeze(Node& node, const Shape& shape) {
  const std::vector<std::int64_t> axes = axesOf(node);
  const std::size_t rank = shape.size() + axes.size();
  const std::set<std::size_t> inserted = axisSet(node, axes, rank);
  Shape result;
  auto next = shape.begin();
  for (std::size_t axis = 0; axis < rank; ++axis) result.push_back(inserted.count(axis) > 0 ? 1 : *next++);
  return result;
}

Shape shapeAfterReshape(Node& node, const Shape& shape) {
  const bool copies_extents = node.integer("allowzero", 0) == 0;
  Shape result = integerValues(node.requiredConstant(1, "target shape"));
  const std::int64_t count = elementCount(shape, "the input of " + node.name());
  std::int64_t known = 1;
  for (std::size_t axis = 0; axis < result.size(); ++axis) {
    if (copies_extents && result[axis] == 0 && axis < shape.size()) result[axis] = shape[axis];
    if (result[axis] == -1) continue;
    if (result[axis] < 1 || result[axis] > count / known) {
      throw ModelFileError(node.name() + " makes the shape " + shapeText(result) + " of " + std::to_string(count) +
                           " values, expected as many values");
    }
    known *= result[axis];
  }
  const auto open = std::count(result.begin(), result.end(), -1);
  std::replace(result.begin(), result.end(), std::int64_t{-1}, count / known);
  if (open > 1 || elementCount(result, "the result of " + node.name()) != count) {
    throw ModelFileError(node.name() + " makes the shape " + shapeText(result) + " of " + std::to_string(count) +
                         " values, expected as many values");
  }
  return result;
}

Shape shapeAfterFlatten(Node& node, const Shape& shape) {
  const std::int64_t axis = node.integer("axis", 1);
  // It may also name the place behind the last axis.
  const bool is_behind = axis == static_cast<std::int64_t>(shape.size());
  const std::size_t rows = is_behind ? shape.size() : axisIndex(node, axis, shape.size());
  const auto columns = shape.begin() + static_cast<std::ptrdiff_t>(rows);
  const std::string what = "the input of " + node.name();
  return {elementCount({shape.begin(), columns}, what), elementCount({columns, shape.end()}, what)};
}

View transposed(Node& node, const Shape& shape) {
  std::vector<std::int64_t> order = node.integers("perm");
  if (order.empty()) {
    for (std::size_t axis = shape.size(); axis-- > 0;) order.push_back(static_cast<std::int64_t>(axis));
  }
  if (order.size() != shape.size()) {
    throw ModelFileError(node.name() + " orders " + std::to_string(order.size()) + " axes, expected " +
                         std::to_string(shape.size()));
  }
  axisSet(node, order, shape.size());
  const View whole = wholeView(shape);
  View view;
  for (const std::int64_t axis : order) {
    const std::size_t index = axisIndex(node, axis, shape.size());
    view.shape.push_back(whole.shape[index]);
    view.strides.push_back(whole.strides[index]);
  }
  return view;
}

View gathered(Node& node, const Shape& shape) {
  const std::size_t axis = axisIndex(node, node.integer("axis", 0), shape.size());
  const onnx_subset::TensorProto& tensor = node.requiredConstant(1, "indices");
  const std::vector<std::int64_t> indices = integerValues(tensor);
  const std::int64_t extent = shape[axis];
  if (indices.size() != 1 || indices[0] < -extent || indices[0] >= extent) {
    throw ModelFileError(node.name() + " picks from the axis " + std::to_string(axis) + " of " + shapeText(shape) +
                         ", expected one place of it");
  }
  View view = wholeView(shape);
  view.first = (indices[0] < 0 ? indices[0] + extent : indices[0]) * view.strides[axis];
  // The axes of the indices take the place of that axis.
  for (Shape* extents : {&view.shape, &view.strides}) {
    const auto place = extents->erase(extents->begin() + static_cast<std::ptrdiff_t>(axis));
    extents->insert(place, static_cast<std::size_t>(tensor.dims_size()), 1);
  }
  return view;
}

View sliced(Node& node, const Shape& shape, std::int64_t opset) {
  // Attributes up to operator set 9, inputs since.
  const auto list = [&](int index, const char* name) {
    if (opset < 10) return node.integers(name);
    const onnx_subset::TensorProto* tensor = node.constant(index, name);
    return tensor == nullptr ? std::vector<std::int64_t>() : integerValues(*tensor);
  };
  const std::vector<std::int64_t> starts = list(1, "starts");
  const std::vector<std::int64_t> ends = list(2, "ends");
  std::vector<std::int64_t> axes = list(3, "axes");
  const std::vector<std::int64_t> steps = opset < 10 ? std::vector<std::int64_t>() : list(4, "steps");
  if (axes.empty()) {
    for (std::size_t axis = 0; axis < starts.size(); ++axis) axes.push_back(static_cast<std::int64_t>(axis));
  }
  const bool skips = std::any_of(steps.begin(), steps.end(), [](std::int64_t step) { return step != 1; });
  if (starts.empty() || starts.size() != ends.size() || starts.size() != axes.size() || skips) {
    throw ModelFileError(node.name() +
                         " has no starts, ends and axes that fit together, expected as many of each and steps of 1");
  }
  axisSet(node, axes, shape.size());
  View view = wholeView(shape);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::size_t axis = axisIndex(node, axes[i], shape.size());
    const std::int64_t extent = shape[axis];
    const auto place = [extent](std::int64_t at) {
      return std::clamp(at < 0 && at >= -extent ? at + extent : at, std::int64_t{0}, extent);
    };
    const std::int64_t first = place(starts[i]);
    const std::int64_t count = place(ends[i]) - first;
    if (count < 1)
      throw ModelFileError(node.name() + " takes nothing of " + shapeText(shape) + ", expected one value or more");
    view.shape[axis] = count;
    view.first += first * view.strides[axis];
  }
  return view;
}

/// As NumPy broadcasts: extents of 1, and axes that are not there, are repeated.
View expanded(Node& node, const Shape& shape) {
  Shape from = shape;
  Shape to = integerValues(node.requiredConstant(1, "shape"));
  const std::size_t axes = std::max(from.size(), to.size());
  from.insert(from.begin(), axes - from.size(), 1);
  to.insert(to.begin(), axes - to.size(), 1);
  View view = wholeView(from);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    if (to[axis] == 1 || to[axis] == from[axis]) continue;
    if (from[axis] != 1) {
      throw ModelFileError(node.name() + " makes " + shapeText(to) + " of " + shapeText(from) +
                           ", which do not fit together");
    }
    view.shape[axis] = to[axis];
    view.strides[axis] = 0;
  }
  return view;
}

}  // namespace

std::size_t axisIndex(const Node& node, std::int64_t axis, std::size_t rank) {
  const auto signed_rank = static_cast<std::int64_t>(rank);
  if (axis < -signed_rank || axis >= signed_rank) {
    throw ModelFileError(node.name() + " names the axis " + std::to_string(axis) + ", expected one of " +
                         std::to_string(rank) + " axes");
  }
  return static_cast<std::size_t>(axis < 0 ? axis + signed_rank : axis);
}

void requireVector(const Shape& shape, const std::string& what) {
  elementCount(shape, what);
  const auto wide = std::count_if(shape.begin(), shape.end(), [](std::int64_t extent) { return extent > 1; });
  if (wide > 1) {
    throw ModelFileError(
        what + " has the shape " + shapeText(shape) +
        ", expected one step of one robot (a batch and a sequence of 1): a single extent larger than 1");
  }
}

View viewAfter(Node& node, const Shape& shape, std::int64_t opset) {
  const std::string& name = node.operatorName();
  if (name == "Expand") return expanded(node, shape);
  if (name == "Flatten") return wholeView(shapeAfterFlatten(node, shape));
  if (name == "Gather") return gathered(node, shape);
  if (name == "Reshape") return wholeView(shapeAfterReshape(node, shape));
  if (name == "Slice") return sliced(node, shape, opset);
  if (name == "Squeeze") return wholeView(shapeAfterSqueeze(node, shape));
  if (name == "Transpose") return transposed(node, shape);
  if (name == "Unsqueeze") return wholeView(shapeAfterUnsqueeze(node, shape));
  return wholeView(shape);
}

Shape shapeAfterConcat(Node& node, const std::vector<Shape>& shapes) {
  Shape joined = shapes.front();
  const std::size_t axis = axisIndex(node, node.integer("axis", 0), joined.size());
  for (auto shape = shapes.begin() + 1; shape != shapes.end(); ++shape) {
    Shape others = *shape;
    if (others.size() == joined.size()) others[axis] = joined[axis];
    if (others != joined) {
      throw ModelFileError(node.name() + " joins the shape " + shapeText(*shape) + " to the shape " +
                           shapeText(shapes.front()) + ", expected them to differ along the axis " +
                           std::to_string(axis) + " alone");
    }
    joined[axis] += (*shape)[axis];
  }
  return joined;
}

void requireSoftmaxOverAll(Node& node, const Shape& shape, std::int64_t opset) {
  // Up to operator set 12, Softmax ran over all axes from the given one on.
  const bool from_axis_on = opset < 13;
  const std::size_t first = axisIndex(node, node.integer("axis", from_axis_on ? 1 : -1), shape.size());
  const auto begin = shape.begin() + static_cast<std::ptrdiff_t>(first);
  const Shape covered(begin, from_axis_on ? shape.end() : begin + 1);
  const std::string what = "the input of " + node.name();
  if (elementCount(covered, what) != elementCount(shape, what)) {
    throw ModelFileError(node.name() + " normalises " + shapeText(covered) + " of " + shapeText(shape) +
                         ", expected all values together");
  }
}

}  // namespace lstm_planner::onnx
