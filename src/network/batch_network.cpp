#include "lstm_planner/network/batch_network.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "network/batch_layers.hpp"

namespace lstm_planner {
namespace {

constexpr std::size_t kLineFloats = 16;

const BatchKernels& kernelsOf(InstructionSet set) {
  const std::vector<InstructionSet>& runnable = runnableInstructionSets();
  if (std::find(runnable.begin(), runnable.end(), set) == runnable.end()) {
    throw std::invalid_argument(std::string("this machine cannot run the instruction set ") + toString(set));
  }
#if defined(__x86_64__)
  if (set == InstructionSet::kAvx512) return kBatchKernelsAvx512;
  if (set == InstructionSet::kAvx2) return kBatchKernelsAvx2;
#endif
  return kBatchKernelsBaseline;
}

/// The narrowest tile that holds all, or the widest.
int chooseTile(const BatchKernels& kernels, int agents) {
  int tile = 0;
  while (tile + 1 < kernels.count && kernels.tiles[tile].lanes < agents) ++tile;
  return tile;
}

float withoutDenormals(float value) { return std::abs(value) < std::numeric_limits<float>::min() ? 0.0f : value; }

/// Whether one row follows the other in memory: one long loop over all numbers is faster than a short one for each row.
bool isOnePiece(const Eigen::Ref<const BatchNetwork::Values>& inputs) { return inputs.outerStride() == inputs.cols(); }

bool allWithin(const float* values, Eigen::Index count, float limit) {
  int refused = 0;  // counted, as a loop without an exit is vectorised
  for (Eigen::Index i = 0; i < count; ++i) refused += std::abs(values[i]) <= limit ? 0 : 1;
  return refused == 0;
}

}  // namespace

struct BatchNetwork::Program {
  BatchLayers packed;
  const BatchKernels& kernels;
};

BatchNetwork::BatchNetwork(const LayerStack& layers, int batch, InstructionSet set)
    : program_(std::make_shared<Program>(Program{packBatchLayers(layers), kernelsOf(set)})),
      input_size_(lstm_planner::inputSize(layers)) {
  if (batch < 1) throw std::invalid_argument("a batch has " + std::to_string(batch) + " agents, expected at least 1");
  const BatchKernels& kernels = program_->kernels;
  widest_lanes_ = kernels.tiles[kernels.count - 1].lanes;
  std::size_t lines = 0;
  for (int agent = 0; agent < batch;) {
    const int kernel = chooseTile(kernels, batch - agent);
    const int lanes = kernels.tiles[kernel].lanes;
    tiles_.push_back({kernel, lanes, agent, std::min(lanes, batch - agent), lines});
    agent += lanes;
    const std::size_t floats = static_cast<std::size_t>(program_->packed.rows) * static_cast<std::size_t>(lanes);
    lines += (floats + kLineFloats - 1) / kLineFloats;
  }
  memory_.resize(lines);
  outputs_.setZero(lstm_planner::outputSize(layers), batch);
  reset();
}

int BatchNetwork::hiddenStateSize() const { return static_cast<int>(program_->packed.state_rows[parity_].size()); }

std::size_t BatchNetwork::bytes() const {
  const BatchLayers& packed = program_->packed;
  const std::size_t floats = packed.weights.size() + static_cast<std::size_t>(outputs_.size());
  const std::size_t state_rows = 2 * packed.state_rows[0].size();
  return sizeof(*this) + sizeof(Program) + packed.layers.size() * sizeof(BatchLayer) + state_rows * sizeof(int) +
         floats * sizeof(float) + memory_.size() * sizeof(CacheLine) + tiles_.size() * sizeof(Tile);
}

const BatchNetwork::Values& BatchNetwork::forward(const Eigen::Ref<const Values>& inputs) {
  requireUsable(inputs);
  const BatchLayers& packed = program_->packed;
  const int output_row = packed.layers.back().output_row[parity_];
  for (const Tile& tile : tiles_) {
    float* const memory = memoryOf(tile);
    const bool is_filled_at_once = tile.agents == tile.lanes && tile.lanes == batch() && isOnePiece(inputs);
    if (is_filled_at_once) std::transform(inputs.data(), inputs.data() + inputs.size(), memory, withoutDenormals);
    for (int row = is_filled_at_once ? input_size_ : 0; row < input_size_; ++row) {
      const float* const values = inputs.data() + row * inputs.outerStride() + tile.first_agent;
      std::transform(values, values + tile.agents, memory + row * tile.lanes, withoutDenormals);
    }
    program_->kernels.tiles[tile.kernel].step(packed.layers.data(), static_cast<int>(packed.layers.size()),
                                              packed.weights.data(), parity_, memory);
    for (int row = 0; row < outputSize(); ++row) {
      std::copy_n(memory + (output_row + row) * tile.lanes, tile.agents, &outputs_(row, tile.first_agent));
    }
  }
  parity_ = 1 - parity_;
  return outputs_;
}

void BatchNetwork::requireUsable(const Eigen::Ref<const Values>& inputs) const {
  if (inputs.rows() != input_size_ || inputs.cols() != batch()) {
    throw std::invalid_argument("the batch's inputs are " + std::to_string(inputs.rows()) + " x " +
                                std::to_string(inputs.cols()) + " values, expected " + std::to_string(input_size_) +
                                " x " + std::to_string(batch()));
  }
  const float limit = program_->packed.input_limit;
  if (isOnePiece(inputs) && allWithin(inputs.data(), inputs.size(), limit)) return;
  for (Eigen::Index row = 0; row < inputs.rows(); ++row) {
    const float* const values = inputs.data() + row * inputs.outerStride();
    if (allWithin(values, inputs.cols(), limit)) continue;
    Eigen::Index agent = 0;
    while (std::abs(values[agent]) <= limit) ++agent;
    const std::string place =
        "input " + std::to_string(row) + " of agent " + std::to_string(agent) + " of the batch is ";
    if (!std::isfinite(values[agent])) throw std::invalid_argument(place + "not finite");
    throw std::invalid_argument(place + std::to_string(values[agent]) +
                                ", so large that a weighted sum of it may not be finite");
  }
}

const BatchNetwork::Tile& BatchNetwork::tileOf(int agent) const {
  if (agent < 0 || agent >= batch()) {
    throw std::out_of_range("the batch has no agent " + std::to_string(agent) + ", but " + std::to_string(batch()) +
                            " counted from 0");
  }
  return tiles_[static_cast<std::size_t>(agent / widest_lanes_)];
}

void BatchNetwork::reset() { std::fill(memory_.begin(), memory_.end(), CacheLine{}); }

BatchNetwork::HiddenState BatchNetwork::hiddenState(int agent) const {
  const Tile& tile = tileOf(agent);
  const float* const lane = memoryOf(tile) + agent - tile.first_agent;
  HiddenState state(hiddenStateSize());
  float* value = state.data();
  for (const int row : program_->packed.state_rows[parity_]) *value++ = lane[row * tile.lanes];
  return state;
}

void BatchNetwork::setHiddenState(int agent, const HiddenState& state) {
  const Tile& tile = tileOf(agent);
  if (state.size() != hiddenStateSize()) {
    throw std::invalid_argument("the hidden state has " + std::to_string(state.size()) + " values, expected " +
                                std::to_string(hiddenStateSize()));
  }
  for (Eigen::Index i = 0; i < state.size(); ++i) {
    const float value = state[i];
    if (std::abs(value) <= kLargestState) continue;
    throw std::invalid_argument("the hidden state holds " + std::to_string(value) + ", expected -2^24 to 2^24");
  }
  float* const lane = memoryOf(tile) + agent - tile.first_agent;
  const float* value = state.data();
  for (const int row : program_->packed.state_rows[parity_]) lane[row * tile.lanes] = *value++;
}

}  // namespace lstm_planner
