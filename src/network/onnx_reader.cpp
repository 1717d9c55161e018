#include "network/onnx_reader.hpp"

#include "network/onnx_graph.hpp"
#include "network/onnx_names.hpp"
#include "network/onnx_tensor.hpp"

namespace lstm_planner::onnx {
namespace {

std::int64_t opsetVersion(const onnx_subset::ModelProto& file) {
  for (const auto& opset : file.opset_import()) {
    if (!isStandardDomain(opset.domain())) continue;
    if (opset.version() < kOldestOpset || opset.version() > kNewestOpset) {
      throw ModelFileError("the operator set is version " + std::to_string(opset.version()) + ", expected " +
                           std::to_string(kOldestOpset) + " to " + std::to_string(kNewestOpset));
    }
    return opset.version();
  }
  throw ModelFileError("no ONNX operator set is named, expected version " + std::to_string(kOldestOpset) + " to " +
                       std::to_string(kNewestOpset));
}

}  // namespace

std::map<std::string, std::string> readMetadata(const onnx_subset::ModelProto& file) {
  std::map<std::string, std::string> metadata;
  for (const auto& entry : file.metadata_props()) {
    if (!metadata.emplace(entry.key(), entry.value()).second) {
      throw ModelFileError("the metadata hold " + quoted(entry.key()) + " twice, expected once");
    }
  }
  return metadata;
}

Model readModel(const onnx_subset::ModelProto& file) {
  if (file.ir_version() < 1 || !file.has_graph()) {
    throw ModelFileError("there is no graph in it, expected an ONNX model");
  }
  Model model;
  model.layers = GraphReader(file.graph(), opsetVersion(file)).read();
  model.metadata = readMetadata(file);
  return model;
}

}  // namespace lstm_planner::onnx
