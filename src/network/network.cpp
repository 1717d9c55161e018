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

Network::Network(const LayerStack& layers, InstructionSet set, int sequences)
    : instruction_set_(set),
      packed_(std::make_shared<const PackedNetwork>(layers, set)),
      input_size_(lstm_planner::inputSize(layers)),
      weights_(countWeights(layers)),
      output_(VectorXf::Zero(lstm_planner::outputSize(layers))) {
  if (sequences < 1) {
    throw std::invalid_argument("a network has " + std::to_string(sequences) + " sequences, expected at least 1");
  }
  const std::size_t lines = packed_->memorySize() / kFloatsALine;
  for (int place = 0; place <= sequences; ++place) places_.push_back(static_cast<std::size_t>(place) * lines);
  memories_.resize(places_.size() * lines);
  reset();
}

Network::Network(const Network& other) = default;
Network::Network(Network&&) noexcept = default;
Network& Network::operator=(const Network& other) = default;
Network& Network::operator=(Network&&) noexcept = default;
Network::~Network() = default;

std::size_t Network::placeOf(int sequence) const {
  if (sequence >= 0 && sequence < sequences()) return places_[static_cast<std::size_t>(sequence)];
  throw std::out_of_range("the network has no sequence " + std::to_string(sequence) + ", but " +
                          std::to_string(sequences()) + " counted from 0");
}

const float* Network::memory(std::size_t place) const {
  return reinterpret_cast<const float*>(memories_.data() + place);
}
float* Network::memory(std::size_t place) { return reinterpret_cast<float*>(memories_.data() + place); }

const VectorXf& Network::forward(const ConstValues& input, int sequence) {
  if (input.size() != input_size_) {
    throw std::invalid_argument("the network's input has " + std::to_string(input.size()) + " values, expected " +
                                std::to_string(input_size_));
  }
  const float* now = memory(placeOf(sequence));
  const DenormalsAreZero mode;
  if (!packed_->step(input.data(), now, memory(places_.back()), output_.data())) {
    if (!input.allFinite()) throw std::invalid_argument("the network's input holds a value that is not finite");
    throw std::invalid_argument("the network's input is too large: a weighted sum of it is not finite");
  }
  std::swap(places_[static_cast<std::size_t>(sequence)], places_.back());
  return output_;
}

void Network::reset() {
  const DenormalsAreZero mode;
  for (int sequence = 0; sequence < sequences(); ++sequence) {
    float* state = memory(placeOf(sequence));
    std::fill_n(state, packed_->hiddenStateSize(), 0.0f);
    packed_->prepare(state);
  }
}

std::size_t Network::stateBytes() const { return memories_.size() * sizeof(CacheLine); }

Eigen::Map<const Network::HiddenState> Network::hiddenState(int sequence) const {
  return {memory(placeOf(sequence)), static_cast<Eigen::Index>(packed_->hiddenStateSize())};
}

void Network::setHiddenState(const Eigen::Ref<const HiddenState>& state, int sequence) {
  const auto expected = static_cast<Eigen::Index>(packed_->hiddenStateSize());
  if (state.size() != expected) {
    throw std::invalid_argument("the hidden state has " + std::to_string(state.size()) + " values, expected " +
                                std::to_string(expected));
  }
  if (!state.allFinite()) throw std::invalid_argument("the hidden state holds a value that is not finite");
  float* own = memory(placeOf(sequence));
  std::copy_n(state.data(), state.size(), own);
  const DenormalsAreZero mode;
  packed_->prepare(own);
}

}  // namespace lstm_planner
