#include "network/onnx_field_count.hpp"

#include <google/protobuf/io/coded_stream.h>

#include <cstdint>
#include <map>
#include <utility>

#include "lstm_planner/network/model_file.hpp"

namespace lstm_planner::onnx {
namespace {

constexpr std::int64_t kMostFields = 200000;

/// Messages of onnx_subset.proto, and what else a field of bytes may hold.
enum class Content { kModel, kGraph, kNode, kAttribute, kTensor, kValue, kType, kTensorType, kShape, kLeaf, kIntegers };

Content contentOf(Content message, int field) {
  static const std::map<std::pair<Content, int>, Content> kContents = {
      {{Content::kModel, 7}, Content::kGraph},      {{Content::kGraph, 1}, Content::kNode},
      {{Content::kGraph, 5}, Content::kTensor},     {{Content::kGraph, 11}, Content::kValue},
      {{Content::kGraph, 12}, Content::kValue},     {{Content::kNode, 5}, Content::kAttribute},
      {{Content::kAttribute, 5}, Content::kTensor}, {{Content::kAttribute, 8}, Content::kIntegers},
      {{Content::kTensor, 1}, Content::kIntegers},  {{Content::kTensor, 5}, Content::kIntegers},
      {{Content::kTensor, 7}, Content::kIntegers},  {{Content::kValue, 2}, Content::kType},
      {{Content::kType, 1}, Content::kTensorType},  {{Content::kTensorType, 2}, Content::kShape},
  };
  const auto found = kContents.find({message, field});
  return found == kContents.end() ? Content::kLeaf : found->second;
}

class FieldCounter {
 public:
  explicit FieldCounter(const std::string& bytes)
      : stream_(reinterpret_cast<const std::uint8_t*>(bytes.data()), static_cast<int>(bytes.size())) {}

  /// Counts up to the stream's limit; false where it is no protobuf.
  bool count(Content message) {
    while (const std::uint32_t tag = stream_.ReadTag()) {
      add(1);
      if (!skipValue(message, static_cast<int>(tag >> 3U), tag & 7U)) return false;
    }
    return stream_.ConsumedEntireMessage();
  }

 private:
  void add(std::int64_t fields) {
    fields_ += fields;
    if (fields_ > kMostFields) {
      throw ModelFileError("it has more than " + std::to_string(kMostFields) +
                           " nodes, attributes and other fields, expected a small network");
    }
  }

  bool skipValue(Content message, int field, std::uint32_t wire_type) {
    std::uint64_t number = 0;
    std::uint32_t length = 0;
    switch (wire_type) {
      case 0:
        return stream_.ReadVarint64(&number);
      case 1:
        return stream_.Skip(8);
      case 2:
        return stream_.ReadVarint32(&length) && skipBytes(contentOf(message, field), static_cast<int>(length));
      case 3:  // groups, of which ONNX has none: their fields follow and are counted like others
      case 4:
        return true;
      case 5:
        return stream_.Skip(4);
      default:
        return false;
    }
  }

  bool skipBytes(Content content, int length) {
    if (length < 0) return false;
    if (content == Content::kIntegers) add(length);
    if (content == Content::kLeaf || content == Content::kIntegers) return stream_.Skip(length);
    const auto limit = stream_.PushLimit(length);
    const bool is_whole = count(content);
    stream_.PopLimit(limit);
    return is_whole;
  }

  google::protobuf::io::CodedInputStream stream_;
  std::int64_t fields_ = 0;
};

}  // namespace

void checkFieldCount(const std::string& bytes) { FieldCounter(bytes).count(Content::kModel); }

}  // namespace lstm_planner::onnx
