#include "training/input_sensitivity.hpp"

#include <cmath>
#include <stdexcept>

#include "lstm_planner/training/gradient.hpp"
#include "lstm_planner/training/parameter_vector.hpp"

namespace lstm_planner {

Eigen::MatrixXd firstStepSensitivity(const LayerStack& layers, const std::vector<Sequence>& sequences) {
  const bool recurrent = !layers.empty() && (std::holds_alternative<LstmLayer>(layers.front()) ||
                                             std::holds_alternative<RecurrentLayer>(layers.front()));
  if (!recurrent) throw std::invalid_argument("the first layer is not recurrent, expected LSTM or plain recurrent");
  if (sequences.empty()) throw std::invalid_argument("there are no sequences, expected at least one");
  const LayerStack first = {layers.front()};
  const Eigen::Index units = outputSize(first);
  const Eigen::Index steps = sequences.front().steps();
  const Eigen::VectorXd parameters = parameterVector(first).cast<double>();
  SequenceGradient<double> gradient(first);
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(units, steps);
  Eigen::MatrixXd factors = Eigen::MatrixXd::Zero(units, steps);
  for (const Sequence& sequence : sequences) {
    if (sequence.steps() != steps) throw std::invalid_argument("the sequences differ in length, expected one length");
    for (Eigen::Index unit = 0; unit < units; ++unit) {
      for (Eigen::Index step = 0; step < steps; ++step) {
        factors(unit, step) = 1.0;
        squares(unit, step) += gradient.inputGradient(parameters, sequence, factors).col(0).squaredNorm();
        factors(unit, step) = 0.0;
      }
    }
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
