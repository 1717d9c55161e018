#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "lstm_planner/base/network/instruction_set.hpp"
#include "lstm_planner/base/network/layers.hpp"

namespace lstm_planner {

/// Runs one network for many agents side by side: a step of all of them, each with a hidden state of its own. For
/// training and evaluation, where it takes less time an agent than Network does.
///
/// Single precision, within 1e-5 of double precision over a thousand steps, as Network is; the two differ in rounding.
/// An agent's results do not depend on how many others there are and what they see, and are the same bits from run to
/// run as long as the instruction set is the same. Hidden states start at zero and change only in forward(), reset(),
/// forget() and setHiddenState(). Nothing is allocated after construction, except by hiddenState() and for inputs that
/// are not stored as Values are. Copies share their weights. Not thread safe: one a thread.
class BatchNetwork {
 public:
  /// A row a value, a column an agent. A row's values lie side by side, as they are computed.
  using Values = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// Of one agent, in the order of Network::HiddenState: it may be handed on from one to the other.
  using HiddenState = Eigen::VectorXf;

  /// `batch` agents. Throws std::invalid_argument when the layers do not fit together (validateLayers), when weights
  /// are so large that a weighted sum may leave the range of float for any input, when there is no agent, or when `set`
  /// is not one of runnableInstructionSets().
  BatchNetwork(const LayerStack& layers, int batch, InstructionSet set = fastestInstructionSet());

  /// One step of all agents. `inputs` is inputSize() x batch(); the result is outputSize() x batch() and stays valid
  /// until the next call. Throws std::invalid_argument for a wrong size, a non-finite input, or one so large that a
  /// weighted sum could leave the range of float; all hidden states are then what they were before. Denormal inputs
  /// count as zero, and so do cell states below 1e-18.
  const Values& forward(const Eigen::Ref<const Values>& inputs);

  /// Sets the hidden states of all agents, or of one, to zero. Throws std::out_of_range when there is no such agent.
  void reset();
  void forget(int agent);

  /// Throws std::out_of_range when there is no such agent.
  HiddenState hiddenState(int agent) const;
  /// Also throws std::invalid_argument when the size is not hiddenStateSize(), or when a value is not finite or beyond
  /// 2^24, which no network's state gets to.
  void setHiddenState(int agent, const HiddenState& state);

  int batch() const { return static_cast<int>(outputs_.cols()); }
  int inputSize() const { return input_size_; }
  int outputSize() const { return static_cast<int>(outputs_.rows()); }
  int hiddenStateSize() const;
  InstructionSet instructionSet() const;
  std::size_t bytes() const;  ///< of what it holds, with the weights

 private:
  struct Program;  ///< the packed layers and the kernels that run them
  /// Memory that is aligned as the kernels want it.
  struct alignas(64) CacheLine {
    float values[16];
  };
  /// Agents whose values lie side by side; all tiles but the last are of the widest kind.
  struct Tile {
    int kernel;
    int lanes;  ///< more than agents where the agents are few
    int first_agent;
    int agents;
    std::size_t first_line;  ///< of its part of the memory
  };

  float* memoryOf(const Tile& tile) { return memory_[tile.first_line].values; }
  const float* memoryOf(const Tile& tile) const { return memory_[tile.first_line].values; }
  const Tile& tileOf(int agent) const;
  void requireUsable(const Eigen::Ref<const Values>& inputs) const;

  std::shared_ptr<const Program> program_;
  int input_size_ = 0;
  int widest_lanes_ = 0;
  std::vector<Tile> tiles_;
  std::vector<CacheLine> memory_;
  int parity_ = 0;  ///< of the next step's number
  Values outputs_;
};

}  // namespace lstm_planner
