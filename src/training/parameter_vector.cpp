#include "lstm_planner/training/parameter_vector.hpp"

#include <stdexcept>
#include <string>

namespace lstm_planner {
namespace {

/// Calls visit(matrix or vector, is a weight) for all parameters of a stack in their order.
template <typename Stack, typename Visitor>
void visitParameters(Stack& layers, Visitor visit) {
  for (auto& layer : layers) {
    std::visit(
        [&visit](auto& known) {
          using Known = std::decay_t<decltype(known)>;
          if constexpr (std::is_same_v<Known, LstmLayer> || std::is_same_v<Known, RecurrentLayer>) {
            visit(known.input, true);
            visit(known.recurrent, true);
            visit(known.bias, false);
          } else if constexpr (std::is_same_v<Known, DenseLayer>) {
            visit(known.weights, true);
            visit(known.bias, false);
          }
        },
        layer);
  }
}

Eigen::Index parameterVectorSize(const LayerStack& layers) {
  Eigen::Index size = 0;
  visitParameters(layers, [&size](const auto& values, bool) { size += values.size(); });
  return size;
}

}  // namespace

Eigen::VectorXf parameterVector(const LayerStack& layers) {
  Eigen::VectorXf parameters(parameterVectorSize(layers));
  Eigen::Index first = 0;
  visitParameters(layers, [&](const auto& values, bool) {
    parameters.segment(first, values.size()) = Eigen::Map<const Eigen::VectorXf>(values.data(), values.size());
    first += values.size();
  });
  return parameters;
}

void setParameterVector(const Eigen::VectorXf& parameters, LayerStack& layers) {
  const Eigen::Index size = parameterVectorSize(layers);
  if (parameters.size() != size) {
    throw std::invalid_argument("parameter vector has " + std::to_string(parameters.size()) +
                                " values, the layers expect " + std::to_string(size));
  }
  Eigen::Index first = 0;
  visitParameters(layers, [&](auto& values, bool) {
    Eigen::Map<Eigen::VectorXf>(values.data(), values.size()) = parameters.segment(first, values.size());
    first += values.size();
  });
}

Eigen::VectorXf weightMask(const LayerStack& layers) {
  Eigen::VectorXf mask(parameterVectorSize(layers));
  Eigen::Index first = 0;
  visitParameters(layers, [&](const auto& values, bool is_weight) {
    mask.segment(first, values.size()).setConstant(is_weight ? 1.0f : 0.0f);
    first += values.size();
  });
  return mask;
}

}  // namespace lstm_planner
