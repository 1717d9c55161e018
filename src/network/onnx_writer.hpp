#pragma once

#include "lstm_planner/network/layers.hpp"
#include "onnx_subset.pb.h"

namespace lstm_planner::onnx {

/// The graph of one step of valid layers: graph inputs "observation" [1, inputs] and "layer_N_hidden", "layer_N_cell"
/// [1, 1, units] for each recurrent layer; graph outputs "preferences" [1, outputs] and the same states with "_next".
onnx_subset::GraphProto writeGraph(const LayerStack& layers);

}  // namespace lstm_planner::onnx
