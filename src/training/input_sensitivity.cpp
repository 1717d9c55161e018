#include "training/input_sensitivity.hpp"

#include <cmath>
#include <stdexcept>

namespace lstm_planner {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;

/// The output of a recurrent layer, and its derivative by the inputs of the first step. It is carried forward with the
/// state: exact where it has become far smaller than single precision can hold, in memory that does not grow with time.
template <typename Recurrent>
struct Unrolled {
  explicit Unrolled(const Recurrent& of)
      : layer(of),
        input(of.input.template cast<double>()),
        recurrent(of.recurrent.template cast<double>()),
        output(ArrayXd::Zero(of.recurrent.cols())),
        cell(output),
        output_by(MatrixXd::Zero(of.recurrent.cols(), of.input.cols())),
        cell_by(output_by) {}

  const Recurrent& layer;
  MatrixXd input;
  MatrixXd recurrent;
  ArrayXd output;
  ArrayXd cell;
  MatrixXd output_by;
  MatrixXd cell_by;
};

MatrixXd scaled(const ArrayXd& rows, const MatrixXd& by) { return rows.matrix().asDiagonal() * by; }

/// Thesis Eq. 2.14.
void advance(const ArrayXd& sums, const MatrixXd& by, Unrolled<RecurrentLayer>* state) {
  state->output = sums.tanh();
  state->output_by = scaled(1.0 - state->output.square(), by);
}

/// Thesis Eq. 2.21-2.25.
void advance(const ArrayXd& sums, const MatrixXd& by, Unrolled<LstmLayer>* state) {
  const Eigen::Index cells = state->output.size();
  const ArrayXd gates = 1.0 / (1.0 + (-sums.head(3 * cells)).exp());
  const MatrixXd gates_by = scaled(gates * (1.0 - gates), by.topRows(3 * cells));
  const bool is_tanh = state->layer.candidate == Activation::kTanh;
  const ArrayXd raw = sums.tail(cells);
  const ArrayXd candidate = is_tanh ? ArrayXd(raw.tanh()) : ArrayXd(1.0 / (1.0 + (-raw).exp()));
  const ArrayXd slope = is_tanh ? ArrayXd(1.0 - candidate.square()) : ArrayXd(candidate * (1.0 - candidate));
  const ArrayXd in = gates.head(cells);
  const ArrayXd out = gates.segment(cells, cells);
  const ArrayXd forget = gates.tail(cells);
  state->cell_by = scaled(forget, state->cell_by) + scaled(state->cell, gates_by.bottomRows(cells)) +
                   scaled(in * slope, by.bottomRows(cells)) + scaled(candidate, gates_by.topRows(cells));
  state->cell = forget * state->cell + in * candidate;
  const ArrayXd shown = state->cell.tanh();
  state->output = shown * out;
  state->output_by =
      scaled(out * (1.0 - shown.square()), state->cell_by) + scaled(shown, gates_by.middleRows(cells, cells));
}

/// Adds the squared length of the derivative of each unit (row) at each step (column).
template <typename Recurrent>
void addSquares(const Recurrent& layer, const Sequence& sequence, MatrixXd* squares) {
  Unrolled<Recurrent> state(layer);
  const Eigen::VectorXd bias = layer.bias.template cast<double>();
  for (Eigen::Index step = 0; step < sequence.steps(); ++step) {
    const Eigen::VectorXd sums = state.input * sequence.inputs.col(step).template cast<double>() +
                                 state.recurrent * state.output.matrix() + bias;
    MatrixXd by = state.recurrent * state.output_by;
    if (step == 0) by += state.input;
    advance(sums.array(), by, &state);
    squares->col(step) += state.output_by.rowwise().squaredNorm();
  }
}

}  // namespace

Eigen::MatrixXd firstStepSensitivity(const LayerStack& layers, const std::vector<Sequence>& sequences) {
  const bool recurrent = !layers.empty() && (std::holds_alternative<LstmLayer>(layers.front()) ||
                                             std::holds_alternative<RecurrentLayer>(layers.front()));
  if (!recurrent) throw std::invalid_argument("the first layer is not recurrent, expected LSTM or plain recurrent");
  if (sequences.empty()) throw std::invalid_argument("there are no sequences, expected at least one");
  const Eigen::Index steps = sequences.front().steps();
  MatrixXd squares = MatrixXd::Zero(outputSize({layers.front()}), steps);
  for (const Sequence& sequence : sequences) {
    if (sequence.steps() != steps) throw std::invalid_argument("the sequences differ in length, expected one length");
    if (const auto* lstm = std::get_if<LstmLayer>(&layers.front())) {
      addSquares(*lstm, sequence, &squares);
    } else {
      addSquares(std::get<RecurrentLayer>(layers.front()), sequence, &squares);
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
