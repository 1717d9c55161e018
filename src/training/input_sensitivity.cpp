#include "training/input_sensitivity.hpp"

#include <cmath>
#include <stdexcept>

#include "lstm_planner/training/lane_kernels.hpp"
#include "lstm_planner/training/lane_network.hpp"
#include "lstm_planner/training/parameter_vector.hpp"

namespace lstm_planner {
namespace {

/// The gradients of a unit's outputs at all steps by the first input: lane s has that of step s.
class LaneGradients {
 public:
  LaneGradients(const LayerStack& layers, int steps)
      : steps_(steps),
        parameters_(parameterVector(layers)),
        network_(layers, (steps + kLaneGroup - 1) / kLaneGroup * kLaneGroup, steps),
        unused_(Eigen::VectorXf::Zero(parameters_.size())),
        by_inputs_(network_.inputSize() * steps, network_.lanes()) {}

  Eigen::RowVectorXd squaredNorms(const Sequence& sequence, int unit) {
    network_.reset();
    for (int step = 0; step < steps_; ++step) {
      rowsOf(network_.inputs(step), network_.inputSize()).colwise() = sequence.inputs.col(step);
      network_.forward(parameters_, step);
      rowsOf(network_.outputGradient(step), network_.outputSize()).setZero();
      rowsOf(network_.outputGradient(step), network_.outputSize())(unit, step) = 1.0f;
    }
    network_.backward(parameters_, steps_, unused_, by_inputs_.data());
    return by_inputs_.topRows(network_.inputSize()).leftCols(steps_).cast<double>().colwise().squaredNorm();
  }

 private:
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Eigen::Map<Rows> rowsOf(float* values, int rows) const { return {values, rows, network_.lanes()}; }

  int steps_;
  Eigen::VectorXf parameters_;
  LaneNetwork network_;
  Eigen::VectorXf unused_;
  Rows by_inputs_;  ///< of all steps
};

}  // namespace

Eigen::MatrixXd firstStepSensitivity(const LayerStack& layers, const std::vector<Sequence>& sequences) {
  const bool recurrent = !layers.empty() && (std::holds_alternative<LstmLayer>(layers.front()) ||
                                             std::holds_alternative<RecurrentLayer>(layers.front()));
  if (!recurrent) throw std::invalid_argument("the first layer is not recurrent, expected LSTM or plain recurrent");
  if (sequences.empty()) throw std::invalid_argument("there are no sequences, expected at least one");
  const LayerStack first = {layers.front()};
  const Eigen::Index units = outputSize(first);
  const Eigen::Index steps = sequences.front().steps();
  LaneGradients gradients(first, static_cast<int>(steps));
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(units, steps);
  for (const Sequence& sequence : sequences) {
    if (sequence.steps() != steps) throw std::invalid_argument("the sequences differ in length, expected one length");
    for (int unit = 0; unit < units; ++unit) squares.row(unit) += gradients.squaredNorms(sequence, unit);
  }
  return (squares / static_cast<double>(sequences.size())).cwiseSqrt();
}

double spectralRadius(const RecurrentLayer& layer) {
  // Gelfand's formula, |W^k|^(1/k), whose error falls with 1/k. Eigen's solver takes 20 s to compile.
  constexpr int kSquarings = 50;
  Eigen::MatrixXd power = layer.recurrent.cast<double>();
  double logarithm = 0.0;
  for (int squarings = 0;; ++squarings) {
    const double norm = power.norm();
    if (norm == 0.0) return 0.0;
    logarithm += std::log(norm) / std::exp2(squarings);
    if (squarings == kSquarings) return std::exp(logarithm);
    power /= norm;
    power = power.lazyProduct(power).eval();
  }
}

}  // namespace lstm_planner
