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
};

TEST_F(ModelFileRefusals, NothingWhenNothingIsChanged) {
  EXPECT_EQ(refusalAfter([](ModelProto&) {}), "");
}

TEST_F(ModelFileRefusals, UnknownOperatorsAreNamed) {
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_2").set_op_type("Conv"); }), "\"Conv\"");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_2").set_domain("com.microsoft"); }),
                 "com.microsoft");
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

TEST_F(ModelFileRefusals, OperatorSetsOutsideTheReadOnes) {
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { file.clear_opset_import(); }), "operator set");
  for (const int version : {6, 23, -1}) {
    EXPECT_REFUSED(refusalAfter([&](ModelProto& file) { file.mutable_opset_import(0)->set_version(version); }),
                   "version " + std::to_string(version));
  }
}

TEST_F(ModelFileRefusals, WeightsThatAreNotFinite) {
  const float bad = std::numeric_limits<float>::quiet_NaN();
  EXPECT_REFUSED(refusalAfter([&](ModelProto& file) {
                   tensorNamed(file, "layer_1_recurrent_weights")
                       .mutable_raw_data()
                       ->replace(8, 4, reinterpret_cast<const char*>(&bad), 4);
                 }),
                 "\"layer_1_recurrent_weights\" holds nan at position 2");
}

TEST_F(ModelFileRefusals, TensorsWhoseDataDoNotFitTheirShape) {
  EXPECT_REFUSED(
      refusalAfter([](ModelProto& file) { tensorNamed(file, "layer_2_biases").mutable_raw_data()->pop_back(); }),
      "holds 15 bytes, expected 16");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { tensorNamed(file, "layer_2_biases").clear_raw_data(); }),
                 "holds 0 bytes");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { tensorNamed(file, "layer_2_biases").set_data_type(11); }),
                 "data type 11");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { tensorNamed(file, "layer_2_biases").set_data_location(1); }),
                 "another file");
}

TEST_F(ModelFileRefusals, EmptyNegativeAndAbsurdSizes) {
  for (const std::int64_t extent :
       {std::int64_t{0}, std::int64_t{-4}, std::int64_t{1} << 40, std::numeric_limits<std::int64_t>::max(),
        std::numeric_limits<std::int64_t>::min()}) {
    for (const char* name :
         {"layer_1_input_weights", "layer_1_recurrent_weights", "layer_1_biases", "layer_2_weights"}) {
      EXPECT_REFUSED(refusalAfter([&](ModelProto& file) { tensorNamed(file, name).set_dims(1, extent); }),
                     std::to_string(extent));
    }
    EXPECT_REFUSED(refusalAfter([&](ModelProto& file) {
                     auto& type = *file.mutable_graph()->mutable_input(0)->mutable_type()->mutable_tensor_type();
                     type.mutable_shape()->mutable_dim(1)->set_dim_value(extent);
                   }),
                   std::to_string(extent));
  }
}

TEST_F(ModelFileRefusals, WrongShapesNameBoth) {
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) {
                   auto& tensor = tensorNamed(file, "layer_1_input_weights");
                   tensor.set_dims(1, 3);
                   tensor.set_dims(2, 8);
                 }),
                 "input weights of the shape [1, 3, 8], expected [1, 8, 3]");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { tensorNamed(file, "layer_1_biases").set_dims(1, 8); }),
                 "biases of the shape [1, 8], expected [1, 16]");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) {
                   auto& tensor = tensorNamed(file, "layer_2_weights");
                   tensor.set_dims(0, 2);
                   tensor.set_dims(1, 4);
                 }),
                 "weights of the shape [2, 4]");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { tensorNamed(file, "layer_2_weights").clear_dims(); }),
                 "weights of the shape []");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { tensorNamed(file, "layer_1_recurrent_weights").clear_dims(); }),
                 "recurrent weights of the shape []");
}

TEST_F(ModelFileRefusals, ObservationsOfAnotherShape) {
  const auto setObservation = [](ModelProto& file, const std::vector<int>& extents) {
    auto& shape = *file.mutable_graph()->mutable_input(0)->mutable_type()->mutable_tensor_type()->mutable_shape();
    shape.clear_dim();
    for (const int extent : extents) shape.add_dim()->set_dim_value(extent);
  };
  EXPECT_REFUSED(refusalAfter([&](ModelProto& file) { setObservation(file, {1, 4}); }), "expected [1, 8, 4]");
  EXPECT_REFUSED(refusalAfter([&](ModelProto& file) { setObservation(file, {5, 3}); }), "one step of one robot");
  EXPECT_REFUSED(refusalAfter([&](ModelProto& file) { setObservation(file, {3, 1}); }), "along the last");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { file.mutable_graph()->mutable_input(0)->clear_type(); }),
                 "\"observation\"");
}

