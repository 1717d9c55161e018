#include "network/onnx_tensor.hpp"

#include <cmath>
#include <cstring>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "network/onnx_names.hpp"

namespace lstm_planner::onnx {
namespace {

using onnx_subset::TensorProto;

constexpr std::int64_t kMaximumElements = std::int64_t{1} << 24;
constexpr std::size_t kMaximumNameLength = 60;

std::string tensorName(const TensorProto& tensor) { return "tensor " + quoted(tensor.name()); }

/// The bytes of a tensor's values. ONNX stores raw data in little-endian order, which is that of every machine ROS runs
/// on.
struct StoredBytes {
  const char* data = nullptr;
  std::size_t count = 0;  ///< of values
  std::size_t width = 0;  ///< of a value
};

template <typename TypedData>
StoredBytes storedBytes(const TensorProto& tensor, const TypedData& typed_data) {
  constexpr std::size_t kWidth = sizeof(typename TypedData::value_type);
  if (tensor.data_location() == kExternalData) {
    throw ModelFileError(tensorName(tensor) +
                         " has its data in another file, expected them in this one: export with external_data=False, "
                         "or dynamo=False");
  }
  const Shape shape = shapeOf(tensor);
  const auto count = static_cast<std::size_t>(elementCount(shape, tensorName(tensor)));
  const std::string& raw = tensor.raw_data();
  const bool is_raw = !raw.empty();
  const std::size_t bytes = is_raw ? raw.size() : static_cast<std::size_t>(typed_data.size()) * kWidth;
  if (bytes != count * kWidth) {
    throw ModelFileError(tensorName(tensor) + " holds " + std::to_string(bytes) + " bytes, expected " +
                         std::to_string(count * kWidth) + " for its shape " + shapeText(shape));
  }
  return {is_raw ? raw.data() : reinterpret_cast<const char*>(typed_data.data()), count, kWidth};
}

std::string typeFault(const TensorProto& tensor, const std::string& expected) {
  return tensorName(tensor) + " has the data type " + std::to_string(tensor.data_type()) + ", expected " + expected;
}

StoredBytes storedBytes(const TensorProto& tensor) {
  if (tensor.data_type() == kFloat) return storedBytes(tensor, tensor.float_data());
  if (tensor.data_type() == kInt32) return storedBytes(tensor, tensor.int32_data());
  if (tensor.data_type() == kInt64) return storedBytes(tensor, tensor.int64_data());
  throw ModelFileError(typeFault(tensor, "1 (float), 6 (int32) or 7 (int64)"));
}

template <typename Value>
std::vector<Value> storedValues(const TensorProto& tensor) {
  const StoredBytes stored = storedBytes(tensor);
  std::vector<Value> values(stored.count);
  std::memcpy(values.data(), stored.data, stored.count * sizeof(Value));
  return values;
}

/// The values from the place `at` on, along the axis and those behind it.
void append(const StoredBytes& stored, const View& view, std::size_t axis, std::int64_t at, std::string* bytes) {
  if (axis == view.shape.size()) {
    bytes->append(stored.data + static_cast<std::size_t>(at) * stored.width, stored.width);
    return;
  }
  for (std::int64_t i = 0; i < view.shape[axis]; ++i)
    append(stored, view, axis + 1, at + i * view.strides[axis], bytes);
}

}  // namespace

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char character : name.substr(0, kMaximumNameLength)) {
    text += character >= ' ' && character <= '~' ? character : '?';
  }
  return text + (name.size() > kMaximumNameLength ? "...\"" : "\"");
}

std::string shapeText(const Shape& shape) {
  std::string text = "[";
  for (std::size_t axis = 0; axis < shape.size() && axis < kMaximumRank; ++axis) {
    text += (axis > 0 ? ", " : "") + std::to_string(shape[axis]);
  }
  return text + (shape.size() > kMaximumRank ? ", ...]" : "]");
}

