#include "lstm_planner/network/network.hpp"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "network/packed_network.hpp"

namespace lstm_planner {
namespace {

/// While it lives, this thread's processor takes denormal numbers for zero and makes none. Where a state fades they
/// would otherwise appear, and each product with them takes as long as hundreds of others.
class DenormalsAreZero {
 public:
#if defined(__SSE2__)
  DenormalsAreZero() : before_(_mm_getcsr()) { _mm_setcsr(before_ | kFlushToZero | kDenormalsAreZero); }
  ~DenormalsAreZero() { _mm_setcsr(before_); }
#elif defined(__aarch64__)
  DenormalsAreZero() {
    __asm__ volatile("mrs %0, fpcr" : "=r"(before_));
    __asm__ volatile("msr fpcr, %0" : : "r"(before_ | kFlushToZero));
  }
  ~DenormalsAreZero() { __asm__ volatile("msr fpcr, %0" : : "r"(before_)); }
#else
  DenormalsAreZero() = default;
  ~DenormalsAreZero() {}
#endif
  DenormalsAreZero(const DenormalsAreZero&) = delete;
  DenormalsAreZero& operator=(const DenormalsAreZero&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr unsigned kFlushToZero = 0x8000;
  static constexpr unsigned kDenormalsAreZero = 0x0040;
  unsigned before_;
#elif defined(__aarch64__)
  static constexpr std::uint64_t kFlushToZero = 1u << 24;
  std::uint64_t before_;
#endif
};

using Eigen::VectorXf;
using ConstValues = Eigen::Ref<const VectorXf>;

}  // namespace

Network::Network(const LayerStack& layers, InstructionSet set, int sequences)
    : packed_(std::make_shared<const PackedNetwork>(layers, set)),
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

}  // namespace lstm_planner