TEST_F(ModelFileRefusals, LstmsThatWeDoNotRun) {
  const auto afterAttribute = [&](const char* name, const std::function<void(onnx_subset::AttributeProto&)>& set) {
    return refusalAfter([&](ModelProto& file) { set(addAttribute(nodeNamed(file, "layer_1"), name)); });
  };
  EXPECT_REFUSED(afterAttribute("direction", [](auto& attribute) { attribute.set_s("bidirectional"); }),
                 "bidirectional");
  EXPECT_REFUSED(afterAttribute("direction", [](auto& attribute) { attribute.set_s("reverse"); }), "reverse");
  EXPECT_REFUSED(afterAttribute("clip", [](auto& attribute) { attribute.set_f(3.0f); }), "\"clip\"");
  EXPECT_REFUSED(afterAttribute("input_forget", [](auto& attribute) { attribute.set_i(1); }), "input_forget");
  EXPECT_REFUSED(afterAttribute("activations",
                                [](auto& attribute) {
                                  for (int gate = 0; gate < 3; ++gate) attribute.add_strings("Sigmoid");
                                }),
                 "expected Sigmoid for the gates");
  EXPECT_REFUSED(afterAttribute("hidden_size", [](auto& attribute) { attribute.set_i(2); }), "twice");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_1").mutable_attribute(0)->set_i(3); }),
                 "hidden_size = 3, expected 2");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_1").add_input("layer_2_biases"); }),
                 "peephole");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_1").set_input(4, "layer_2_biases"); }),
                 "sequence lengths");
}

TEST_F(ModelFileRefusals, GemmsThatWeDoNotRun) {
  for (const char* name : {"alpha", "beta"}) {
    EXPECT_REFUSED(refusalAfter([&](ModelProto& file) { addAttribute(nodeNamed(file, "layer_2"), name).set_f(0.5f); }),
                   std::string(name) + " = 0.5");
  }
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { addAttribute(nodeNamed(file, "layer_2"), "transA").set_i(1); }),
                 "transA = 1");
  EXPECT_REFUSED(
      refusalAfter([](ModelProto& file) { addAttribute(nodeNamed(file, "layer_2_tanh"), "alpha").set_f(2); }),
      "\"alpha\"");
}

TEST_F(ModelFileRefusals, SoftmaxOverAnotherAxis) {
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_3").mutable_attribute(0)->set_i(0); }),
                 "normalises [1] of [1, 4]");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_3").mutable_attribute(0)->set_i(7); }),
                 "the axis 7");
}

TEST_F(ModelFileRefusals, InputsThatNobodyGives) {
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_2").set_input(0, "nothing"); }),
                 "takes \"nothing\"");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_1").set_input(5, "nothing"); }),
                 "takes \"nothing\"");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_2").set_input(1, "observation"); }),
                 "a tensor stored in the file");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_1").set_input(2, ""); }),
                 "no recurrent weights");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { file.mutable_graph()->mutable_output(0)->set_name("nothing"); }),
                 "output takes \"nothing\"");
}

TEST_F(ModelFileRefusals, NodesInTheWrongOrder) {
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) {
                   auto& nodes = *file.mutable_graph()->mutable_node();
                   nodes.SwapElements(0, nodes.size() - 1);
                 }),
                 "expected a graph input or the result of a node before it");
}

TEST_F(ModelFileRefusals, GraphsThatAreNotOneChain) {
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_3").set_input(0, "layer_2"); }),
                 "one chain of layers");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { file.mutable_graph()->mutable_output()->DeleteSubrange(0, 1); }),
                 "is not an output of the graph");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { file.mutable_graph()->clear_node(); }), "no layers");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) {
                   auto& node = *file.mutable_graph()->add_node() = nodeNamed(file, "layer_2");
                   node.set_output(0, "preferences");
                 }),
                 "one chain of layers");
}

TEST_F(ModelFileRefusals, ActivationsThatDoNotFollowAGemm) {
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) {
                   auto& node = nodeNamed(file, "layer_3");
                   node.set_op_type("Relu");
                   node.clear_attribute();
                 }),
                 "does not follow a Gemm");
}

TEST_F(ModelFileRefusals, StatesThatAreSharedComputedOrNotZero) {
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_1").set_input(6, "layer_1_hidden"); }),
                 "used elsewhere");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_1").set_input(6, "layer_2_biases"); }),
                 "which is not zero");
}

TEST_F(ModelFileRefusals, NamesThatAreDefinedTwice) {
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { nodeNamed(file, "layer_2").set_output(0, "layer_1_hidden"); }),
                 "\"layer_1_hidden\" is defined twice");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) {
                   *file.mutable_graph()->add_initializer() = tensorNamed(file, "layer_2_biases");
                 }),
                 "\"layer_2_biases\" is defined twice");
  EXPECT_REFUSED(refusalAfter([](ModelProto& file) { *file.add_metadata_props() = file.metadata_props(0); }),
                 "\"key\" twice");
}

}  // namespace
}  // namespace lstm_planner::test_model_file_refusals
