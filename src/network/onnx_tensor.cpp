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

/// ONNX stores raw data in little-endian order, which is that of every machine ROS runs on.
template <typename Value, typename TypedData>
std::vector<Value> storedValues(const TensorProto& tensor, const TypedData& typed_data, std::int32_t data_type,
                                const char* type_name) {
  if (tensor.data_type() != data_type) {
    throw ModelFileError(tensorName(tensor) + " has the data type " + std::to_string(tensor.data_type()) +
                         ", expected " + std::to_string(data_type) + " (" + type_name + ")");
  }
  if (tensor.data_location() == kExternalData) {
    throw ModelFileError(tensorName(tensor) + " has its data in another file, expected them in this one");
  }
  const Shape shape(tensor.dims().begin(), tensor.dims().end());
  const auto count = static_cast<std::size_t>(elementCount(shape, tensorName(tensor)));
  const std::string& raw = tensor.raw_data();
  const bool is_raw = !raw.empty();
  const std::size_t stored_bytes = is_raw ? raw.size() : static_cast<std::size_t>(typed_data.size()) * sizeof(Value);
  if (stored_bytes != count * sizeof(Value)) {
    throw ModelFileError(tensorName(tensor) + " holds " + std::to_string(stored_bytes) + " bytes, expected " +
                         std::to_string(count * sizeof(Value)) + " for its shape " + shapeText(shape));
  }
  if (!is_raw) return std::vector<Value>(typed_data.begin(), typed_data.end());
  std::vector<Value> values(count);
  std::memcpy(values.data(), raw.data(), raw.size());
  return values;
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
  constexpr std::size_t kMaximumRank = 8;
  std::string text = "[";
  for (std::size_t axis = 0; axis < shape.size() && axis < kMaximumRank; ++axis) {
    text += (axis > 0 ? ", " : "") + std::to_string(shape[axis]);
  }
  return text + (shape.size() > kMaximumRank ? ", ...]" : "]");
}

std::int64_t elementCount(const Shape& shape, const std::string& what) {
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

std::vector<float> floatValues(const TensorProto& tensor) {
  std::vector<float> values = storedValues<float>(tensor, tensor.float_data(), kFloat, "float");
  for (std::size_t index = 0; index < values.size(); ++index) {
    if (!std::isfinite(values[index])) {
      throw ModelFileError(tensorName(tensor) + " holds " + numberText(values[index]) + " at position " +
                           std::to_string(index) + ", expected finite weights");
    }
  }
  return values;
}

std::vector<std::int64_t> integerValues(const TensorProto& tensor) {
  if (tensor.data_type() == kInt32) {
    const std::vector<std::int32_t> values = storedValues<std::int32_t>(tensor, tensor.int32_data(), kInt32, "int32");
    return {values.begin(), values.end()};
  }
  return storedValues<std::int64_t>(tensor, tensor.int64_data(), kInt64, "int64");
}

Eigen::MatrixXf rowMajorMatrix(const std::vector<float>& values, Eigen::Index rows, Eigen::Index columns) {
  using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data(), rows, columns);
}

}  // namespace lstm_planner::onnx
