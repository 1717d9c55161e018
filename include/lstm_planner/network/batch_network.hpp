#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "lstm_planner/network/instruction_set.hpp"
#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

/// Runs one network for many agents at once. Each agent has its own hidden state. For training and evaluation; it takes
/// less time for each agent than Network.
///
/// Single precision, within 1e-5 of double precision over a thousand steps, like Network; the rounding of the two
/// differs. The results of an agent do not depend on the other agents. They are the same bits in every run with the
/// same instruction set. Hidden states start at zero and change only in forward(), reset(), forget() and
/// setHiddenState(). Nothing is allocated after construction, except by hiddenState(), and for inputs that are not
/// stored as Values are. Copies share their weights. Not thread safe: use one for each thread.
class BatchNetwork {
 public:
  /// A row for each value, a column for each agent. The values of a row lie side by side, as they are computed.
  using Values = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// The hidden state of one agent, in the order of Network::HiddenState: the two classes can exchange states.
  using HiddenState = Eigen::VectorXf;

  /// For `batch` agents. Throws std::invalid_argument if the layers do not fit together (validateLayers), if weights
  /// are so large that a weighted sum may exceed the range of float for any input, if `batch` is less than 1, or if
  /// `set` is not one of runnableInstructionSets().
  BatchNetwork(const LayerStack& layers, int batch, InstructionSet set = fastestInstructionSet());

  /// One step of all agents. `inputs` is inputSize() x batch(). The result is outputSize() x batch() and is valid until
  /// the next call. Throws std::invalid_argument for a wrong size, an input that is not finite, or one so large that a
  /// weighted sum could exceed the range of float; then no hidden state changes. Denormal inputs and cell states below
  /// 1e-18 count as zero.
  const Values& forward(const Eigen::Ref<const Values>& inputs);

  /// Sets the hidden states of all agents to zero.
  void reset();

  /// Throws std::out_of_range if there is no such agent.
  HiddenState hiddenState(int agent) const;
  /// Throws as hiddenState(). Throws std::invalid_argument if the size is not hiddenStateSize(), or if a value is not
  /// finite or is beyond 2^24, which no network reaches.
  void setHiddenState(int agent, const HiddenState& state);

  int batch() const { return static_cast<int>(outputs_.cols()); }
  int inputSize() const { return input_size_; }
  int outputSize() const { return static_cast<int>(outputs_.rows()); }
  int hiddenStateSize() const;
  std::size_t bytes() const;  ///< memory that the object uses, with the weights

 private:
  struct Program;  ///< the packed layers and their kernels
  /// Memory that is aligned as the kernels want it.
  struct alignas(64) CacheLine {
    float values[16];
  };
  /// Agents whose values lie side by side. All tiles but the last have the largest width.
  struct Tile {
    int kernel;
    int lanes;  ///< more than the agents of the last tile
    int first_agent;
    int agents;
    std::size_t first_line;  ///< of the tile's part of the memory
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
  int parity_ = 0;  ///< of the number of the next step
  Values outputs_;
};

}  // namespace lstm_planner
