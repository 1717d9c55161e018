#include <functional>
#include <limits>

#include "unit/network/model_file_fixtures.hpp"
#include "unit/network/network_fixtures.hpp"

namespace lstm_planner::test_model_file_refusals {
namespace {

using onnx_subset::ModelProto;
using test::addAttribute;
using test::LayerMaker;
using test::nodeNamed;
using test::tensorNamed;

/// layer_1: LSTM 3 -> 2, layer_2: dense 2 -> 4 with tanh, layer_3: softmax.
class ModelFileRefusals : public test::ModelFileTest {
 protected:
  std::string refusalAfter(const std::function<void(ModelProto&)>& change) {
    LayerMaker make(1);
    ModelProto file =
        written({{make.lstm(3, 2), make.dense(2, 4, Activation::kTanh), SoftmaxLayer{}}, {{"key", "value"}}});
    change(file);
    return refusal(file);
  }

  /// Whether the file is refused after a change, with a sentence that says `part`.
  void refuses(const std::string& part, const std::function<void(ModelProto&)>& change) {
    EXPECT_REFUSED(refusalAfter(change), part);
  }
};

TEST_F(ModelFileRefusals, NothingWhenNothingIsChanged) {
  EXPECT_EQ(refusalAfter([](ModelProto&) {}), "");
}

TEST_F(ModelFileRefusals, UnknownOperatorsAreNamed) {
  refuses("\"Conv\"", [](ModelProto& file) { nodeNamed(file, "layer_2").set_op_type("Conv"); });
  refuses("com.microsoft", [](ModelProto& file) { nodeNamed(file, "layer_2").set_domain("com.microsoft"); });
}

TEST_F(ModelFileRefusals, AllUnknownOperatorsAndInputsAreNamedTogetherTheOperatorsFirst) {
  const std::string said = refusalAfter([](ModelProto& file) {
    nodeNamed(file, "layer_1").set_op_type("GRU");  // exported with a sequence of 5
    nodeNamed(file, "layer_2").set_op_type("Conv");
    auto& type = *file.mutable_graph()->mutable_input(0)->mutable_type()->mutable_tensor_type();
    type.mutable_shape()->mutable_dim(0)->set_dim_value(5);
  });
  EXPECT_EQ(
      said.find("model file " + path_ + ": the operators \"Conv\", \"GRU\" are not known to the planner, expected"), 0u)
      << said;
  EXPECT_NE(said.find("; graph input \"observation\" has the shape [5, 3], expected one step of one robot"),
            std::string::npos)
      << said;
}

TEST_F(ModelFileRefusals, StatesOfSeveralLayersOfNoUnits) {
  refuses("graph input \"states\" has the shape [2, 1, 0], expected between 1", [](ModelProto& file) {
    auto& input = *file.mutable_graph()->add_input();
    input.set_name("states");
    auto& type = *input.mutable_type()->mutable_tensor_type();
    type.set_elem_type(1);
    for (const int extent : {2, 1, 0}) type.mutable_shape()->add_dim()->set_dim_value(extent);
  });
}

TEST_F(ModelFileRefusals, OperatorSetsOutsideTheReadOnes) {
  refuses("operator set", [](ModelProto& file) { file.clear_opset_import(); });
  for (const int version : {6, 23, -1}) {
    refuses("version " + std::to_string(version),
            [&](ModelProto& file) { file.mutable_opset_import(0)->set_version(version); });
  }
}

TEST_F(ModelFileRefusals, WeightsThatAreNotFinite) {
  const float bad = std::numeric_limits<float>::quiet_NaN();
  refuses("\"layer_1_recurrent_weights\" holds nan at position 2", [&](ModelProto& file) {
    tensorNamed(file, "layer_1_recurrent_weights")
        .mutable_raw_data()
        ->replace(8, 4, reinterpret_cast<const char*>(&bad), 4);
  });
}

TEST_F(ModelFileRefusals, TensorsWhoseDataDoNotFitTheirShape) {
  refuses("holds 15 bytes, expected 16",
          [](ModelProto& file) { tensorNamed(file, "layer_2_biases").mutable_raw_data()->pop_back(); });
  refuses("holds 0 bytes", [](ModelProto& file) { tensorNamed(file, "layer_2_biases").clear_raw_data(); });
  refuses("data type 11", [](ModelProto& file) { tensorNamed(file, "layer_2_biases").set_data_type(11); });
  refuses("has its data in another file, expected them in this one: export with external_data=False, or dynamo=False",
          [](ModelProto& file) { tensorNamed(file, "layer_2_biases").set_data_location(1); });
}

TEST_F(ModelFileRefusals, EmptyNegativeAndAbsurdSizes) {
  for (const std::int64_t extent :
       {std::int64_t{0}, std::int64_t{-4}, std::int64_t{1} << 40, std::numeric_limits<std::int64_t>::max(),
        std::numeric_limits<std::int64_t>::min()}) {
    for (const char* name :
         {"layer_1_input_weights", "layer_1_recurrent_weights", "layer_1_biases", "layer_2_weights"}) {
      refuses(std::to_string(extent), [&](ModelProto& file) { tensorNamed(file, name).set_dims(1, extent); });
    }
    refuses(std::to_string(extent), [&](ModelProto& file) {
      auto& type = *file.mutable_graph()->mutable_input(0)->mutable_type()->mutable_tensor_type();
      type.mutable_shape()->mutable_dim(1)->set_dim_value(extent);
    });
  }
}

TEST_F(ModelFileRefusals, WrongShapesNameBoth) {
  refuses("input weights of the shape [1, 3, 8], expected [1, 8, 3]", [](ModelProto& file) {
    auto& tensor = tensorNamed(file, "layer_1_input_weights");
    tensor.set_dims(1, 3);
    tensor.set_dims(2, 8);
  });
  refuses("biases of the shape [1, 8], expected [1, 16]",
          [](ModelProto& file) { tensorNamed(file, "layer_1_biases").set_dims(1, 8); });
  refuses("weights of the shape [2, 4]", [](ModelProto& file) {
    auto& tensor = tensorNamed(file, "layer_2_weights");
    tensor.set_dims(0, 2);
    tensor.set_dims(1, 4);
  });
  refuses("weights of the shape []", [](ModelProto& file) { tensorNamed(file, "layer_2_weights").clear_dims(); });
  refuses("recurrent weights of the shape []",
          [](ModelProto& file) { tensorNamed(file, "layer_1_recurrent_weights").clear_dims(); });
}

TEST_F(ModelFileRefusals, ObservationsOfAnotherShape) {
  const auto setObservation = [](ModelProto& file, const std::vector<int>& extents) {
    auto& shape = *file.mutable_graph()->mutable_input(0)->mutable_type()->mutable_tensor_type()->mutable_shape();
    shape.clear_dim();
    for (const int extent : extents) shape.add_dim()->set_dim_value(extent);
  };
  refuses("expected [1, 8, 4]", [&](ModelProto& file) { setObservation(file, {1, 4}); });
  refuses("one step of one robot", [&](ModelProto& file) { setObservation(file, {5, 3}); });
  refuses("along the last", [&](ModelProto& file) { setObservation(file, {3, 1}); });
  refuses("\"observation\"", [](ModelProto& file) { file.mutable_graph()->mutable_input(0)->clear_type(); });
}

TEST_F(ModelFileRefusals, LstmsThatWeDoNotRun) {
  const auto refusesAttribute = [&](const std::string& part, const char* name,
                                    const std::function<void(onnx_subset::AttributeProto&)>& set) {
    refuses(part, [&](ModelProto& file) { set(addAttribute(nodeNamed(file, "layer_1"), name)); });
  };
  refusesAttribute("bidirectional", "direction", [](auto& attribute) { attribute.set_s("bidirectional"); });
  refusesAttribute("reverse", "direction", [](auto& attribute) { attribute.set_s("reverse"); });
  refusesAttribute("\"clip\"", "clip", [](auto& attribute) { attribute.set_f(3.0f); });
  refusesAttribute("input_forget", "input_forget", [](auto& attribute) { attribute.set_i(1); });
  refusesAttribute("expected Sigmoid for the gates", "activations", [](auto& attribute) {
    for (int gate = 0; gate < 3; ++gate) attribute.add_strings("Sigmoid");
  });
  refusesAttribute("twice", "hidden_size", [](auto& attribute) { attribute.set_i(2); });
  refuses("hidden_size = 3, expected 2",
          [](ModelProto& file) { nodeNamed(file, "layer_1").mutable_attribute(0)->set_i(3); });
  refuses("peephole", [](ModelProto& file) { nodeNamed(file, "layer_1").add_input("layer_2_biases"); });
  refuses("sequence lengths", [](ModelProto& file) { nodeNamed(file, "layer_1").set_input(4, "layer_2_biases"); });
}

TEST_F(ModelFileRefusals, GemmsThatWeDoNotRun) {
  for (const char* name : {"alpha", "beta"}) {
    refuses(std::string(name) + " = 0.5",
            [&](ModelProto& file) { addAttribute(nodeNamed(file, "layer_2"), name).set_f(0.5f); });
  }
  refuses("transA = 1", [](ModelProto& file) { addAttribute(nodeNamed(file, "layer_2"), "transA").set_i(1); });
  refuses("\"alpha\"", [](ModelProto& file) { addAttribute(nodeNamed(file, "layer_2_tanh"), "alpha").set_f(2); });
}

TEST_F(ModelFileRefusals, SoftmaxOverAnotherAxis) {
  refuses("normalises [1] of [1, 4]",
          [](ModelProto& file) { nodeNamed(file, "layer_3").mutable_attribute(0)->set_i(0); });
  refuses("the axis 7", [](ModelProto& file) { nodeNamed(file, "layer_3").mutable_attribute(0)->set_i(7); });
}

TEST_F(ModelFileRefusals, InputsThatNobodyGives) {
  refuses("takes \"nothing\"", [](ModelProto& file) { nodeNamed(file, "layer_2").set_input(0, "nothing"); });
  refuses("takes \"nothing\"", [](ModelProto& file) { nodeNamed(file, "layer_1").set_input(5, "nothing"); });
  refuses("a tensor stored in the file",
          [](ModelProto& file) { nodeNamed(file, "layer_2").set_input(1, "observation"); });
  refuses("no recurrent weights", [](ModelProto& file) { nodeNamed(file, "layer_1").set_input(2, ""); });
  refuses("output takes \"nothing\"",
          [](ModelProto& file) { file.mutable_graph()->mutable_output(0)->set_name("nothing"); });
}

TEST_F(ModelFileRefusals, NodesInTheWrongOrder) {
  refuses("expected a graph input or the result of a node before it", [](ModelProto& file) {
    auto& nodes = *file.mutable_graph()->mutable_node();
    nodes.SwapElements(0, nodes.size() - 1);
  });
}

TEST_F(ModelFileRefusals, GraphsThatAreNotOneChain) {
  refuses("one chain of layers", [](ModelProto& file) { nodeNamed(file, "layer_3").set_input(0, "layer_2"); });
  refuses("is not an output of the graph",
          [](ModelProto& file) { file.mutable_graph()->mutable_output()->DeleteSubrange(0, 1); });
  refuses("no layers", [](ModelProto& file) { file.mutable_graph()->clear_node(); });
  refuses("one chain of layers", [](ModelProto& file) {
    auto& node = *file.mutable_graph()->add_node() = nodeNamed(file, "layer_2");
    node.set_output(0, "preferences");
  });
}

TEST_F(ModelFileRefusals, ActivationsThatDoNotFollowAGemm) {
  refuses("does not follow a Gemm", [](ModelProto& file) {
    auto& node = nodeNamed(file, "layer_3");
    node.set_op_type("Relu");
    node.clear_attribute();
  });
}

TEST_F(ModelFileRefusals, StatesThatAreSharedComputedOrNotZero) {
  refuses("used elsewhere", [](ModelProto& file) { nodeNamed(file, "layer_1").set_input(6, "layer_1_hidden"); });
  refuses("which is not zero", [](ModelProto& file) { nodeNamed(file, "layer_1").set_input(6, "layer_2_biases"); });
}

TEST_F(ModelFileRefusals, NamesThatAreDefinedTwice) {
  refuses("\"layer_1_hidden\" is defined twice",
          [](ModelProto& file) { nodeNamed(file, "layer_2").set_output(0, "layer_1_hidden"); });
  refuses("\"layer_2_biases\" is defined twice",
          [](ModelProto& file) { *file.mutable_graph()->add_initializer() = tensorNamed(file, "layer_2_biases"); });
  refuses("\"key\" twice", [](ModelProto& file) { *file.add_metadata_props() = file.metadata_props(0); });
}

}  // namespace
}  // namespace lstm_planner::test_model_file_refusals
