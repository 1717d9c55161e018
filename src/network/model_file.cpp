#include "lstm_planner/network/model_file.hpp"

#include <stdexcept>

#include "lstm_planner/common/input_file.hpp"
#include "lstm_planner/common/output_file.hpp"
#include "network/onnx_field_count.hpp"
#include "network/onnx_graph.hpp"
#include "network/onnx_names.hpp"
#include "network/onnx_tensor.hpp"
#include "network/onnx_writer.hpp"
#include "onnx_subset.pb.h"

namespace lstm_planner {
namespace {

constexpr std::uintmax_t kMaximumFileSize = std::uintmax_t{128} << 20;

/// Runs `work`, whose refusals do not name the file.
template <typename Work>
auto naming(const std::string& path, const Work& work) {
  const std::string file = "model file " + path + ": ";
  try {
    return work();
  } catch (const ModelFileError& error) {
    throw ModelFileError(file + error.what());
  } catch (const std::invalid_argument& error) {
    throw ModelFileError(file + error.what());
  }
}

std::string readWholeFile(const std::string& path) {
  try {
    return readInputFile(path, kMaximumFileSize);
  } catch (const InputFileError& error) {
    throw ModelFileError("it cannot be read: " + std::string(error.what()));
  }
}

onnx_subset::ModelProto parsed(const std::string& path) {
  const std::string bytes = readWholeFile(path);
  onnx::checkFieldCount(bytes);
  onnx_subset::ModelProto file;
  if (!file.ParseFromString(bytes)) {
    throw ModelFileError("it is truncated or not protobuf, expected an ONNX model");
  }
  return file;
}

std::int64_t opsetVersion(const onnx_subset::ModelProto& file) {
  for (const auto& opset : file.opset_import()) {
    if (!onnx::isStandardDomain(opset.domain())) continue;
    if (opset.version() < onnx::kOldestOpset || opset.version() > onnx::kNewestOpset) {
      throw ModelFileError("the operator set is version " + std::to_string(opset.version()) + ", expected " +
                           std::to_string(onnx::kOldestOpset) + " to " + std::to_string(onnx::kNewestOpset));
    }
    return opset.version();
  }
  throw ModelFileError("no ONNX operator set is named, expected version " + std::to_string(onnx::kOldestOpset) +
                       " to " + std::to_string(onnx::kNewestOpset));
}

/// Whatever the graph is. Throws ModelFileError for a key that is there twice.
std::map<std::string, std::string> readMetadata(const onnx_subset::ModelProto& file) {
  std::map<std::string, std::string> metadata;
  for (const auto& entry : file.metadata_props()) {
    if (!metadata.emplace(entry.key(), entry.value()).second) {
      throw ModelFileError("the metadata hold " + onnx::quoted(entry.key()) + " twice, expected once");
    }
  }
  return metadata;
}

/// The layers and the metadata. Throws ModelFileError with a sentence that does not name the file.
Model readModel(const onnx_subset::ModelProto& file) {
  if (file.ir_version() < 1 || !file.has_graph()) {
    throw ModelFileError("there is no graph in it, expected an ONNX model");
  }
  Model model;
  model.layers = onnx::GraphReader(file.graph(), opsetVersion(file)).read();
  model.metadata = readMetadata(file);
  return model;
}

/// Two serialised messages one after the other are one message. With the graph last, no truncated file is complete in
/// itself: cut off between two fields, the file would still be valid and only lack metadata.
std::string serialise(const Model& model) {
  onnx_subset::ModelProto header;
  header.set_ir_version(onnx::kIrVersion);
  header.set_producer_name("lstm_planner");
  auto& opset = *header.add_opset_import();
  opset.set_domain("");
  opset.set_version(onnx::kWrittenOpset);
  for (const auto& [key, value] : model.metadata) {
    auto& entry = *header.add_metadata_props();
    entry.set_key(key);
    entry.set_value(value);
  }
  onnx_subset::ModelProto body;
  *body.mutable_graph() = onnx::writeGraph(model.layers);
  return header.SerializeAsString() + body.SerializeAsString();
}

void replaceFile(const std::string& path, const std::string& bytes) {
  try {
    OutputFile file(path);
    file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.commit();
  } catch (const OutputFileError& error) {
    throw ModelFileError("it cannot be written (" + std::string(error.what()) +
                         "), expected a folder that exists and is writable");
  }
}

}  // namespace

Model readModelFile(const std::string& path) {
  return naming(path, [&] {
    Model model = readModel(parsed(path));
    validateLayers(model.layers);
    return model;
  });
}

std::map<std::string, std::string> readModelMetadata(const std::string& path) {
  return naming(path, [&] { return readMetadata(parsed(path)); });
}

void writeModelFile(const std::string& path, const Model& model) {
  naming(path, [&] {
    validateLayers(model.layers);
    replaceFile(path, serialise(model));
  });
}

}  // namespace lstm_planner
