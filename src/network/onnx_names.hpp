#pragma once

#include <cstdint>

namespace lstm_planner::onnx {

// Numbers and names which the reader and the writer of model files must agree on with the ONNX specification.

constexpr std::int64_t kIrVersion = 7;
constexpr std::int64_t kWrittenOpset = 14;

// The operators read mean the same in these operator sets, but for Softmax and the axes of Squeeze and Unsqueeze.
constexpr std::int64_t kOldestOpset = 7;
constexpr std::int64_t kNewestOpset = 22;

// TensorProto.DataType
constexpr std::int32_t kFloat = 1;
constexpr std::int32_t kInt32 = 6;
constexpr std::int32_t kInt64 = 7;

// AttributeProto.AttributeType
constexpr std::int32_t kAttributeInt = 2;
constexpr std::int32_t kAttributeStrings = 8;

// TensorProto.DataLocation
constexpr std::int32_t kExternalData = 1;

}  // namespace lstm_planner::onnx
