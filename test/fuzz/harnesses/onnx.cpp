#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuzz/fuzz_input.hpp"
#include "fuzz/harness.hpp"
#include "fuzz/scratch_file.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "network/onnx_writer.hpp"
#include "onnx_subset.pb.h"

namespace lstm_planner::fuzz::onnx_harness {
namespace {

using onnx_subset::AttributeProto;
using onnx_subset::GraphProto;
using onnx_subset::ModelProto;
using onnx_subset::NodeProto;
using onnx_subset::TensorProto;

LayerStack layersOf(int kind, int inputs, int outputs) {
  NetworkShape shape;
  shape.cells = {3, 2};
  shape.kind = static_cast<NetworkShape::Kind>(kind % 3);
  if (kind == 3) {
    shape.deep_in = {3};
    shape.deep_out = {2};
  }
  LayerStack layers = initialised(makeNetwork(inputs, shape, outputs), 1);
  if (kind == 1) layers.push_back(SoftmaxLayer());
  return layers;
}

/// A small model that is fine, as the package writes it.
ModelProto soundModel(int kind) {
  PolicyDescription description;
  description.encoder.input_layout = {"sector_0", "goal_distance", "goal_bearing"};
  if (kind == 3) description.encoder.views = kDriveViews;
  std::map<std::string, std::string> metadata;
  writeMetadata(description, &metadata);

  ModelProto model;
  model.set_ir_version(7);
  auto& opset = *model.add_opset_import();
  opset.set_domain("");
  opset.set_version(14);
  for (const auto& [key, value] : metadata) {
    auto& entry = *model.add_metadata_props();
    entry.set_key(key);
    entry.set_value(value);
  }
  *model.mutable_graph() = onnx::writeGraph(layersOf(kind, 3, networkOutputs(description)));
  return model;
}

/// Changes one thing after the other.
class ModelMutator {
 public:
  ModelMutator(FuzzInput* input, ModelProto* model) : input_(*input), model_(*model) {}

  void mutate() {
    GraphProto& graph = *model_.mutable_graph();
    switch (input_.byte() % 8) {
      case 0:
        change(graph.mutable_node());
        break;
      case 1:
        change(graph.mutable_initializer());
        break;
      case 2:
        change(graph.mutable_input());
        break;
      case 3:
        change(graph.mutable_output());
        break;
      case 4:
        change(model_.mutable_metadata_props());
        break;
      case 5:
        change(model_.mutable_opset_import());
        break;
      case 6:
        model_.set_ir_version(integer());
        break;
      default:
        change(graph.mutable_node());
    }
  }

 private:
  /// Removes, repeats, swaps, or changes one of them.
  template <typename Field>
  void change(Field* elements) {
    const std::uint8_t kind = input_.byte();
    if (elements->empty() || kind % 16 == 0) {
      mutate(elements->Add());
      return;
    }
    const int at = static_cast<int>(input_.integer(0, elements->size() - 1));
    const int other = static_cast<int>(input_.integer(0, elements->size() - 1));
    switch (kind % 16) {
      case 1:
        elements->erase(elements->begin() + at);
        break;
      case 2:
        elements->SwapElements(at, other);
        break;
      case 3: {
        const auto copy = elements->Get(at);
        *elements->Add() = copy;
        break;
      }
      default:
        mutate(elements->Mutable(at));
    }
  }

  void mutate(std::string* text) { *text = name(); }

  void mutate(NodeProto* node) {
    static const std::array<std::string, 24> kOperators = {"LSTM",
                                                           "RNN",
                                                           "Gemm",
                                                           "Relu",
                                                           "Tanh",
                                                           "Sigmoid",
                                                           "Softmax",
                                                           "Constant",
                                                           "Identity",
                                                           "Reshape",
                                                           "Squeeze",
                                                           "Transpose",
                                                           "Unsqueeze",
                                                           "Flatten",
                                                           "Conv",
                                                           "Add",
                                                           "Cast",
                                                           "Concat",
                                                           "ConstantOfShape",
                                                           "Expand",
                                                           "Gather",
                                                           "MatMul",
                                                           "Shape",
                                                           "Slice"};
    switch (input_.byte() % 8) {
      case 0:
        node->set_op_type(input_.pick(kOperators));
        break;
      case 1:
      case 2:
        change(node->mutable_input());
        break;
      case 3:
        change(node->mutable_output());
        break;
      case 4:
        node->set_domain(name());
        break;
      default:
        change(node->mutable_attribute());
    }
  }

  void mutate(AttributeProto* attribute) {
    static const std::array<std::string, 23> kAttributes = {"value",
                                                            "axes",
                                                            "axis",
                                                            "perm",
                                                            "alpha",
                                                            "beta",
                                                            "transA",
                                                            "transB",
                                                            "hidden_size",
                                                            "direction",
                                                            "activations",
                                                            "layout",
                                                            "clip",
                                                            "input_forget",
                                                            "activation_alpha",
                                                            "activation_beta",
                                                            "allowzero",
                                                            "value_int",
                                                            "value_floats",
                                                            "linear_before_reset",
                                                            "to",
                                                            "starts",
                                                            "ends"};
    switch (input_.byte() % 10) {
      case 0:
        attribute->set_name(input_.pick(kAttributes));
        break;
      case 1:
        attribute->set_f(static_cast<float>(number()));
        break;
      case 2:
        attribute->set_i(integer());
        break;
      case 3:
        attribute->set_s(name());
        break;
      case 4:
        mutate(attribute->mutable_t());
        break;
      case 5:
        attribute->add_floats(static_cast<float>(number()));
        break;
      case 6:
        attribute->add_ints(integer());
        break;
      case 7:
        attribute->add_strings(name());
        break;
      case 8:
        attribute->clear_ints();
        break;
      default:
        attribute->set_type(static_cast<int>(input_.integer(-1, 14)));
    }
  }