std::int64_t elementCount(const Shape& shape, const std::string& what) {
  if (shape.size() > kMaximumRank) {
    throw ModelFileError(what + " has " + std::to_string(shape.size()) + " axes, expected at most " +
                         std::to_string(kMaximumRank));
  }
  std::int64_t count = 1;
  for (const std::int64_t extent : shape) {
    if (extent < 1 || extent > kMaximumElements / count) {
      throw ModelFileError(what + " has the shape " + shapeText(shape) + ", expected between 1 and " +
                           std::to_string(kMaximumElements) + " values");
    }
    count *= extent;
  }
  return count;
}

Shape shapeOf(const TensorProto& tensor) {
  Shape shape(tensor.dims().begin(), tensor.dims().end());
  elementCount(shape, tensorName(tensor));
  return shape;
}

View wholeView(const Shape& shape) {
  View view{shape, Shape(shape.size(), 1)};
  for (std::size_t axis = shape.size(); axis-- > 1;) view.strides[axis - 1] = view.strides[axis] * shape[axis];
  return view;
}

TensorProto emptyTensor(std::int32_t data_type, const Shape& shape) {
  TensorProto tensor;
  tensor.set_data_type(data_type);
  for (const std::int64_t extent : shape) tensor.add_dims(extent);
  return tensor;
}

TensorProto viewed(const TensorProto& tensor, const View& view) {
  TensorProto result = emptyTensor(tensor.data_type(), view.shape);
  append(storedBytes(tensor), view, 0, view.first, result.mutable_raw_data());
  return result;
}

TensorProto joinedTensors(const std::vector<const TensorProto*>& tensors, const Shape& shape, std::size_t axis) {
  TensorProto result = emptyTensor(tensors.front()->data_type(), shape);
  std::vector<StoredBytes> parts;
  for (const TensorProto* tensor : tensors) parts.push_back(storedBytes(*tensor));
  std::size_t rows = 1;
  for (std::size_t before = 0; before < axis; ++before) rows *= static_cast<std::size_t>(shape[before]);
  for (std::size_t row = 0; row < rows; ++row) {
    for (const StoredBytes& part : parts) {
      const std::size_t bytes = part.count / rows * part.width;
      result.mutable_raw_data()->append(part.data + row * bytes, bytes);
    }
  }
  return result;
}

std::vector<float> floatValues(const TensorProto& tensor) {
  if (tensor.data_type() != kFloat) throw ModelFileError(typeFault(tensor, "1 (float)"));
  std::vector<float> values = storedValues<float>(tensor);
  for (std::size_t index = 0; index < values.size(); ++index) {
    if (!std::isfinite(values[index])) {
      throw ModelFileError(tensorName(tensor) + " holds " + numberText(values[index]) + " at position " +
                           std::to_string(index) + ", expected finite weights");
    }
  }
  return values;
}

std::vector<std::int64_t> integerValues(const TensorProto& tensor) {
  const bool is_narrow = tensor.data_type() == kInt32;
  if (!is_narrow && tensor.data_type() != kInt64) throw ModelFileError(typeFault(tensor, "7 (int64)"));
  const std::int64_t count = elementCount(shapeOf(tensor), tensorName(tensor));
  if (count > static_cast<std::int64_t>(kMaximumRank)) {
    throw ModelFileError(tensorName(tensor) + " holds " + std::to_string(count) + " whole numbers, expected at most " +
                         std::to_string(kMaximumRank) + ", one an axis");
  }
  if (!is_narrow) return storedValues<std::int64_t>(tensor);
  const std::vector<std::int32_t> values = storedValues<std::int32_t>(tensor);
  return {values.begin(), values.end()};
}

Eigen::MatrixXf rowMajorMatrix(const std::vector<float>& values, Eigen::Index rows, Eigen::Index columns) {
  using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data(), rows, columns);
}

}  // namespace lstm_planner::onnx
