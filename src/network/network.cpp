#include "lstm_planner/network/network.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "network/denormals_are_zero.hpp"
#include "network/packed_network.hpp"

namespace lstm_planner {
namespace {

using Eigen::VectorXf;
using ConstValues = Eigen::Ref<const VectorXf>;

}  // namespace

Network::Network(const LayerStack& layers, InstructionSet set)
    : instruction_set_(set),
      packed_(std::make_shared<const PackedNetwork>(layers, set)),
      memories_(2 * packed_->memorySize() / kFloatsALine),
      input_size_(lstm_planner::inputSize(layers)),
      weights_(countWeights(layers)),
      output_(VectorXf::Zero(lstm_planner::outputSize(layers))) {
  reset();
}

Network::Network(const Network& other) = default;
Network::Network(Network&&) noexcept = default;
Network& Network::operator=(const Network& other) = default;
Network& Network::operator=(Network&&) noexcept = default;
Network::~Network() = default;

const float* Network::memory(std::size_t which) const {
  return reinterpret_cast<const float*>(memories_.data()) + which * packed_->memorySize();
}
float* Network::memory(std::size_t which) {
  return reinterpret_cast<float*>(memories_.data()) + which * packed_->memorySize();
}

const VectorXf& Network::forward(const ConstValues& input) {
  if (input.size() != input_size_) {
    throw std::invalid_argument("the network's input has " + std::to_string(input.size()) + " values, expected " +
                                std::to_string(input_size_));
  }
  const DenormalsAreZero mode;
  if (!packed_->step(input.data(), memory(now_), memory(1 - now_), output_.data())) {
    if (!input.allFinite()) throw std::invalid_argument("the network's input holds a value that is not finite");
    throw std::invalid_argument("the network's input is too large: a weighted sum of it is not finite");
  }
  now_ = 1 - now_;
  return output_;
}

void Network::reset() {
  std::fill_n(memory(now_), packed_->hiddenStateSize(), 0.0f);
  const DenormalsAreZero mode;
  packed_->prepare(memory(now_));
}

Eigen::Map<const Network::HiddenState> Network::hiddenState() const {
  return {memory(now_), static_cast<Eigen::Index>(packed_->hiddenStateSize())};
}

void Network::setHiddenState(const Eigen::Ref<const HiddenState>& state) {
  const auto expected = static_cast<Eigen::Index>(packed_->hiddenStateSize());
  if (state.size() != expected) {
    throw std::invalid_argument("the hidden state has " + std::to_string(state.size()) + " values, expected " +
                                std::to_string(expected));
  }
  if (!state.allFinite()) throw std::invalid_argument("the hidden state holds a value that is not finite");
  std::copy_n(state.data(), state.size(), memory(now_));
  const DenormalsAreZero mode;
  packed_->prepare(memory(now_));
}

}  // namespace lstm_planner