  void mutate(TensorProto* tensor) {
    switch (input_.byte() % 10) {
      case 0:
        tensor->set_name(name());
        break;
      case 1:
        tensor->add_dims(integer());
        break;
      case 2:
        if (tensor->dims_size() > 0) {
          tensor->set_dims(static_cast<int>(input_.integer(0, tensor->dims_size() - 1)), integer());
        }
        break;
      case 3:
        tensor->clear_dims();
        break;
      case 4:
        tensor->set_data_type(static_cast<int>(input_.integer(-1, 20)));
        break;
      case 5:
        tensor->add_float_data(static_cast<float>(number()));
        break;
      case 6:
        tensor->add_int64_data(integer());
        break;
      case 7:
        tensor->set_raw_data(input_.text(64));
        break;
      case 8:
        tensor->set_data_location(static_cast<int>(input_.integer(-1, 2)));
        break;
      default:
        replaceWeight(tensor->mutable_raw_data());
    }
  }

  void replaceWeight(std::string* raw) {
    const auto value = static_cast<float>(number());
    const auto at = static_cast<std::size_t>(input_.byte()) * sizeof(value);
    if (at + sizeof(value) <= raw->size())
      raw->replace(at, sizeof(value), reinterpret_cast<const char*>(&value), sizeof(value));
  }

  void mutate(onnx_subset::ValueInfoProto* value) {
    auto& type = *value->mutable_type()->mutable_tensor_type();
    switch (input_.byte() % 5) {
      case 0:
        value->set_name(name());
        break;
      case 1:
        type.set_elem_type(static_cast<int>(input_.integer(-1, 20)));
        break;
      case 2:
        type.mutable_shape()->add_dim()->set_dim_value(integer());
        break;
      case 3:
        type.clear_shape();
        break;
      default:
        if (type.shape().dim_size() > 0) {
          auto& extent =
              *type.mutable_shape()->mutable_dim(static_cast<int>(input_.integer(0, type.shape().dim_size() - 1)));
          extent.set_dim_value(integer());
        }
    }
  }

  void mutate(onnx_subset::StringStringEntryProto* entry) {
    if (input_.byte() % 8 == 0) {
      entry->set_key(name());
    } else {
      entry->set_value(input_.flag() ? input_.text(48) : std::to_string(number()));
    }
  }

  void mutate(onnx_subset::OperatorSetIdProto* opset) {
    if (input_.flag()) {
      opset->set_version(integer());
    } else {
      opset->set_domain(name());
    }
  }

  double number() {
    const double value = input_.number();
    return std::abs(value) > std::numeric_limits<float>::max() ? std::numeric_limits<double>::infinity() : value;
  }

  std::int64_t integer() {
    static constexpr std::array<std::int64_t, 8> kSpecial = {0,
                                                             -1,
                                                             1,
                                                             std::numeric_limits<std::int64_t>::max(),
                                                             std::numeric_limits<std::int64_t>::min(),
                                                             std::int64_t{1} << 31,
                                                             std::int64_t{1} << 32,
                                                             std::int64_t{1} << 62};
    return input_.flag() ? input_.integer(-8, 64) : input_.pick(kSpecial);
  }

  /// Often one that the graph has.
  std::string name() {
    const GraphProto& graph = model_.graph();
    const std::uint8_t kind = input_.byte();
    if (kind % 4 == 0 && graph.initializer_size() > 0) {
      return graph.initializer(static_cast<int>(input_.integer(0, graph.initializer_size() - 1))).name();
    }
    if (kind % 4 == 1 && graph.node_size() > 0) {
      const NodeProto& node = graph.node(static_cast<int>(input_.integer(0, graph.node_size() - 1)));
      if (node.output_size() > 0) return node.output(static_cast<int>(input_.integer(0, node.output_size() - 1)));
    }
    if (kind % 4 == 2 && graph.input_size() > 0) {
      return graph.input(static_cast<int>(input_.integer(0, graph.input_size() - 1))).name();
    }
    return input_.text(8);
  }

  FuzzInput& input_;
  ModelProto& model_;
};

constexpr int kSoundModels = 4;

/// The bytes of a file: the input's own, or a sound model with as many changes as the input tells.
std::string modelFile(const std::uint8_t* data, std::size_t size) {
  static const std::array<ModelProto, kSoundModels> sound = {soundModel(0), soundModel(1), soundModel(2),
                                                             soundModel(3)};
  FuzzInput input(data, size);
  const int kind = input.byte() % (kSoundModels + 1);
  if (kind == kSoundModels) return input.rest();
  ModelProto model = sound[static_cast<std::size_t>(kind)];
  ModelMutator mutator(&input, &model);
  constexpr int kMostChanges = 16;
  for (int change = 0; change < kMostChanges && !input.empty(); ++change) mutator.mutate();
  return model.SerializeAsString();
}

void readModel(const std::uint8_t* data, std::size_t size) {
  static ScratchFile file(".onnx");
  file.write(modelFile(data, size));
  expectRefusal<ModelFileError>([] {
    DrivePolicy policy = DrivePolicy::fromFile(file.path());
    // Weights may be so large that a sum of them is not finite.
    expectRefusal<std::invalid_argument>([&] {
      const Eigen::VectorXf& preferences = policy.advance(Observation());
      require(preferences.size() == policy.description().actions.size(), "each action has a preference");
      require(preferences.allFinite(), "preferences are finite");
    });
  });
}

const Registration registration("onnx", &readModel);

}  // namespace
}  // namespace lstm_planner::fuzz::onnx_harness
