#pragma once

#include <map>
#include <string>

#include "lstm_planner/network/model_file.hpp"
#include "onnx_subset.pb.h"

namespace lstm_planner::onnx {

/// The layers and the metadata of a parsed file. Throws ModelFileError with a sentence that does not name the file.
Model readModel(const onnx_subset::ModelProto& file);

/// Whatever the graph is. Throws ModelFileError for a key that is there twice.
std::map<std::string, std::string> readMetadata(const onnx_subset::ModelProto& file);

}  // namespace lstm_planner::onnx
