#include "network/onnx_node.hpp"

#include <algorithm>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/network/model_file.hpp"

namespace lstm_planner::onnx {

using onnx_subset::AttributeProto;
using onnx_subset::NodeProto;
using onnx_subset::TensorProto;

Node::Node(const NodeProto& node, const Constants& constants) : node_(node), constants_(constants) {
  // The name of a node is optional in ONNX, that of its first output is not.
  name_ = "node " + quoted(node.name().empty() ? output(0) : node.name()) + " (" + node.op_type() + ")";
  std::set<std::string> names;
  for (const AttributeProto& attribute : node.attribute()) {
    if (!names.insert(attribute.name()).second) {
      throw ModelFileError(name_ + " has the attribute " + quoted(attribute.name()) + " twice, expected once");
    }
  }
}

std::string Node::input(int index) const { return index < node_.input_size() ? node_.input(index) : std::string(); }

std::string Node::output(int index) const { return index < node_.output_size() ? node_.output(index) : std::string(); }

const TensorProto* Node::constant(int index, const std::string& role) const {
  const std::string tensor_name = input(index);
  if (tensor_name.empty()) return nullptr;
  const auto found = constants_.find(tensor_name);
  if (found == constants_.end()) {
    throw ModelFileError(name_ + " takes its " + role + " from " + quoted(tensor_name) +
                         ", expected a tensor stored in the file");
  }
  return found->second;
}

const TensorProto& Node::requiredConstant(int index, const std::string& role) const {
  const TensorProto* tensor = constant(index, role);
  if (tensor == nullptr) throw ModelFileError(name_ + " has no " + role + ", expected a tensor stored in the file");
  return *tensor;
}

void Node::refuseInput(int index, const std::string& role) const {
  if (!input(index).empty())
    throw ModelFileError(name_ + " has " + role + ", which the planner does not know how to run");
}

const AttributeProto* Node::find(const std::string& name) {
  understood_.insert(name);
  const auto found = std::find_if(node_.attribute().begin(), node_.attribute().end(),
                                  [&](const AttributeProto& attribute) { return attribute.name() == name; });
  return found == node_.attribute().end() ? nullptr : &*found;
}

std::int64_t Node::integer(const std::string& name, std::int64_t absent) {
  const AttributeProto* attribute = find(name);
  return attribute == nullptr ? absent : attribute->i();
}

std::string Node::text(const std::string& name, const std::string& absent) {
  const AttributeProto* attribute = find(name);
  return attribute == nullptr ? absent : attribute->s();
}

std::vector<std::int64_t> Node::integers(const std::string& name) {
  const AttributeProto* attribute = find(name);
  if (attribute == nullptr) return {};
  return {attribute->ints().begin(), attribute->ints().end()};
}

std::vector<std::string> Node::texts(const std::string& name, const std::vector<std::string>& absent) {
  const AttributeProto* attribute = find(name);
  if (attribute == nullptr) return absent;
  return {attribute->strings().begin(), attribute->strings().end()};
}

const TensorProto* Node::tensor(const std::string& name) {
  const AttributeProto* attribute = find(name);
  return attribute != nullptr && attribute->has_t() ? &attribute->t() : nullptr;
}

void Node::requireInteger(const std::string& name, std::int64_t expected) {
  const std::int64_t value = integer(name, expected);
  if (value != expected) {
    throw ModelFileError(name_ + " has " + name + " = " + std::to_string(value) + ", expected " +
                         std::to_string(expected));
  }
}

void Node::requireReal(const std::string& name, float expected) {
  const AttributeProto* attribute = find(name);
  if (attribute != nullptr && !(attribute->f() == expected)) {
    throw ModelFileError(name_ + " has " + name + " = " + numberText(attribute->f()) + ", expected " +
                         numberText(expected));
  }
}

void Node::finish() const {
  for (const AttributeProto& attribute : node_.attribute()) {
    if (understood_.count(attribute.name()) == 0) {
      throw ModelFileError(name_ + " has the attribute " + quoted(attribute.name()) +
                           ", which the planner does not know how to run");
    }
  }
}

}  // namespace lstm_planner::onnx
